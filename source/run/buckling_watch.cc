// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/buckling_watch.h>

#include <moraine/run/geometric_stiffness.h>
#include <moraine/run/strain_signs.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace moraine
{
  namespace
  {
    /** Deflections that are wrong by less are not told of. */
    constexpr double told_geometric_share = 0.1;

    /** Less than that of mean strain is not for being slender: bodies are
     * strained so much that the note on strain is told. */
    constexpr double slender_share = 10;

    /** Of motion since stress was last asked what it makes of the bodies. */
    constexpr double growth_of_motion = 2;
  } // namespace



  template <int dim>
  BucklingWatch<dim>::BucklingWatch(const Model<dim>             &model,
                                    const LinearSolverParameters &solver)
    : model(model)
    , solver(solver)
  {}



  template <int dim>
  void
  BucklingWatch<dim>::displacements_begin_anew()
  {
    for (const double strain : mean_strains(model))
      strain_at_resets = std::max(strain_at_resets, strain);
  }



  template <int dim>
  void
  BucklingWatch<dim>::try_step(const LA::Vector &x,
                               const bool        ends,
                               const bool        quasi_static,
                               const double      largest_motion)
  {
    if (motion_of_share == 0)
      motion_of_share = largest_motion;
    trial_share = 0;
    if (!ends &&
        !(quasi_static && largest_motion > growth_of_motion * motion_of_share))
      return;
    motion_of_share = largest_motion;
    trial_share     = geometric_share(model, x, solver);
  }



  template <int dim>
  void
  BucklingWatch<dim>::keep_step()
  {
    if (trial_share < told_geometric_share || trial_share <= largest_share)
      return;
    double strain = strain_at_resets;
    for (const double of_body : mean_strains(model))
      strain = std::max(strain, of_body);
    if (trial_share >= slender_share * strain)
      largest_share = trial_share;
  }



  template <int dim>
  std::vector<std::string>
  BucklingWatch<dim>::doubts() const
  {
    if (largest_share == 0)
      return {};
    std::ostringstream text;
    text << "stress is " << std::setprecision(2) << largest_share
         << " of what makes the bodies buckle or, pulled, stiffens them as "
            "much (the largest eigenvalue of their geometric stiffness): "
            "'Strain = small' has that one step late at best, "
            "deflections differ by up to about as much, and from 1 on they "
            "grow without bound; 'Strain = finite' in section 'Method' knows "
            "of it, 'Mesh after step = keep' is for a linear analysis";
    return {text.str()};
  }



  template <int dim>
  void
  BucklingWatch<dim>::write(Archive &archive) const
  {
    archive.write("run/geometric_share", largest_share);
    archive.write("run/motion_of_share", motion_of_share, "length");
    archive.write("run/strain_at_resets", strain_at_resets);
  }



  template <int dim>
  void
  BucklingWatch<dim>::read(const Archive &archive)
  {
    largest_share    = archive.number("run/geometric_share");
    motion_of_share  = archive.number("run/motion_of_share");
    strain_at_resets = archive.number("run/strain_at_resets");
  }



  template class BucklingWatch<2>;
  template class BucklingWatch<3>;
} // namespace moraine
