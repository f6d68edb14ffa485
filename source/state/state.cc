// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/state.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  State<dim>::State(GridSpace<dim>                              &space,
                    PointSet<dim>                               &points,
                    Basis<dim>                                  &basis,
                    std::vector<std::shared_ptr<const Material>> materials,
                    const MeshAfterStep mesh_after_step)
    : space(space)
    , points(points)
    , basis(basis)
    , materials(std::move(materials))
    , after_step(mesh_after_step)
  {}



  template <int dim>
  bool
  State<dim>::begin_step()
  {
    bool changed = false;
    if (first_step || after_step == MeshAfterStep::reset)
      {
        std::vector<unsigned char> active(
          space.mesh().triangulation().n_active_cells(), 0);
        basis.mark_cells(active);
        changed    = space.set_active_cells(std::move(active));
        changed    = basis.group_points() || changed;
        first_step = false;
      }
    reject();
    return Utilities::MPI::logical_or(changed, space.communicator());
  }



  template <int dim>
  void
  State<dim>::set_trial(const LA::Vector &increment)
  {
    space.node_values(increment, trial);
  }



  template <int dim>
  void
  State<dim>::reject()
  {
    trial.assign(space.n_nodes(), Tensor<1, dim>());
  }



  template <int dim>
  void
  State<dim>::accept()
  {
    StencilBlock<dim>           block;
    std::vector<Tensor<1, dim>> nodal;
    TrialStresses<dim>          trial_stresses;
    for (unsigned int g = 0; g < basis.n_groups(); ++g)
      {
        basis.evaluate(g, block);
        nodal.resize(block.n_nodes);
        for (unsigned int a = 0; a < block.n_nodes; ++a)
          nodal[a] = trial[block.nodes[a]];
        for (unsigned int begin = 0, end = 0; begin < block.n_points;
             begin = end)
          {
            end = end_of_body(block, begin);
            const auto &stresses =
              trial_stresses.evaluate(*this, block, begin, end, nodal.data());
            for (unsigned int p = begin; p < end; ++p)
              {
                double *sigma =
                  points.values(block.points[p]) + points.stress_offset();
                for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
                  sigma[c] = stresses[p - begin].access_raw_entry(c);
              }
          }
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            const unsigned int point = block.points[p];
            double *u = points.values(point) + points.displacement_offset();
            Tensor<1, dim> du;
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              du += block.N(p)[a] * nodal[a];
            for (unsigned int d = 0; d < dim; ++d)
              u[d] += du[d];
            if (after_step != MeshAfterStep::keep)
              points.set_position(point, points.position(point) + du);
          }
      }
    if (after_step == MeshAfterStep::follow_material)
      space.move_nodes(trial);
    else if (after_step == MeshAfterStep::reset)
      points.find_cells();
  }



  template <int dim>
  unsigned int
  State<dim>::end_of_body(const StencilBlock<dim> &block,
                          const unsigned int       begin) const
  {
    const unsigned int body = points.body(block.points[begin]);
    unsigned int       end  = begin + 1;
    while (end < block.n_points && points.body(block.points[end]) == body)
      ++end;
    return end;
  }



  template <int dim>
  const std::vector<SymmetricTensor<2, 3>> &
  TrialStresses<dim>::evaluate(const State<dim>        &state,
                               const StencilBlock<dim> &block,
                               const unsigned int       begin,
                               const unsigned int       end,
                               const Tensor<1, dim>    *nodal_increments)
  {
    const PointSet<dim> &points = state.material_points();
    strains.resize(end - begin);
    stresses.resize(end - begin);
    for (unsigned int p = begin; p < end; ++p)
      {
        strains[p - begin] =
          strain_increment(nodal_increments, block.grad_N(p), block.n_nodes);
        stresses[p - begin] = load_stress<dim>(points.values(block.points[p]) +
                                               points.stress_offset());
      }
    state.material(points.body(block.points[begin]))
      .update_stress(make_array_view(strains), make_array_view(stresses));
    return stresses;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  State<dim>::point_increments() const
  {
    std::vector<Tensor<1, dim>> increments(points.n_local());
    StencilBlock<dim>           block;
    for (unsigned int g = 0; g < basis.n_groups(); ++g)
      {
        basis.evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            increments[block.points[p]] +=
              block.N(p)[a] * trial[block.nodes[a]];
      }
    return increments;
  }



  template class TrialStresses<2>;
  template class TrialStresses<3>;
  template class State<2>;
  template class State<3>;
} // namespace moraine
