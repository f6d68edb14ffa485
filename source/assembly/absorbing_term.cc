// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/absorbing_term.h>

#include <cmath>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  AbsorbingTerm<dim>::AbsorbingTerm(ImplicitBoundary<dim> &boundary)
    : boundary(boundary)
  {}



  template <int dim>
  std::vector<Effect>
  AbsorbingTerm<dim>::effects(const StepContext<dim> &context) const
  {
    const std::string &name = boundary.name();
    return {{"absorbing boundary " + name,
             "boundary",
             name + ", absorbing, " +
               std::to_string(
                 boundary.n_points(context.state.grid().communicator())) +
               " quadrature points"}};
  }



  template <int dim>
  bool
  AbsorbingTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    boundary.begin_step(context.state.grid(),
                        context.t_start,
                        context.search_tolerance,
                        context.state.mesh_after_step() != MeshAfterStep::keep,
                        context.state.strain_measure(),
                        context.cells_moved);
    return false;
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::begin_trial(const StepContext<dim> &context)
  {
    boundary.set_target(context.t_end);
  }



  template <int dim>
  std::pair<SymmetricTensor<2, dim>, SymmetricTensor<2, dim>>
  AbsorbingTerm<dim>::impedance(const StepContext<dim> &context,
                                const unsigned int      q) const
  {
    const BoundaryPoint<dim> &point = boundary.points()[q];
    const LameConstants      &C =
      context.cell_materials.elastic_stiffness(point.cell);
    const double rho    = context.cell_materials.density(point.cell);
    const Matrix normal = symmetrize(outer_product(point.normal, point.normal));
    const Matrix tangents = unit_symmetric_tensor<dim>() - normal;
    const double r        = boundary.spring_radius();
    return {std::sqrt(rho * (C.lambda + 2 * C.mu)) * normal +
              std::sqrt(rho * C.mu) * tangents,
            r > 0 ? 2 * C.mu / r * normal + C.mu / (2 * r) * tangents :
                    Matrix()};
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::add(const StepContext<dim> &context,
                          const bool              tangent,
                          GlobalSystem<dim>      &system) const
  {
    LocalSystem<dim>      local;
    const Motion<dim>    &motion = *context.motion;
    const GridSpace<dim> &space  = context.state.grid();
    const unsigned int    n      = space.nodes_per_cell();
    const auto           &points = boundary.points();
    for (unsigned int begin = 0, end = 0; begin < points.size(); begin = end)
      {
        const unsigned int  cell  = points[begin].cell;
        const unsigned int *nodes = space.cell_nodes(cell);
        local.reinit(context.state, nodes, n, tangent);
        for (; end < points.size() && points[end].cell == cell; ++end)
          {
            const auto [C, k] = impedance(context, end);
            const double  *N  = boundary.N(end);
            Tensor<1, dim> u  = points[end].accumulated_violation, v;
            for (unsigned int a = 0; a < n; ++a)
              {
                u += N[a] * local.nodal_increments[a];
                v +=
                  N[a] * motion.velocity(nodes[a], local.nodal_increments[a]);
              }
            const Tensor<1, dim> force = -points[end].JxW * (C * v + k * u);
            const Matrix         stiffness =
              points[end].JxW * (motion.velocity_by_increment() * C + k);
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int i = 0; i < dim; ++i)
                {
                  local.force[dim * a + i] += N[a] * force[i];
                  if (tangent)
                    for (unsigned int b = 0; b < n; ++b)
                      for (unsigned int j = 0; j < dim; ++j)
                        local.matrix(dim * a + i, dim * b + j) +=
                          N[a] * N[b] * stiffness[i][j];
                }
          }
        system.add(local, tangent);
      }
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::prepare(const StepContext<dim> &context,
                              const LA::Vector &)
  {
    const GridSpace<dim>       &space  = context.state.grid();
    const auto                 &points = boundary.points();
    std::vector<Tensor<1, dim>> tractions(points.size()),
      displacements(points.size());
    prepared = {boundary.name(), {}, 0., 0., 0., 0.};
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        const auto [C, k]         = impedance(context, q);
        const unsigned int *nodes = space.cell_nodes(points[q].cell);
        Tensor<1, dim>      v;
        for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
          {
            const Tensor<1, dim> &du = context.increments()[nodes[a]];
            displacements[q] += boundary.N(q)[a] * du;
            v += boundary.N(q)[a] * context.motion->velocity(nodes[a], du);
          }
        const Tensor<1, dim> force =
          -points[q].JxW *
          (C * v + k * (points[q].accumulated_violation + displacements[q]));
        prepared.reaction += force;
        prepared.force_magnitude += force.norm();
      }
    sum_over_ranks(prepared, space.communicator());
    boundary.prepare(tractions, displacements);
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::keep() noexcept
  {
    boundary.keep();
  }



  template <int dim>
  void
  AbsorbingTerm<dim>::report(const StepContext<dim> &,
                             std::vector<BoundaryReport<dim>> &reports) const
  {
    reports.push_back(prepared);
  }



  template class AbsorbingTerm<2>;
  template class AbsorbingTerm<3>;
} // namespace moraine
