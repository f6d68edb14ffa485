// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/pass_watch.h>

#include <moraine/run/near_bodies.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of a cell: less is no passing. */
    constexpr double told_overlap = 0.1;

    /** Of a cell: those that are nearer may share nodes, and hang together. */
    constexpr double apart = 2.1;



    /** The least of the overlaps of two boxes in the directions; negative if
     * they are apart. */
    template <int dim>
    double
    overlap(const BoundingBox<dim> &a, const BoundingBox<dim> &b)
    {
      double least = std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < dim; ++d)
        least = std::min(least,
                         std::min(a.upper_bound(d), b.upper_bound(d)) -
                           std::max(a.lower_bound(d), b.lower_bound(d)));
      return least;
    }



    /** Collective. */
    template <int dim>
    bool
    holds_nothing(const GridCondition<dim> &condition,
                  const Model<dim>         &model,
                  const double              t)
    {
      const auto prescribed =
        find_prescribed_nodes<dim>({condition}, *model.space, t);
      return Utilities::MPI::sum(prescribed.entries.size(),
                                 model.space->communicator()) == 0;
    }



    const char *const remedy =
      ": nodes that stay with the material know nothing of what comes in their "
      "way; points that move through the mesh ('Method = GIMP', 'Mesh after "
      "step = reset') do";
  } // namespace



  template <int dim>
  PassWatch<dim>::PassWatch(const Model<dim> &model)
    : model(model)
  {}



  template <int dim>
  std::vector<typename PassWatch<dim>::Box>
  PassWatch<dim>::boxes_of_bodies(const bool moved) const
  {
    const PointSet<dim> &points = *model.points;
    const auto           u      = points.displacement_field();
    const unsigned int   n      = model.body_names.size();
    // Lower bounds, and upper ones with the other sign.
    std::vector<double> bounds(2 * dim * n, std::numeric_limits<double>::max());
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        Point<dim> x = model.state->original_position(p);
        if (moved)
          x += u(points.values(p));
        double *of_body = &bounds[2 * dim * points.body(p)];
        for (unsigned int d = 0; d < dim; ++d)
          {
            of_body[d]       = std::min(of_body[d], x[d]);
            of_body[dim + d] = std::min(of_body[dim + d], -x[d]);
          }
      }
    Utilities::MPI::min(bounds, model.space->communicator(), bounds);
    std::vector<Box> boxes;
    for (unsigned int b = 0; b < n; ++b)
      {
        Point<dim> lower, upper;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = bounds[2 * dim * b + d];
            upper[d] = -bounds[2 * dim * b + dim + d];
          }
        boxes.push_back(lower[0] <= upper[0] ? Box({lower, upper}) : Box());
      }
    return boxes;
  }



  template <int dim>
  std::string
  PassWatch<dim>::pair_that_met(const std::vector<Box> &start,
                                const std::vector<Box> &now)
  {
    const auto &names = model.body_names;
    for (unsigned int a = 0; a < now.size(); ++a)
      for (unsigned int b = a + 1; b < now.size(); ++b)
        if (model.present[a] && model.present[b] &&
            overlap(start[a], start[b]) < -apart * model.mesh->cell_size() &&
            overlap(now[a], now[b]) > told_overlap * model.mesh->cell_size() &&
            told.insert(names[a] + " and " + names[b]).second)
          return names[a] + " and " + names[b] +
                 " have moved into each other, as far as the boxes around them "
                 "tell" +
                 remedy;
    return "";
  }



  template <int dim>
  std::string
  PassWatch<dim>::pair_that_sticks(const std::vector<Box> &start,
                                   const std::vector<Box> &now)
  {
    const auto  &names = model.body_names;
    const double far   = apart * model.mesh->cell_size();
    std::vector<std::vector<Tensor<1, dim>>> touched;
    for (unsigned int a = 0; a < now.size(); ++a)
      for (unsigned int b = a + 1; b < now.size(); ++b)
        {
          const std::string pair = names[a] + " and " + names[b];
          if (!model.present[a] || !model.present[b] || told.count(pair) > 0 ||
              !(overlap(start[a], start[b]) < -far) ||
              !(overlap(now[a], now[b]) > -far))
            continue;
          if (touched.empty())
            touched = touched_nodes(model);
          bool share = false;
          for (unsigned int node = 0; node < touched[a].size(); ++node)
            share =
              share || (touched[a][node][0] > 0 && touched[b][node][0] > 0);
          if (!Utilities::MPI::logical_or(share, model.space->communicator()))
            continue;
          told.insert(pair);
          return pair +
                 ", drawn apart, touch the same nodes: there is no contact, "
                 "they press on each other up to two cells before they meet, "
                 "stick together, and pull when they part; smaller cells bring "
                 "that later";
        }
    return "";
  }



  template <int dim>
  std::string
  PassWatch<dim>::side_passed(const StageParameters  &stage,
                              const std::vector<Box> &now)
  {
    const BoxGrid<dim> &grid = *model.mesh->box_grid();
    for (const auto &condition :
         acting_conditions(model.grid_conditions, stage))
      {
        if (!condition.side)
          continue;
        const unsigned int d        = *condition.side / 2;
        const bool         is_upper = *condition.side % 2 == 1;
        const double       side =
          grid.lower_corner[d] +
          (is_upper ? grid.n_cells[d] * grid.cell_size[d] : 0.);
        for (unsigned int b = 0; b < now.size(); ++b)
          {
            const double out = is_upper ? now[b].upper_bound(d) - side :
                                          side - now[b].lower_bound(d);
            if (model.present[b] &&
                out > told_overlap * model.mesh->cell_size() &&
                told.insert(model.body_names[b] + " through " + condition.name)
                  .second &&
                holds_nothing(condition, model, stage.time.start_time))
              return model.body_names[b] + " has moved through '" +
                     condition.name + "', which holds no node" + remedy;
          }
      }
    return "";
  }



  template <int dim>
  std::string
  PassWatch<dim>::look(const StageParameters &stage, const double t)
  {
    const bool moves_through_mesh =
      model.state->mesh_after_step() == MeshAfterStep::reset;
    if (model.points->forgotten_displacement() > 0 ||
        (moves_through_mesh && model.body_names.size() < 2) ||
        !(since_look > told_overlap * model.mesh->cell_size()))
      return "";
    since_look                   = 0;
    const std::vector<Box> start = boxes_of_bodies(false);
    const std::vector<Box> now   = boxes_of_bodies(true);
    std::string found = moves_through_mesh ? pair_that_sticks(start, now) :
                                             pair_that_met(start, now);
    if (found.empty() && !moves_through_mesh && model.mesh->box_grid())
      found = side_passed(stage, now);
    if (found.empty())
      return "";
    std::ostringstream text;
    text << "by t = " << t << " " << found;
    return text.str();
  }



  template <int dim>
  void
  PassWatch<dim>::write(Archive &archive) const
  {
    archive.write_lines("checks/passes/told", {told.begin(), told.end()});
    archive.write("checks/passes/motion_since_look", since_look, "length");
  }



  template <int dim>
  void
  PassWatch<dim>::read(const Archive &archive)
  {
    const auto lines = archive.lines("checks/passes/told");
    told             = {lines.begin(), lines.end()};
    since_look       = archive.number("checks/passes/motion_since_look");
  }



  template class PassWatch<2>;
  template class PassWatch<3>;
} // namespace moraine
