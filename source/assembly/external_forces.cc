// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/mechanics_system.h>

#include <moraine/core/exceptions.h>
#include <moraine/mesh/active_search.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>


namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The forces that act on material points: on all of a body, on some. */
    template <int dim>
    void
    add_forces_on_points(const State<dim>        &state,
                         const Loads<dim>        &loads,
                         const double             t,
                         const StencilBlock<dim> &block,
                         LocalSystem<dim>        &local)
    {
      const PointSet<dim> &points = state.material_points();
      for (unsigned int p = 0; p < block.n_points; ++p)
        {
          const unsigned int point = block.points[p];
          const unsigned int body  = points.body(point);
          Tensor<1, dim>     f;
          for (const auto &force : loads.body_forces)
            if (force.acts_on[body])
              f += (force.times_density ? state.material(body).density() *
                                            state.initial_volume(point) :
                                          points.volume(point)) *
                   force.value(points.position(point), t);
          for (const auto &force : loads.on_points)
            if (force.acts_on(point))
              f += force.value(points.position(point), t);
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              local.force[dim * a + i] += block.N(p)[a] * f[i];
        }
    }



    /** Length or area of face @p f per unit of its reference face. */
    template <int dim>
    double
    face_jacobian(const CellMap<dim> &map,
                  const unsigned int  f,
                  const Point<dim>   &xi)
    {
      const Tensor<2, dim> J  = transpose(map.jacobian(xi));
      const unsigned int   d  = f / 2;
      const Tensor<1, dim> t1 = J[(d + 1) % dim];
      if constexpr (dim == 3)
        return cross_product_3d(t1, J[(d + 2) % dim]).norm();
      else
        return t1.norm();
    }



    /** A traction on the faces of one cell that lie on the side. */
    template <int dim, int degree>
    void
    add_side_traction(const State<dim>                            &state,
                      const SideTraction<dim>                     &load,
                      const double                                 t,
                      const typename GridSpace<dim>::CellIterator &cell,
                      LocalSystem<dim>                            &local)
    {
      constexpr unsigned int n     = CellShapes<dim, degree>::n_nodes;
      const unsigned int    *nodes = state.grid().cell_nodes(cell);
      const QGauss<dim - 1>  quadrature(degree + 1);
      Point<dim>             X[n];
      double                 N[n];
      Tensor<1, dim>         grad_N[n];
      for (unsigned int a = 0; a < n; ++a)
        X[a] = state.grid().node_position(nodes[a]);
      const CellVertices<dim> vertices = vertices_of<dim>(cell);
      const CellMap<dim>      map(vertices);
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() &&
            cell->face(f)->boundary_id() == load.side)
          {
            const auto on_face = QProjector<dim>::project_to_face(
              ReferenceCells::get_hypercube<dim>(), quadrature, f);
            for (unsigned int q = 0; q < on_face.size(); ++q)
              {
                CellShapes<dim, degree>::evaluate(on_face.point(q),
                                                  X,
                                                  N,
                                                  grad_N);
                const double JxW = quadrature.weight(q) *
                                   face_jacobian(map, f, on_face.point(q));
                Point<dim> x;
                for (unsigned int a = 0; a < n; ++a)
                  x += N[a] * X[a];
                const Tensor<1, dim> traction = load.value(x, t);
                for (unsigned int a = 0; a < n; ++a)
                  for (unsigned int i = 0; i < dim; ++i)
                    local.force[dim * a + i] += JxW * N[a] * traction[i];
              }
          }
    }
  } // namespace



  template <int dim>
  void
  MechanicsSystem<dim>::assemble_external_forces()
  {
    const GridSpace<dim> &space = state.grid();
    LocalSystem<dim>      local;
    local_scale = 0;
    node_forces.assign(space.n_nodes(), Tensor<1, dim>());
    if (!loads.body_forces.empty() || !loads.on_points.empty())
      {
        StencilBlock<dim> block;
        for (unsigned int g = 0; g < state.point_basis().n_groups(); ++g)
          {
            state.point_basis().evaluate(g, block);
            local.reinit(state, block.nodes, block.n_nodes, false);
            add_forces_on_points(state, loads, t_target, block, local);
            add_to_system(local, false);
          }
      }
    for (const auto &load : loads.side_tractions)
      for (const auto &cell :
           space.mesh().triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary() &&
            space.is_active(cell))
          {
            local.reinit(state,
                         space.cell_nodes(cell),
                         space.nodes_per_cell(),
                         false);
            if (space.degree() == 1)
              add_side_traction<dim, 1>(state, load, t_target, cell, local);
            else
              add_side_traction<dim, 2>(state, load, t_target, cell, local);
            add_to_system(local, false);
          }
    std::vector<double>         N(space.nodes_per_cell());
    std::vector<Tensor<1, dim>> grad_N(space.nodes_per_cell());
    for (const auto &load : loads.carried)
      for (const auto &place : load.places())
        if (place.active_cell_index != GridSpace<dim>::no_cell)
          {
            evaluate_shapes(
              space, place.active_cell_index, place.x, N.data(), grad_N.data());
            local.reinit(state,
                         space.cell_nodes(place.active_cell_index),
                         space.nodes_per_cell(),
                         false);
            const Tensor<1, dim> value = load.value(place.x, t_target);
            for (unsigned int a = 0; a < N.size(); ++a)
              for (unsigned int i = 0; i < dim; ++i)
                local.force[dim * a + i] += place.weight * N[a] * value[i];
            add_to_system(local, false);
          }
    space.sum_node_values(node_forces, external);
    external_scale = Utilities::MPI::sum(local_scale, space.communicator());
  }



  template void
  MechanicsSystem<2>::assemble_external_forces();
  template void
  MechanicsSystem<3>::assemble_external_forces();
} // namespace moraine
