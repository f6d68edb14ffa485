// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/diagnostics/diagnostics.h>

#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/diagnostics/catalogue.h>
#include <moraine/diagnostics/checks.h>

#include <numeric>
#include <utility>

namespace moraine
{
  namespace
  {
    template <int dim>
    struct Asked
    {
      When               when;
      const char        *id;
      checks::Check<dim> check;
      bool               may_throw = false; ///< asked even if its id was found
    };

    template <int dim>
    const std::vector<Asked<dim>> &
    checks_in_order()
    {
      using namespace checks;
      static const std::vector<Asked<dim>> all{
        {When::stage, "surface-coverage", ends_in_cells<dim>},
        {When::stage, "surface-coverage", held_beside_bodies<dim>},
        {When::stage, "surface-place", away_from_bodies<dim>},
        {When::stage, "surface-place", inside_bodies<dim>},
        {When::stage, "nitsche-flux", nitsche_flux<dim>},
        {When::stage, "no-effect", idle_conditions<dim>},
        {When::stage, "coarse-load", coarse_loads<dim>},
        {When::stage, "load-outside", loads_outside<dim>},
        {When::stage, "point-volumes", full_cells<dim>},
        {When::stage, "point-volumes", uneven_cells<dim>},
        {When::stage, "point-volumes", volume_twice<dim>},
        {When::stage, "thin-body", thin_bodies<dim>},
        {When::stage, "shared-cells", shared_cells<dim>},
        {When::stage, "bodies-meet", near_bodies<dim>},
        {When::stage, "conflicting-constraints", conflicting_constraints<dim>},
        {When::stage, "absorbing-boundary", absorbing_at_rest<dim>},
        {When::stage, "absorbing-boundary", absorbing_on_new_bodies<dim>},
        {When::bodies_go, "removed-body", removed_bodies<dim>},
        {When::step_begins, "separation", separation<dim>},
        {When::step_begins, "lost-hold", lost_boundaries<dim>, true},
        {When::step_begins, "lost-hold", pushed_off_nodes<dim>, true},
        {When::step_begins, "cell-crossing", cell_crossing<dim>},
        {When::step_begins, "bodies-meet", bodies_meet<dim>},
        {When::step_begins, "surface-coverage", grown_past_ends<dim>},
        {When::step_ends, "surface-coverage", grown_past_ends<dim>},
        {When::step_ends, "surface-miss", missed_boundaries<dim>},
        {When::step_ends, "surface-miss", passed_boundaries<dim>, true},
        {When::step_ends, "points-apart", points_apart<dim>},
        {When::step_ends, "small-strain", turned_at_small_strain<dim>},
        {When::step_ends, "slide", slide<dim>},
        {When::step_ends, "large-domains", domains_beyond_cells<dim>},
        {When::step_ends, "returned-points", returned_points<dim>},
        {When::strains_end, "small-strain", strained_at_small_strain<dim>},
        {When::strains_end, "small-strain", moved_at_small_strain<dim>},
        {When::end, "no-effect", nothing_happened<dim>},
        {When::end, "stress", stress_resolution<dim>}};
      return all;
    }



    /** The energy of the stiffest material in all bodies at a strain of 1e-8.
     */
    template <int dim>
    double
    round_off_of_energy(const Facts<dim> &facts)
    {
      constexpr double strain = 1e-8;
      double           volume = 0;
      for (unsigned int p = 0; p < facts.of.points.n_local(); ++p)
        volume += facts.of.points.volume(p);
      return strain * strain * facts.largest_modulus() *
             dealii::Utilities::MPI::sum(volume, facts.communicator());
    }
  } // namespace



  template <int dim>
  Diagnostics<dim>::Diagnostics(const typename Facts<dim>::Objects &objects)
    : all_facts(objects)
    , energy(ledger, round_off_of_energy(all_facts))
  {
    for (const std::string &id : objects.scene.output.silence)
      diagnostic(id, place("Output", "Silence"));
  }



  template <int dim>
  bool
  Diagnostics<dim>::report(Finding finding)
  {
    finding.t = all_facts.now.t;
    if (contains(all_facts.of.scene.output.silence, finding.id) ||
        !ledger.add(finding))
      return false;
    if (listener)
      listener(finding);
    return true;
  }



  template <int dim>
  bool
  Diagnostics<dim>::ask(const When                         when,
                        const typename Facts<dim>::Moment &moment)
  {
    all_facts.set(moment);
    bool found = false;
    for (const Asked<dim> &asked : checks_in_order<dim>())
      if (asked.when == when &&
          (asked.may_throw ||
           (!ledger.has(asked.id) &&
            !contains(all_facts.of.scene.output.silence, asked.id))))
        if (const auto finding = asked.check(all_facts, ledger))
          found = report(*finding) || found;
    if (when == When::step_ends)
      ask_energy();
    return found;
  }



  template <int dim>
  void
  Diagnostics<dim>::ask_energy()
  {
    // Works are of dynamics alone.
    if (!all_facts.has_inertia())
      return;
    double work_of_motions = 0;
    for (const auto &report : *all_facts.now.reports)
      work_of_motions += report.work_of_motion;
    energy.count(all_facts.of.motion->works(),
                 work_of_motions,
                 all_facts.now.t);
    if (all_facts.now.between_parts)
      return;
    if (const double growth = energy.growth(); growth > 0)
      report({"energy-growth",
              energy.source(),
              growth,
              EnergyBalance::allowed_growth,
              "energy grows without work, by " + per_cent(growth) +
                " of what was given until t = " + text_of(all_facts.now.t, 3) +
                "; take shorter steps"});
  }



  template <int dim>
  void
  Diagnostics<dim>::stage_begins(const bool bodies_change,
                                 const bool motion_starts)
  {
    for (const char *const name : {"cell-crossing/stage",
                                   "slide/of stage",
                                   "lost-hold/of stage",
                                   "surface-miss/depth"})
      ledger.forget(name);
    if (motion_starts)
      energy.motion_starts();
    if (!bodies_change)
      return;
    ledger.forget("separation/");
    energy.bodies_change();
  }



  template <int dim>
  std::string
  Diagnostics<dim>::failure() const
  {
    return energy.failure();
  }



  template class Diagnostics<2>;
  template class Diagnostics<3>;
} // namespace moraine
