// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/step_failure.h>

#include <moraine/assembly/fictitious_stiffness.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <fmt/format.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Node of the largest force on this rank, n_nodes() if there is none. */
    template <int dim>
    std::pair<unsigned int, double>
    largest_force(const GridSpace<dim> &space, const LA::Vector &residual)
    {
      unsigned int worst   = space.n_nodes();
      double       largest = 0;
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        if (space.locally_owned().is_element(space.node_dof(node)))
          {
            double square = 0;
            for (unsigned int c = 0; c < dim; ++c)
              {
                const double force = residual(space.node_dof(node) + c);
                square += force * force;
              }
            if (std::isfinite(square) && square > largest)
              {
                largest = square;
                worst   = node;
              }
          }
      return {worst, largest};
    }



    /** What points fill of the cells of a node, over these, and of the one that
     * is filled most. */
    template <int dim>
    std::pair<double, double>
    filled_parts(const GridSpace<dim>          &space,
                 const PointSet<dim>           &points,
                 const types::global_dof_index &node_dof)
    {
      const std::vector<double> filled = points.volumes_in_cells();
      double                    volume = 0, sum = 0, fullest = 0;
      for (const auto &cell :
           space.mesh().triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && space.is_active(cell))
          for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
            if (space.node_dof(space.cell_nodes(cell)[a]) == node_dof)
              {
                const double of_cell = volume_of_cell(cell);
                const double in_cell = filled[cell->active_cell_index()];
                volume += of_cell;
                sum += in_cell;
                fullest = std::max(fullest, in_cell / of_cell);
              }
      volume  = Utilities::MPI::sum(volume, space.communicator());
      sum     = Utilities::MPI::sum(sum, space.communicator());
      fullest = Utilities::MPI::max(fullest, space.communicator());
      return {volume > 0 ? std::min(sum / volume, 1.) : 1., fullest};
    }



    /** Multigrid takes the more iterations the closer to 0.5; from here on that
     * is told. */
    constexpr double large_poisson_ratio = 0.45;



    /** The body that is there whose volume changes least, if it hardly does. */
    template <int dim>
    std::string
    stiff_volume(const Model<dim> &model)
    {
      double      largest = large_poisson_ratio;
      std::string body;
      for (unsigned int b = 0; b < model.body_names.size(); ++b)
        if (model.present[b])
          {
            const LameConstants C  = model.materials[b]->elastic_stiffness();
            const double        nu = 0.5 * C.lambda / (C.lambda + C.mu);
            if (nu > largest)
              {
                largest = nu;
                body    = model.body_names[b];
              }
          }
      return body.empty() ?
               "" :
               "the volume of body '" + body +
                 "' hardly changes, Poisson ratio = " + text_of(largest) +
                 ", for which multigrid takes many iterations; ";
    }
  } // namespace



  template <int dim>
  std::optional<Imbalance<dim>>
  largest_imbalance(const GridSpace<dim> &space,
                    const PointSet<dim>  &points,
                    const LA::Vector     &residual)
  {
    const auto [node, square] = largest_force(space, residual);
    const double largest = Utilities::MPI::max(square, space.communicator());
    if (largest == 0)
      return {};
    // Of ranks with the same force the first unknown counts.
    const bool                    here = square == largest;
    const types::global_dof_index dof =
      Utilities::MPI::min(here ? space.node_dof(node) :
                                 numbers::invalid_dof_index,
                          space.communicator());
    Point<dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = Utilities::MPI::sum(here && space.node_dof(node) == dof ?
                                       space.node_position(node)[d] :
                                       0.,
                                     space.communicator());
    const auto [filled, fullest] = filled_parts(space, points, dof);
    return Imbalance<dim>{place, filled, fullest};
  }



  template <int dim>
  std::string
  place_of_imbalance(const GridSpace<dim> &space,
                     const PointSet<dim>  &points,
                     const LA::Vector     &residual)
  {
    const auto found = largest_imbalance(space, points, residual);
    return found ? fmt::format("; the largest unbalanced force is at ({}), "
                               "where points fill {} % of the cells",
                               coordinates(found->place, 6, ", "),
                               std::lround(100 * found->filled)) :
                   "";
  }



  template <int dim>
  std::string
  cause_of_unsolved(const Model<dim> &model,
                    const bool        ran_out_of_iterations,
                    const bool        empty_parts_have_stiffness)
  {
    FictitiousStiffness<dim> empty_parts(0.);
    empty_parts.begin_step(model.system->step_context());
    const bool any_free_node =
      !empty_parts_have_stiffness &&
      empty_parts.any_empty_part(model.system->step_context());
    std::string text;
    if (ran_out_of_iterations)
      text = stiff_volume(model) +
             "'Solver = direct' or more 'Maximum linear iterations' in section "
             "'Solver' can help";
    if (any_free_node)
      text += std::string(text.empty() ? "" : "; ") +
              "nodes that too few points touch can be the cause; "
              "'Fictitious stiffness = 1e-6' in section 'Method' holds them";
    return text.empty() ? "" : " (" + text + ")";
  }



  template <int dim>
  std::string
  point_that_leaves(const Model<dim>  &model,
                    const TimeControl &time,
                    const LA::Vector  &x)
  {
    State<dim>                &state  = *model.state;
    const BackgroundMesh<dim> &mesh   = *model.mesh;
    const PointSet<dim>       &points = *model.points;
    if (state.mesh_after_step() != MeshAfterStep::reset)
      return "";
    state.set_trial(x);
    const auto  increments = state.point_increments();
    const auto  box = GridTools::compute_bounding_box(mesh.triangulation());
    std::string message;
    for (const auto &in_cell : points.cells())
      for (unsigned int p = in_cell.first; p < in_cell.last && message.empty();
           ++p)
        {
          const Point<dim> x_new = points.position(p) + increments[p];
          // Where that is in the mesh before it moves.
          const Point<dim> X =
            model.mesh_motion.map(x_new, time.trial_time(), time.time());
          if ((box.point_inside(X) &&
               (mesh.box_grid() || in_cell.cell->point_inside(X) ||
                mesh.cell_around(X))) ||
              points.place_for(X))
            continue;
          message =
            fmt::format("point {} of body '{}' leaves the mesh at ({}) in step "
                        "{}, t = {:.10g}; the results end with the last "
                        "accepted step, t = {:.10g}",
                        points.id(p),
                        model.body_names[points.body(p)],
                        coordinates(x_new, 10),
                        time.n_accepted() + 1,
                        time.trial_time(),
                        time.time());
        }
    for (const std::string &text : Utilities::MPI::all_gather(
           points.mesh().triangulation().get_communicator(), message))
      if (!text.empty())
        return text;
    return "";
  }



#define INSTANTIATE(dim)                                              \
  template decltype(largest_imbalance<dim>)  largest_imbalance<dim>;  \
  template decltype(place_of_imbalance<dim>) place_of_imbalance<dim>; \
  template decltype(cause_of_unsolved<dim>)  cause_of_unsolved<dim>;  \
  template decltype(point_that_leaves<dim>)  point_that_leaves<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
