// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/step_checks.h>

#include <moraine/basis/body_parts.h>
#include <moraine/core/exceptions.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the volume of its body: less than that may splash. */
    constexpr double smallest_part = 0.01;

    /** A boundary that the material misses by more than both is told of. */
    constexpr double told_share_of_motion = 0.02;
    constexpr double told_share_of_cell   = 1e-3;

    /** Energy that the integrator made is told of from this part of the largest
     * on. */
    constexpr double told_share_of_energy = 0.01;



    /** What to say if a body fell into more parts of at least 1 % of its volume
     * than it had @p at_start; empty if none did. */
    template <int dim>
    std::string
    name_separation(const std::vector<std::vector<BodyPart<dim>>> &parts,
                    const std::vector<unsigned int>               &at_start,
                    const std::vector<std::string>                &body_names)
    {
      for (unsigned int b = 0; b < parts.size(); ++b)
        {
          double volume = 0;
          for (const auto &part : parts[b])
            volume += part.volume;
          const unsigned int next = at_start[b];
          if (parts[b].size() <= next ||
              parts[b][next].volume < smallest_part * volume)
            continue;
          std::ostringstream text;
          text << "body '" << body_names[b]
               << "' came apart: " << std::setprecision(3)
               << 100 * parts[b][next].volume / volume
               << " % of its volume, around (" << std::setprecision(6);
          for (unsigned int d = 0; d < dim; ++d)
            text << (d > 0 ? ", " : "") << parts[b][next].centre[d];
          text << "), share no node with the rest any more and carry no force "
                  "across";
          return text.str();
        }
      return "";
    }



    /** The energy of the stiffest material in all bodies at a strain of 1e-8.
     */
    template <int dim>
    double
    round_off_of_energy(const Model<dim> &model)
    {
      constexpr double strain  = 1e-8;
      double           modulus = 0;
      for (const auto &material : model.materials)
        {
          const LameConstants C = material->elastic_stiffness();
          modulus               = std::max(modulus, C.lambda + 2 * C.mu);
        }
      return strain * strain * modulus *
             std::accumulate(model.body_volumes.begin(),
                             model.body_volumes.end(),
                             0.);
    }
  } // namespace



  template <int dim>
  StepChecks<dim>::StepChecks(const Scene<dim> &scene, const Model<dim> &model)
    : scene(scene)
    , model(model)
    , energy(round_off_of_energy(model))
  {}



  template <int dim>
  std::string
  StepChecks<dim>::separation()
  {
    if (!n_parts.empty() && !model.system->coupling_changed())
      return "";
    const auto parts = parts_of_bodies(*model.space,
                                       *model.points,
                                       *model.basis,
                                       model.body_names.size());
    if (n_parts.empty())
      {
        for (const auto &of_body : parts)
          n_parts.push_back(of_body.size());
        return "";
      }
    const std::string found = name_separation(parts, n_parts, model.body_names);
    if (!found.empty() && scene.method.separation == "stop")
      throw ComputationError(
        found +
        ". Points that drift apart leave a cell empty between them: "
        "domains that follow the material and are split (methods CPDI1, "
        "CPDI2, and GIMP with 'Domain update = corners', unless "
        "'Split domains = false'), more points per direction or larger "
        "cells keep them together; 'Separation = note' in "
        "section 'Method' goes on");
    if (!found.empty())
      for (unsigned int b = 0; b < parts.size(); ++b)
        n_parts[b] = std::max<unsigned int>(n_parts[b], parts[b].size());
    return found;
  }



  template <int dim>
  std::vector<std::string>
  StepChecks<dim>::of_step(const double                            t,
                           const std::vector<BoundaryReport<dim>> &reports,
                           const double largest_motion)
  {
    std::vector<std::string> found;
    for (const BoundaryReport<dim> &report : reports)
      found.push_back(missed_boundary(t, report, largest_motion));
    found.push_back(energy_made(t));
    if (model.motion)
      {
        double work_of_motions = 0;
        for (const BoundaryReport<dim> &report : reports)
          work_of_motions += report.work_of_motion;
        energy.count(model.motion->works(), work_of_motions, t);
      }
    found.erase(std::remove(found.begin(), found.end(), ""), found.end());
    return found;
  }



  template <int dim>
  std::string
  StepChecks<dim>::missed_boundary(const double               t,
                                   const BoundaryReport<dim> &report,
                                   const double               largest_motion)
  {
    if (!(report.violation > told_share_of_motion * largest_motion) ||
        !(report.violation > told_share_of_cell * model.mesh->cell_size()) ||
        !missed.insert(report.name).second)
      return "";
    std::ostringstream text;
    text << "boundary '" << report.name << "': the material misses it by "
         << report.violation << ", "
         << std::round(100 * report.violation / largest_motion)
         << " % of the largest motion in the step to t = " << t
         << "; smaller cells or steps bring it closer";
    return text.str();
  }



  template <int dim>
  std::string
  StepChecks<dim>::energy_made(const double t)
  {
    if (!model.motion || told_of_energy)
      return "";
    const Works &works = model.motion->works();
    const double made  = -works.out_of_balance();
    // What a first step of next to no energy makes falls behind.
    const double before = share_made;
    share_made          = made / works.largest();
    if (!(share_made > told_share_of_energy) || share_made < before)
      return "";
    told_of_energy = true;
    std::ostringstream text;
    text << "energy grows without work: by t = " << t
         << " the integrator has made " << std::setprecision(2)
         << 100 * share_made
         << " % of the largest part of it; shorter steps, or 'Integrator = "
            "energy-momentum' or 'generalised-alpha', do not";
    return text.str();
  }



  template <int dim>
  void
  StepChecks<dim>::write(Archive &archive) const
  {
    archive.write("checks/parts_of_bodies", n_parts);
    std::string names;
    for (const std::string &name : missed)
      names += name + "\n";
    archive.write_text("checks/missed_boundaries", names);
    archive.write("checks/share_of_energy_made", share_made);
    archive.write("checks/told_of_energy", told_of_energy ? 1u : 0u);
    energy.write(archive);
  }



  template <int dim>
  void
  StepChecks<dim>::read(const Archive &archive)
  {
    n_parts = archive.integers("checks/parts_of_bodies");
    std::istringstream names(archive.text("checks/missed_boundaries"));
    missed.clear();
    for (std::string name; std::getline(names, name);)
      missed.insert(name);
    share_made     = archive.number("checks/share_of_energy_made");
    told_of_energy = archive.integer("checks/told_of_energy") != 0;
    energy.read(archive);
  }



  template class StepChecks<2>;
  template class StepChecks<3>;
} // namespace moraine
