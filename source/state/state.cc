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
    StencilBlock<dim>                  block;
    std::vector<Tensor<1, dim>>        nodal;
    std::vector<SymmetricTensor<2, 3>> strain(1), stress(1);
    for (unsigned int g = 0; g < basis.n_groups(); ++g)
      {
        basis.evaluate(g, block);
        nodal.resize(block.n_nodes);
        for (unsigned int a = 0; a < block.n_nodes; ++a)
          nodal[a] = trial[block.nodes[a]];
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            const unsigned int point  = block.points[p];
            double            *values = points.values(point);
            double            *sigma  = values + points.stress_offset();

            strain[0] =
              strain_increment(nodal.data(), block.grad_N(p), block.n_nodes);
            stress[0] = load_stress<dim>(sigma);
            materials[points.body(point)]->update_stress(
              make_array_view(strain), make_array_view(stress));
            for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
              sigma[c] = stress[0].access_raw_entry(c);

            Tensor<1, dim> du;
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              du += block.N(p)[a] * nodal[a];
            for (unsigned int d = 0; d < dim; ++d)
              values[points.displacement_offset() + d] += du[d];
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



  template class State<2>;
  template class State<3>;
} // namespace moraine
