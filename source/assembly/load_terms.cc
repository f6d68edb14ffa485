// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/load_terms.h>
#include <moraine/mesh/active_search.h>
#include <moraine/mesh/cell_shapes.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** The effect of a load in words. */
    std::vector<Effect>
    effect_of(const std::string &kind, const std::string &name)
    {
      return {{kind + " " + name, "load", name + ", " + kind}};
    }



    /** Share a force on a point among its nodes. */
    template <int dim>
    void
    share(const Tensor<1, dim> &f, const double *N, LocalSystem<dim> &local)
    {
      const unsigned int n_nodes = local.nodal_increments.size();
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          local.force[dim * a + i] += N[a] * f[i];
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



    /** A traction on a face; @p on_face are places in its cell. */
    template <int dim, int degree>
    void
    add_side_traction(const State<dim>        &state,
                      const SideTraction<dim> &load,
                      const CellFace<dim>     &face,
                      const Quadrature<dim>   &on_face,
                      const double             t,
                      LocalSystem<dim>        &local)
    {
      constexpr unsigned int n     = CellShapes<dim, degree>::n_nodes;
      const unsigned int    *nodes = state.grid().cell_nodes(face.cell);
      Point<dim>             X[n];
      double                 N[n];
      Tensor<1, dim>         grad_N[n];
      for (unsigned int a = 0; a < n; ++a)
        X[a] = state.grid().node_position(nodes[a]);
      const CellVertices<dim> vertices = vertices_of<dim>(face.cell);
      const CellMap<dim>      map(vertices);
      for (unsigned int q = 0; q < on_face.size(); ++q)
        {
          const Point<dim> &xi = on_face.point(q);
          CellShapes<dim, degree>::evaluate(xi, X, N, grad_N);
          const double JxW =
            on_face.weight(q) * face_jacobian(map, face.face, xi);
          Point<dim> x;
          for (unsigned int a = 0; a < n; ++a)
            x += N[a] * X[a];
          const Tensor<1, dim> traction = load.value(x, t);
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int i = 0; i < dim; ++i)
              local.force[dim * a + i] += JxW * N[a] * traction[i];
        }
    }
  } // namespace



  template <int dim>
  Quadrature<dim - 1>
  side_quadrature(const unsigned int degree)
  {
    return QIterated<dim - 1>(QGauss<1>(degree + 1), dim == 2 ? 4 : 2);
  }



  template <int dim>
  BodyForceTerm<dim>::BodyForceTerm(const BodyForce<dim> &force)
    : force(force)
  {}



  template <int dim>
  std::vector<Effect>
  BodyForceTerm<dim>::effects(const StepContext<dim> &) const
  {
    return effect_of(force.times_density ? "gravity" : "body force",
                     force.name);
  }



  template <int dim>
  void
  BodyForceTerm<dim>::add(const StepContext<dim>  &context,
                          const StencilBlock<dim> &block,
                          const bool,
                          LocalSystem<dim> &local) const
  {
    const State<dim>    &state  = context.state;
    const PointSet<dim> &points = state.material_points();
    for (unsigned int p = 0; p < block.n_points; ++p)
      {
        const unsigned int point = block.points[p];
        const unsigned int body  = points.body(point);
        if (force.acts_on[body])
          share((force.times_density ? state.material(body).density() *
                                         state.initial_volume(point) :
                                       points.volume(point)) *
                  force.value(force.at_start ? state.original_position(point) :
                                               points.position(point),
                              context.t_end),
                block.N(p),
                local);
      }
  }



  template <int dim>
  ForceOnPointsTerm<dim>::ForceOnPointsTerm(ForceOnPoints<dim> &force)
    : force(force)
  {}



  template <int dim>
  std::vector<Effect>
  ForceOnPointsTerm<dim>::effects(const StepContext<dim> &) const
  {
    return effect_of("force on points", force.name());
  }



  template <int dim>
  bool
  ForceOnPointsTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    const State<dim> &state = context.state;
    force.find_points(state.material_points(), [&state](const unsigned int p) {
      return state.original_position(p);
    });
    return false;
  }



  template <int dim>
  void
  ForceOnPointsTerm<dim>::add(const StepContext<dim>  &context,
                              const StencilBlock<dim> &block,
                              const bool,
                              LocalSystem<dim> &local) const
  {
    for (unsigned int p = 0; p < block.n_points; ++p)
      if (force.acts_on(block.points[p]))
        share(force.value(context.state.material_points().position(
                            block.points[p]),
                          context.t_end),
              block.N(p),
              local);
  }



  template <int dim>
  std::vector<CellFace<dim>>
  pushed_faces(const SideTraction<dim> &load,
               const GridSpace<dim>    &space,
               const PointSet<dim>     &points)
  {
    const std::vector<double> filled       = points.volumes_in_cells();
    const auto                holds_points = [&filled](const auto &cell) {
      return filled[cell->active_cell_index()] > 0;
    };
    std::vector<CellFace<dim>> faces;
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (cell->at_boundary() && space.is_active(cell))
        for (const unsigned int f : cell->face_indices())
          {
            const unsigned int opposite = f ^ 1u;
            if (cell->face(f)->at_boundary() &&
                cell->face(f)->boundary_id() == load.side &&
                (holds_points(cell) ||
                 (!cell->at_boundary(opposite) &&
                  holds_points(cell->neighbor(opposite)))))
              faces.push_back({cell, f});
          }
    return faces;
  }



  template <int dim>
  SideTractionTerm<dim>::SideTractionTerm(const SideTraction<dim> &load)
    : load(load)
  {}



  template <int dim>
  std::vector<Effect>
  SideTractionTerm<dim>::effects(const StepContext<dim> &) const
  {
    return effect_of("side traction", load.name);
  }



  template <int dim>
  bool
  SideTractionTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    faces =
      pushed_faces(load, context.state.grid(), context.state.material_points());
    faces.erase(std::remove_if(faces.begin(),
                               faces.end(),
                               [](const CellFace<dim> &face) {
                                 return !face.cell->is_locally_owned();
                               }),
                faces.end());
    return false;
  }



  template <int dim>
  void
  SideTractionTerm<dim>::add(const StepContext<dim> &context,
                             const bool,
                             GlobalSystem<dim> &system) const
  {
    const GridSpace<dim>        &space = context.state.grid();
    std::vector<Quadrature<dim>> on_faces;
    for (const unsigned int f : GeometryInfo<dim>::face_indices())
      on_faces.push_back(
        QProjector<dim>::project_to_face(ReferenceCells::get_hypercube<dim>(),
                                         side_quadrature<dim>(space.degree()),
                                         f));
    LocalSystem<dim> local;
    for (const CellFace<dim> &face : faces)
      {
        local.reinit(context.state,
                     space.cell_nodes(face.cell),
                     space.nodes_per_cell(),
                     false);
        if (space.degree() == 1)
          add_side_traction<dim, 1>(context.state,
                                    load,
                                    face,
                                    on_faces[face.face],
                                    context.t_end,
                                    local);
        else
          add_side_traction<dim, 2>(context.state,
                                    load,
                                    face,
                                    on_faces[face.face],
                                    context.t_end,
                                    local);
        system.add(local, false);
      }
  }



  template <int dim>
  CarriedLoadTerm<dim>::CarriedLoadTerm(CarriedLoad<dim> &load, const bool acts)
    : load(load)
    , acts(acts)
  {}



  template <int dim>
  std::vector<Effect>
  CarriedLoadTerm<dim>::effects(const StepContext<dim> &) const
  {
    if (!acts)
      return {};
    return effect_of(load.is_single() ? "point force" : "surface traction",
                     load.name());
  }



  template <int dim>
  bool
  CarriedLoadTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    // On a mesh that does not reset, places stay in their cells.
    if (context.couplings_changed ||
        context.state.mesh_after_step() == MeshAfterStep::reset)
      {
        load.find_cells(context.state.grid(), context.search_tolerance);
        const Basis<dim> &basis = context.state.point_basis();
        load.set_functions(context.state.mesh_after_step() ==
                               MeshAfterStep::reset ?
                             basis.functions_at(load.places()) :
                             basis.functions_of_cells(load.places()));
      }
    return false;
  }



  template <int dim>
  void
  CarriedLoadTerm<dim>::add(const StepContext<dim> &context,
                            const bool,
                            GlobalSystem<dim> &system) const
  {
    if (!acts)
      return;
    const GridSpace<dim>      &space     = context.state.grid();
    const unsigned int         n         = space.nodes_per_cell();
    const PlaceFunctions<dim> &functions = load.functions();
    LocalSystem<dim>           local;
    for (unsigned int i = 0; i < functions.places.size(); ++i)
      {
        const auto &place = load.places()[functions.places[i]];
        local.reinit(context.state,
                     space.cell_nodes(functions.cells[i]),
                     n,
                     false);
        share(place.weight * load.value(place.x, context.t_end),
              &functions.N[n * i],
              local);
        system.add(local, false);
      }
  }



  template <int dim>
  void
  CarriedLoadTerm<dim>::prepare(const StepContext<dim> &context,
                                const LA::Vector &)
  {
    if (context.state.mesh_after_step() != MeshAfterStep::keep)
      load.prepare_move(context.state.grid(),
                        context.increments(),
                        context.state.mesh_after_step() ==
                          MeshAfterStep::reset);
  }



  template <int dim>
  void
  CarriedLoadTerm<dim>::keep() noexcept
  {
    load.move();
  }



#define INSTANTIATE(dim)                                                        \
  template Quadrature<dim - 1>        side_quadrature<dim>(const unsigned int); \
  template std::vector<CellFace<dim>> pushed_faces(const SideTraction<dim> &,   \
                                                   const GridSpace<dim> &,      \
                                                   const PointSet<dim> &);      \
  template class BodyForceTerm<dim>;                                            \
  template class ForceOnPointsTerm<dim>;                                        \
  template class SideTractionTerm<dim>;                                         \
  template class CarriedLoadTerm<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
