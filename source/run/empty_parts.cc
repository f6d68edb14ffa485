// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// A stiffness of empty parts of cells, for nodes that too few points touch.

#include <moraine/core/words.h>
#include <moraine/run/step_driver.h>

#include <algorithm>
#include <iterator>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Tried in turn to hold nodes that too few points touch. */
    constexpr double automatic_fictitious_stiffness[] = {1e-10,
                                                         1e-8,
                                                         1e-6,
                                                         1e-4};
  } // namespace



  template <int dim>
  bool
  StepDriver<dim>::add_support(const double fraction, const bool if_needed)
  {
    MechanicsSystem<dim> &system = *model.system;
    auto term = std::make_unique<FictitiousStiffness<dim>>(fraction);
    term->begin_step(system.step_context());
    if (if_needed && !term->any_empty_part(system.step_context()))
      return false;
    support = term.get();
    system.add(std::move(term));
    return true;
  }



  template <int dim>
  bool
  StepDriver<dim>::may_support_more() const
  {
    return support && sums.n_fictitious_stiffness <
                        std::size(automatic_fictitious_stiffness);
  }



  template <int dim>
  bool
  StepDriver<dim>::hold_empty_parts()
  {
    if (method.fictitious_stiffness > 0 ||
        sums.n_fictitious_stiffness ==
          std::size(automatic_fictitious_stiffness))
      return false;
    MechanicsSystem<dim> &system = *model.system;
    const double          fraction =
      automatic_fictitious_stiffness[sums.n_fictitious_stiffness];
    if (!support || support->stiffness_fraction() == 0)
      {
        LA::Vector x;
        system.initial_guess(x);
        system.assemble(x, true);
        system.check_that_it_is_held(false);
      }
    if (support ? !support->any_empty_part(system.step_context()) :
                  !add_support(fraction, true))
      return false;
    support->set_fraction(fraction);
    ++sums.n_fictitious_stiffness;
    return true;
  }



  template <int dim>
  bool
  StepDriver<dim>::take_back_support()
  {
    if (!support || support->stiffness_fraction() == accepted_fraction)
      return false;
    support->set_fraction(accepted_fraction);
    return true;
  }



  template <int dim>
  void
  StepDriver<dim>::keep_support()
  {
    if (!support)
      return;
    accepted_fraction = support->stiffness_fraction();
    if (accepted_fraction > 0)
      diagnostics.report(
        {"fictitious-stiffness",
         "",
         accepted_fraction,
         0,
         "too few points touch some nodes: from t = " +
           text_of(time_control.time(), 3) + " empty parts of cells have " +
           text_of(accepted_fraction, 3) + " of the material's stiffness"});
    // What was no cure for this step may be one for a later one.
    sums.n_fictitious_stiffness =
      std::upper_bound(std::begin(automatic_fictitious_stiffness),
                       std::end(automatic_fictitious_stiffness),
                       accepted_fraction) -
      std::begin(automatic_fictitious_stiffness);
  }



#define INSTANTIATE(dim)                                                \
  template bool StepDriver<dim>::add_support(const double, const bool); \
  template bool StepDriver<dim>::may_support_more() const;              \
  template bool StepDriver<dim>::hold_empty_parts();                    \
  template bool StepDriver<dim>::take_back_support();                   \
  template void StepDriver<dim>::keep_support();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
