// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Whether strain is small where 'Strain = small' takes it for that.

#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/checks.h>
#include <moraine/points/linear_fit.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace moraine
{
  namespace checks
  {
    using namespace dealii;

    namespace
    {
      const char *const id = "small-strain";

      /** In the mean over a body: stress and force over area differ by as
       * much. */
      constexpr double allowed_strain = 0.05;

      /** Of points in a cell of size 1, in each direction, squared. */
      constexpr double least_spread_of_places = 0.01;

      /** Strain of a turn, of the largest elastic strain in the norm of
       * energy; a turn by a quarter of a degree is no stress to speak of. */
      constexpr double allowed_share_of_turns = 0.2, least_strain = 1e-5;

      /** Of the size of a body: parts that move by more against each other have
       * turned by 20 degrees, or stretched by a third. */
      constexpr double allowed_difference = 0.35;



      /** @f$1 - \cos\theta@f$ of the turn between two times. */
      template <int dim>
      double
      strain_of_turn(const RigidMotion<dim> &motion,
                     const double            from,
                     const double            to)
      {
        const Tensor<2, dim> R =
          motion.pose(to).rotation() * transpose(motion.pose(from).rotation());
        return 0.5 * (dim - trace(R));
      }



      /** The largest strain that stress stands for, by its energy. */
      template <int dim>
      double
      largest_elastic_strain(const Facts<dim> &facts)
      {
        const PointSet<dim> &points  = facts.of.points;
        double               largest = 0;
        for (unsigned int p = 0; p < points.n_local(); ++p)
          {
            const LameConstants C     = elastic_stiffness(facts.of.state, p);
            const auto          sigma = points.stress_field()(points.values(p));
            largest =
              std::max(largest,
                       sigma * C.strain_of(sigma) / (4 * (C.lambda + C.mu)));
          }
        return std::sqrt(Utilities::MPI::max(largest, facts.communicator()));
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    turned_at_small_strain(Facts<dim> &facts, Ledger &ledger)
    {
      if (facts.of.state.strain_measure() != StrainMeasure::small)
        return {};
      const bool   moves  = facts.is_small_and_moves();
      double      &last   = ledger.number("small-strain/time");
      const bool   first  = ledger.number("small-strain/begun") == 0;
      const double before = first ? facts.of.scene.start_time() : last;
      ledger.number("small-strain/begun") = 1;
      last                                = facts.now.t;
      Worst      worst(id, least_strain);
      const auto count = [&](const std::string      &name,
                             const RigidMotion<dim> &motion) {
        if (!motion.turns() ||
            none_of(*facts.now.reports,
                    [&](const auto &report) { return report.name == name; }))
          return;
        const std::string since = "small-strain/since of " + name;
        if (!ledger.has_number(since))
          ledger.number(since) = before;
        double &strain = ledger.number("small-strain/turn of " + name);
        strain         = moves ?
                           strain + strain_of_turn(motion, before, facts.now.t) :
                           strain_of_turn(motion, ledger.number(since), facts.now.t);
        worst.take(name, strain);
      };
      for (const auto &boundary : facts.of.boundaries)
        count(boundary.name(), boundary.rigid_motion());
      for (const auto &condition : facts.of.grid_conditions)
        count(condition.name, condition.motion);
      if (worst.object.empty())
        return {};
      worst.value /= largest_elastic_strain(facts);
      worst.limit = allowed_share_of_turns;
      if (!(worst.value > worst.limit))
        return {};
      return worst.with("small strain takes its turn for a strain, " +
                        text_of(worst.value, 3) +
                        " times the elastic one; use 'Strain = finite'");
    }



    namespace
    {
      /** Mean norm of the strain of each body, by linear displacements in
       * cells. */
      template <int dim>
      std::vector<double>
      mean_strains(const Facts<dim> &facts)
      {
        const PointSet<dim> &points   = facts.of.points;
        const unsigned int   n_bodies = facts.of.body_names.size();
        const double         h        = facts.cell_size();
        std::vector<double>  sums(2 * n_bodies, 0.);
        const auto           u = points.displacement_field();
        for (const auto &in_cell : points.cells())
          {
            const unsigned int b         = points.body(in_cell.first);
            bool               is_of_one = true;
            for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
              is_of_one = is_of_one && points.body(p) == b;
            if (!is_of_one)
              continue;
            const LinearFit<dim, Tensor<1, dim>> linear(
              points,
              in_cell,
              [&](const unsigned int p) {
                return Point<dim>(points.position(p) - u(points.values(p)));
              },
              [&](const unsigned int p) {
                return Tensor<1, dim>(u(points.values(p)));
              },
              least_spread_of_places * h * h);
            if (!linear.is_complete())
              continue;
            Tensor<2, dim> gradient;
            for (unsigned int d = 0; d < dim; ++d)
              gradient[d] = linear.gradient()[d];
            sums[b] += linear.volume() * symmetrize(gradient).norm();
            sums[n_bodies + b] += linear.volume();
          }
        Utilities::MPI::sum(sums, facts.communicator(), sums);
        for (unsigned int b = 0; b < n_bodies; ++b)
          sums[b] = sums[n_bodies + b] > 0 ? sums[b] / sums[n_bodies + b] : 0.;
        sums.resize(n_bodies);
        return sums;
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    strained_at_small_strain(Facts<dim> &facts, Ledger &)
    {
      if (!facts.is_small_and_moves())
        return {};
      const std::vector<double> strains = mean_strains(facts);
      const auto largest = std::max_element(strains.begin(), strains.end());
      if (!(*largest > allowed_strain))
        return {};
      return Finding{id,
                     facts.of.body_names[largest - strains.begin()],
                     *largest,
                     allowed_strain,
                     "its mean strain is " + per_cent(*largest) +
                       ", and forces by small strain differ by as much; use "
                       "'Strain = finite'"};
    }



    template <int dim>
    std::optional<Finding>
    moved_at_small_strain(Facts<dim> &facts, Ledger &)
    {
      if (facts.of.state.strain_measure() != StrainMeasure::small)
        return {};
      // Of each body, largest coordinates at the start, and with the other
      // sign, the same of displacements, and their norm.
      constexpr unsigned int n        = 4 * dim + 1;
      const unsigned int     n_bodies = facts.of.body_names.size();
      std::vector<double>    largest(n * n_bodies,
                                  std::numeric_limits<double>::lowest());
      const PointSet<dim>   &points = facts.of.points;
      const auto             u      = points.displacement_field();
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          const Tensor<1, dim> motion = u(points.values(p));
          const Point<dim>     start  = points.position(p) - motion;
          double              *of     = largest.data() + n * points.body(p);
          const auto           raise  = [](double &to, const double value) {
            to = std::max(to, value);
          };
          for (unsigned int d = 0; d < dim; ++d)
            {
              raise(of[2 * d], start[d]);
              raise(of[2 * d + 1], -start[d]);
              raise(of[2 * (dim + d)], motion[d]);
              raise(of[2 * (dim + d) + 1], -motion[d]);
            }
          raise(of[4 * dim], motion.norm());
        }
      Utilities::MPI::max(largest, facts.communicator(), largest);
      for (unsigned int b = 0; b < n_bodies; ++b)
        {
          const double *of   = largest.data() + n * b;
          double        size = 0, differ = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              size = std::max(size, of[2 * d] + of[2 * d + 1]);
              differ =
                std::max(differ, of[2 * (dim + d)] + of[2 * (dim + d) + 1]);
            }
          // In dynamics a body that flies as a whole is right.
          const bool moved = of[4 * dim] > size && !facts.of.scene.is_dynamic();
          if (moved || (differ > allowed_difference * size &&
                        facts.is_small_and_moves()))
            return Finding{id,
                           facts.of.body_names[b],
                           (moved ? of[4 * dim] : differ) / size,
                           moved ? 1. : allowed_difference,
                           (moved ? std::string("it has moved by ") :
                                    std::string("its parts have moved by ")) +
                             text_of((moved ? of[4 * dim] : differ) / size, 3) +
                             " times its size; use 'Strain = finite'"};
        }
      return {};
    }



    MORAINE_INSTANTIATE_CHECK(turned_at_small_strain)
    MORAINE_INSTANTIATE_CHECK(strained_at_small_strain)
    MORAINE_INSTANTIATE_CHECK(moved_at_small_strain)
  } // namespace checks
} // namespace moraine
