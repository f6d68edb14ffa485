// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// How well cells resolve stress.

#include <moraine/diagnostics/stress.h>

#include <moraine/core/ranges.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/checks.h>
#include <moraine/state/stress_error.h>
#include <moraine/state/stress_signs.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Jumps over the deviatoric stress, and stress in cuts over that
     * elsewhere,: healthy scenes have up to 0.9 and 2.5. */
    constexpr double allowed_jump = 1;
    constexpr double allowed_cut  = 3;

    /** A saw tooth has jumps larger than steps, which are those of the field
     * that is there: 5 and more where volume locks, at most 1 elsewhere. */
    constexpr double least_saw = 2;

    /** Next to no stress, over the shear modulus; next to no strain energy,
     * over the kinetic energy. */
    constexpr double no_stress = 1e-6;
    constexpr double no_energy = 1e-3;

    /** Over the largest part of the energy of a run. */
    constexpr double no_share_of_energy = 1e-12;

    /** Estimated error of stress: healthy scenes have up to 0.2. */
    constexpr double allowed_error = 0.25;



    /** Whether what moves has next to none of the energy as strain. */
    template <int dim>
    bool
    has_no_energy(const Facts<dim> &facts)
    {
      if (!facts.has_inertia())
        return false;
      const Works &works = facts.of.motion->works();
      return works.stored <= no_energy * works.kinetic ||
             works.stored <= no_share_of_energy * works.largest();
    }
  } // namespace



  template <int dim>
  std::optional<double>
  stress_error(const Facts<dim> &facts)
  {
    if (has_no_energy(facts))
      return {};
    std::vector<LameConstants> moduli;
    for (const auto &material : facts.of.materials)
      moduli.push_back(material->elastic_stiffness());
    return estimated_stress_error(facts.of.points, moduli);
  }



  namespace checks
  {
    template <int dim>
    std::optional<Finding>
    nothing_happened(Facts<dim> &facts, Ledger &)
    {
      const PointSet<dim> &points = facts.of.points;
      const auto           u      = points.displacement_field();
      const auto           stress = points.stress_field();
      bool                 any    = points.forgotten_displacement() > 0;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        any = any || u(points.values(p)).norm() > 0 ||
              stress(points.values(p)).norm() > 0;
      if (Utilities::MPI::logical_or(any, facts.communicator()))
        return {};
      return Finding{"no-effect",
                     "",
                     0,
                     0,
                     "nothing has moved or been stressed: no load, motion or "
                     "initial value acts on a body"};
    }



    namespace
    {
      /** Mean stress is a saw tooth: volume locks, or points cross cells. */
      template <int dim>
      std::optional<Finding>
      oscillation(const StressSigns &signs, const MethodParameters<dim> &method)
      {
        if (!(signs.jump > allowed_jump * signs.deviatoric) ||
            !(signs.jump > least_saw * signs.step))
          return {};
        const double ratio  = signs.jump / signs.deviatoric;
        std::string  remedy = "take smaller cells";
        if (method.volumetric() == VolumetricStrain::pointwise &&
            method.can_average_volume())
          remedy = "use 'Volumetric strain = cell mean'";
        else if (method.method == "material point")
          remedy = "use 'Method = GIMP'";
        return Finding{"stress-oscillation",
                       "",
                       ratio,
                       allowed_jump,
                       "mean stress jumps from cell to cell by " +
                         text_of(ratio, 3) + " times the deviatoric stress; " +
                         remedy};
      }



      /** Stress is largest where little of a cell is filled. Where all cells
       * are cut there is nothing to compare with. */
      template <int dim>
      std::optional<Finding>
      peak_in_cuts(const StressSigns           &signs,
                   const MethodParameters<dim> &method)
      {
        if (!(signs.elsewhere > 0) ||
            !(signs.in_cuts > allowed_cut * signs.elsewhere))
          return {};
        const double ratio = signs.in_cuts / signs.elsewhere;
        const double below = method.aggregate_below;
        return Finding{"coarse-stress",
                       "",
                       ratio,
                       allowed_cut,
                       "stress in cells filled by less than a half is " +
                         text_of(ratio, 3) + " times that elsewhere; " +
                         (below < 0.5 ? std::string("use 'Aggregate below = ") +
                                          (below < 0.1 ? "0.1'" : "0.5'") :
                                        std::string("take smaller cells"))};
      }
    } // namespace



    template <int dim>
    std::optional<Finding>
    stress_resolution(Facts<dim> &facts, Ledger &)
    {
      const StressSigns signs = stress_signs(facts.of.space, facts.of.points);
      double            mu    = std::numeric_limits<double>::max();
      for (const auto &material : facts.of.materials)
        mu = std::min(mu, material->elastic_stiffness().mu);
      if (!(signs.deviatoric > no_stress * mu) || has_no_energy(facts))
        return {};
      const MethodParameters<dim> &method = facts.of.scene.method;
      if (const auto found = oscillation(signs, method))
        return found;
      // The end of a wave is one moment, with next to no stress perhaps.
      if (!facts.has_inertia())
        {
          if (const auto found = peak_in_cuts(signs, method))
            return found;
          const auto &error = facts.now.stress_error;
          if (error && *error > allowed_error)
            return Finding{"coarse-stress",
                           "",
                           *error,
                           allowed_error,
                           "cells do not resolve the stress: its error is "
                           "about " +
                             per_cent(*error) +
                             " in the energy norm; take smaller cells"};
        }
      if (method.chosen().has_own_internal_force &&
          any_of(facts.of.materials,
                 [](const auto &material) { return material->may_lock(); }))
        return Finding{"stress-oscillation",
                       "",
                       1,
                       0,
                       "'Method = " + method.method +
                         "' keeps the volume of points and may be much too "
                         "stiff; compare with 'Method = GIMP'"};
      return {};
    }



    MORAINE_INSTANTIATE_CHECK(nothing_happened)
    MORAINE_INSTANTIATE_CHECK(stress_resolution)
  } // namespace checks



  template std::optional<double>
  stress_error(const Facts<2> &);
  template std::optional<double>
  stress_error(const Facts<3> &);
} // namespace moraine
