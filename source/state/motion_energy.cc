// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Where the energy of a motion went, and its sums over all points.

#include <moraine/state/block_mass.h>
#include <moraine/state/motion.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  using namespace dealii;

  double
  Works::numerical_damping() const
  {
    double sum = kinetic_at_start - kinetic - (lost_in_transfer - lost_stored);
    for (const double work : of_forces)
      sum += work;
    return sum;
  }



  double
  Works::largest() const
  {
    double part = std::max({kinetic_at_start,
                            kinetic,
                            stored_at_start,
                            stored,
                            dissipated,
                            std::abs(lost_in_transfer)});
    for (const double work : of_forces)
      part = std::max(part, std::abs(work));
    return part;
  }



  template <int dim>
  void
  Motion<dim>::StepWorks::sum_over_ranks(const MPI_Comm &communicator)
  {
    for (unsigned int k = 0; k < Works::n_kinds; ++k)
      {
        at_start[k] = Utilities::MPI::sum(at_start[k], communicator);
        at_end[k]   = Utilities::MPI::sum(at_end[k], communicator);
      }
    on_prescribed_at_start =
      Utilities::MPI::sum(on_prescribed_at_start, communicator);
    on_prescribed_at_end =
      Utilities::MPI::sum(on_prescribed_at_end, communicator);
  }



  template <int dim>
  template <std::size_t n>
  std::array<double, n>
  Motion<dim>::mass_products(const std::array<Pair, n> &pairs) const
  {
    const Basis<dim>     &basis = state.point_basis();
    StencilBlock<dim>     block;
    BlockMass<dim>        matrix;
    NodeValues            u, w;
    std::array<double, n> products{};
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        matrix.find_lumped(
          block,
          [this](const unsigned int p) { return state.mass(p); },
          lumped);
        u.resize(block.n_nodes);
        w.resize(block.n_nodes);
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int k = 0; k < block.n_nodes; ++k)
              {
                u[k] = (*pairs[i].first)[block.nodes[k]];
                w[k] = (*pairs[i].second)[block.nodes[k]];
              }
            for (unsigned int p = 0; p < block.n_points; ++p)
              products[i] +=
                state.mass(block.points[p]) * matrix.product(block.N(p), u, w);
          }
      }
    for (double &product : products)
      product = Utilities::MPI::sum(product, state.grid().communicator());
    return products;
  }



  template <int dim>
  void
  Motion<dim>::count_kinetic_change(const NodeValues &before)
  {
    if (before.empty())
      return;
    const auto [v_before, v_now] =
      mass_products<2>({{{&before, &before}, {&v, &v}}});
    from_conditions += 0.5 * (v_now - v_before);
  }



  template <int dim>
  void
  Motion<dim>::count(const StepWorks       &step,
                     const KineticProducts &products,
                     const Nodal           &end)
  {
    const double kinetic = 0.5 * products.v_v;
    if (!done.begun)
      done.kinetic_at_start = kinetic;
    else
      {
        done.lost_in_transfer += done.kinetic - kinetic + from_conditions;
        done.of_forces[unsigned(WorkKind::boundaries)] += from_conditions;
        done.of_prescribed += from_conditions;
      }
    // The parts of the forces at both ends in what moves the nodes.
    const double share   = rule.forces_in_the_middle() ? 0. : 0.5;
    double       missing = share * products.a_du;
    for (unsigned int k = 0; k < Works::n_kinds; ++k)
      {
        const double of_start = share * step.at_start[k];
        done.of_forces[k] += of_start + (1 - share) * step.at_end[k];
        missing -= of_start;
      }
    if (!prescribed.empty())
      {
        const auto [at_start, at_end] =
          mass_products<2>({{{&a, &prescribed}, {&end.a, &prescribed}}});
        const double of_start =
          share * (at_start - step.on_prescribed_at_start);
        const double of_end =
          (1 - share) * (at_end - step.on_prescribed_at_end);
        done.of_forces[unsigned(WorkKind::boundaries)] += of_start + of_end;
        done.of_prescribed += of_start + of_end;
        missing -= of_start;
      }
    // Only Newmark's rule has accelerations that balance the forces. Where
    // nodes keep them, boundaries alone have other forces by now: their pieces
    // were cut anew.
    if (rule.start_forces() == 0.)
      {
        const unsigned int k = unsigned(WorkKind::boundaries);
        if (points_carry())
          done.lost_in_transfer -= missing;
        else if (step.at_start[k] != 0. || step.at_end[k] != 0.)
          done.of_forces[k] += missing;
      }
    done.kinetic = 0.5 * products.v_v_end;
  }



  template <int dim>
  void
  Motion<dim>::count(const StepEnergies &energies)
  {
    const MPI_Comm communicator = state.grid().communicator();
    const double   start =
      Utilities::MPI::sum(energies.stored_at_start, communicator);
    if (!done.begun)
      done.stored_at_start = start;
    else
      {
        done.lost_in_transfer += done.stored - start;
        done.lost_stored += done.stored - start;
      }
    done.begun  = true;
    done.stored = Utilities::MPI::sum(energies.stored, communicator);
    done.dissipated += Utilities::MPI::sum(energies.dissipated, communicator);
  }



  template <int dim>
  MotionSums<dim>
  Motion<dim>::sums() const
  {
    MotionSums<dim> result;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const double         m = state.mass(p);
        const Point<dim>     x = points.position(p);
        const Tensor<1, dim> v = v_field(points.values(p));
        result.mass += m;
        result.momentum += m * v;
        result.kinetic_energy += 0.5 * m * v.norm_square();
        if constexpr (dim == 2)
          result.angular_momentum[0] += m * (x[0] * v[1] - x[1] * v[0]);
        else
          result.angular_momentum += m * cross_product_3d(x, v);
      }
    const MPI_Comm communicator = state.grid().communicator();
    result.mass     = Utilities::MPI::sum(result.mass, communicator);
    result.momentum = Utilities::MPI::sum(result.momentum, communicator);
    result.angular_momentum =
      Utilities::MPI::sum(result.angular_momentum, communicator);
    result.kinetic_energy =
      Utilities::MPI::sum(result.kinetic_energy, communicator);
    return result;
  }



  template void
  Motion<2>::StepWorks::sum_over_ranks(const MPI_Comm &);
  template void
  Motion<3>::StepWorks::sum_over_ranks(const MPI_Comm &);
  template std::array<double, 2>
  Motion<2>::mass_products(const std::array<Pair, 2> &) const;
  template std::array<double, 2>
  Motion<3>::mass_products(const std::array<Pair, 2> &) const;
  template void
  Motion<2>::count_kinetic_change(const NodeValues &);
  template void
  Motion<3>::count_kinetic_change(const NodeValues &);
  template void
  Motion<2>::count(const StepWorks &, const KineticProducts &, const Nodal &);
  template void
  Motion<3>::count(const StepWorks &, const KineticProducts &, const Nodal &);
  template void
  Motion<2>::count(const StepEnergies &);
  template void
  Motion<3>::count(const StepEnergies &);
  template MotionSums<2>
  Motion<2>::sums() const;
  template MotionSums<3>
  Motion<3>::sums() const;
} // namespace moraine
