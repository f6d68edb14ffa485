// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/step_checks.h>

#include <moraine/basis/body_parts.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

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

    /** Of a cell: material that has come this far behind a boundary is told of.
     */
    constexpr double told_passing = 0.1;

    /** Of the size of a body: parts that move by more against each other have
     * turned by 20 degrees, or stretched by a third. */
    constexpr double told_difference = 0.35;

    /** Points that are stretched apart are told of from these values of
     * unevenness() on. Of a bar on mesh lines with 2, 3 and 4 points per
     * direction and cell the force is 5 to 11 % too small by then, with boxes
     * that keep their size 7 %. */
    constexpr double told_stretch_of_points = 0.03;
    constexpr double told_stretch_of_boxes  = 0.75;

    constexpr const char *how_points_stay_together =
      "domains that follow the material and are split (methods CPDI1, CPDI2, "
      "and GIMP with 'Domain update = corners', unless 'Split domains = "
      "false'), more points per direction or larger cells ";



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



    /** How unevenly cells share points that were @p distance cells apart and
     * are stretched by @p lambda: by how much a cell of @f$1/d@f$ points per
     * direction that has one less is too soft, @f$(\lambda-1)d^2@f$; of boxes
     * that keep their size the distance itself, @f$\lambda d@f$. */
    double
    unevenness(const double lambda, const double distance, const bool has_boxes)
    {
      return has_boxes ? lambda * distance : (lambda - 1) * distance * distance;
    }



    /** The largest stretch of the distance to a neighbour along an axis. */
    template <int dim>
    double
    largest_stretch(const Tensor<2, dim> &F)
    {
      double largest = 0;
      for (unsigned int j = 0; j < dim; ++j)
        {
          double square = 0;
          for (unsigned int i = 0; i < dim; ++i)
            square += F[i][j] * F[i][j];
          largest = std::max(largest, square);
        }
      return std::sqrt(largest);
    }



    /** The energy of the stiffest material in all bodies at a strain of 1e-8.
     */
    template <int dim>
    double
    round_off_of_energy(const Model<dim> &model)
    {
      constexpr double strain = 1e-8;
      return strain * strain * model.largest_modulus() *
             std::accumulate(model.body_volumes.begin(),
                             model.body_volumes.end(),
                             0.);
    }



  } // namespace



  template <int dim>
  StepChecks<dim>::StepChecks(const Scene<dim> &scene, const Model<dim> &model)
    : scene(scene)
    , model(model)
    , energy(round_off_of_energy(model),
             [this](const EnergySource source) {
               return remedy_of_energy(source);
             })
    , holds(scene, model)
    , crossings(scene, model)
    , turns(scene, model)
    , slides(scene.any_yields(), model.mesh->cell_size(), scene.start_time())
    , passes(model)
    , ends(model)
  {}



  template <int dim>
  void
  StepChecks<dim>::stage_begins(const bool bodies_change,
                                const bool motion_starts)
  {
    holds.stage_begins();
    crossings.stage_begins();
    slides.stage_begins();
    depths.clear();
    if (motion_starts)
      energy.motion_starts();
    if (!bodies_change)
      return;
    n_parts.clear();
    energy.bodies_change();
  }



  template <int dim>
  std::vector<std::string>
  StepChecks<dim>::of_begun_step(const StageParameters &stage, const double t)
  {
    std::vector<std::string> found = holds.look(stage, t);
    const std::string        apart = separation();
    for (const std::string &text :
         {apart, crossings.look(stage, t), passes.look(stage, t)})
      if (!text.empty())
        found.push_back(text);
    ends.step_begins(stage);
    return found;
  }



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
        found + ". Points that drift apart leave a cell empty between them: " +
        how_points_stay_together +
        "keep them together; 'Separation = note' in section 'Method' goes on");
    if (!found.empty())
      for (unsigned int b = 0; b < parts.size(); ++b)
        n_parts[b] = std::max<unsigned int>(n_parts[b], parts[b].size());
    return found;
  }



  template <int dim>
  std::vector<std::string>
  StepChecks<dim>::of_step(const TimeControl                      &time,
                           const IntegratorParameters             &rule,
                           const std::vector<BoundaryReport<dim>> &reports,
                           const double largest_motion,
                           const double of_points)
  {
    const double             t = time.time();
    std::vector<std::string> found;
    integrator = rule.integrator;
    transfer   = rule.transfer;
    for (const BoundaryReport<dim> &report : reports)
      {
        found.push_back(missed_boundary(t, report, of_points));
        found.push_back(passed_boundary(t, report));
      }
    for (const std::string &text : ends.look(reports, t))
      found.push_back(text);
    found.push_back(points_apart(t));
    found.push_back(moved_far(t));
    found.push_back(turns.look(t, reports));
    passes.add_motion(largest_motion);
    found.push_back(
      slides.look(t,
                  largest_motion,
                  !model.system->step_context().motion &&
                    !time.follows_path() &&
                    model.state->mesh_after_step() != MeshAfterStep::keep));
    // Works are of dynamics alone.
    if (model.system->step_context().motion)
      {
        double work_of_motions = 0;
        for (const BoundaryReport<dim> &report : reports)
          work_of_motions += report.work_of_motion;
        energy.count(model.motion->works(), work_of_motions, t);
        if (!time.between_parts())
          found.push_back(energy.warning());
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
    // In waves the motion of one step is no measure of what one step misses.
    if (model.system->step_context().motion ||
        !(report.violation > told_share_of_motion * largest_motion) ||
        !(report.violation > told_share_of_cell * model.mesh->cell_size()) ||
        !missed.insert(report.name).second)
      return "";
    std::ostringstream text;
    text
      << "boundary '" << report.name << "': the material misses it by "
      << report.violation << ", "
      << std::round(100 * report.violation / largest_motion)
      << " % of the largest motion in the step to t = " << t
      << "; smaller cells or steps, or one that ends on faces of cells, bring "
         "it closer";
    return text.str();
  }



  template <int dim>
  std::string
  StepChecks<dim>::passed_boundary(const double               t,
                                   const BoundaryReport<dim> &report)
  {
    const auto [depth, is_new] =
      depths.try_emplace(report.name, report.penetration);
    // HoldWatch tells where that moves it through the surface.
    const bool has_displacement =
      std::any_of(scene.boundaries.begin(),
                  scene.boundaries.end(),
                  [&report](const auto &boundary) {
                    return boundary.first == report.name &&
                           !boundary.second.displacement.empty();
                  });
    if (is_new || has_displacement || missed.count(report.name) > 0 ||
        !(report.penetration - depth->second >
          told_passing * model.mesh->cell_size()))
      return "";
    depth->second = std::numeric_limits<double>::infinity();
    std::ostringstream text;
    text << "boundary '" << report.name << "': material has passed it by "
         << report.penetration << " in the step to t = " << t
         << ", in cells that have let go of it, as beside another boundary, or "
            "that do not see it: its force and the stress there are too small; "
            "smaller cells help";
    return text.str();
  }



  template <int dim>
  std::string
  StepChecks<dim>::points_apart(const double t)
  {
    const bool has_boxes = model.basis->has_domains();
    if (!scene.method.points_drift_apart(has_boxes) ||
        stretched.size() == model.body_names.size())
      return "";
    const PointSet<dim> &points = *model.points;
    const auto F  = points.fields().find(FieldNames<dim>::deformation_gradient);
    const auto v0 = points.fields().find(FieldNames<dim>::initial_volume);
    const double told =
      has_boxes ? told_stretch_of_boxes : told_stretch_of_points;
    const unsigned int  n_bodies = model.body_names.size();
    std::vector<double> volume(2 * n_bodies, 0.), largest(n_bodies, 0.);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const unsigned int b      = points.body(p);
        const double       v      = v0(points.values(p));
        const double       lambda = largest_stretch(F(points.values(p)));
        volume[n_bodies + b] += v;
        if (unevenness(lambda,
                       std::pow(v, 1. / dim) / model.mesh->cell_size(),
                       has_boxes) > told)
          volume[b] += v;
        largest[b] = std::max(largest[b], lambda);
      }
    const MPI_Comm communicator =
      model.mesh->triangulation().get_communicator();
    Utilities::MPI::sum(volume, communicator, volume);
    Utilities::MPI::max(largest, communicator, largest);
    for (unsigned int b = 0; b < n_bodies; ++b)
      if (volume[b] > smallest_part * volume[n_bodies + b] &&
          stretched.insert(b).second)
        {
          std::ostringstream text;
          text
            << "body '" << model.body_names[b] << "': by t = " << t
            << " neighbouring points are up to " << std::setprecision(3)
            << largest[b]
            << " times as far apart as at first, so that some cells hold too few: "
               "forces across come out too small, the more the further; "
            << how_points_stay_together << "carry them";
          return text.str();
        }
    return "";
  }



  template <int dim>
  std::string
  StepChecks<dim>::moved_far(const double t)
  {
    const unsigned int n_bodies = model.body_names.size();
    if (model.state->strain_measure() != StrainMeasure::small ||
        far.size() == n_bodies)
      return "";
    // Coordinates at the start, and with the other sign, the same of motions,
    // and their size.
    constexpr unsigned int n = 4 * dim + 1;
    std::vector<double>    largest(n * n_bodies,
                                std::numeric_limits<double>::lowest());
    const PointSet<dim>   &points = *model.points;
    const auto             u      = points.displacement_field();
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const Tensor<1, dim> motion = u(points.values(p));
        const Point<dim>     start  = points.position(p) - motion;
        double              *of     = largest.data() + n * points.body(p);
        for (unsigned int d = 0; d < dim; ++d)
          {
            of[2 * d]             = std::max(of[2 * d], start[d]);
            of[2 * d + 1]         = std::max(of[2 * d + 1], -start[d]);
            of[2 * (dim + d)]     = std::max(of[2 * (dim + d)], motion[d]);
            of[2 * (dim + d) + 1] = std::max(of[2 * (dim + d) + 1], -motion[d]);
          }
        of[4 * dim] = std::max(of[4 * dim], motion.norm());
      }
    Utilities::MPI::max(largest,
                        model.mesh->triangulation().get_communicator(),
                        largest);
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
        const bool moved = of[4 * dim] > size && !scene.is_dynamic();
        // Who lets nothing move wants what is linear.
        const bool parted =
          differ > told_difference * size &&
          model.state->mesh_after_step() != MeshAfterStep::keep;
        if (!(moved || parted) || !far.insert(b).second)
          continue;
        std::ostringstream text;
        text << "body '" << model.body_names[b] << "': by t = " << t
             << (moved ? " it has moved by " :
                         " parts of it have moved against each other by ")
             << std::setprecision(3) << (moved ? of[4 * dim] : differ) / size
             << " times its size, and small strain knows of no lengths and "
                "directions that change; 'Strain = finite' does";
        return text.str();
      }
    return "";
  }



  template <int dim>
  std::string
  StepChecks<dim>::remedy_of_energy(const EnergySource source) const
  {
    const MethodParameters<dim> &method = scene.method;
    const bool                   has_nitsche =
      std::any_of(model.boundaries.begin(),
                  model.boundaries.end(),
                  [](const auto &boundary) {
                    return boundary.enforcement().is_nitsche();
                  });
    std::string key;
    if (source == EnergySource::boundaries && has_nitsche)
      key = "a larger 'Nitsche factor'";
    else if (source == EnergySource::transfers && transfer != "APIC")
      key = "'Velocity transfer = APIC'";
    else if (source != EnergySource::integrator && method.aggregate_below < 0.1)
      key = "'Aggregate below = 0.1'";
    else if (source != EnergySource::integrator &&
             method.method == "material point")
      key = "'Method = GIMP'";
    else if (source != EnergySource::transfers &&
             integrator != "energy-momentum" &&
             !method.chosen().has_own_internal_force &&
             method.volumetric() != VolumetricStrain::cell_mean)
      key = "'Integrator = energy-momentum'";
    else if (contains({"Newmark", "Bathe"}, integrator))
      key = "'Integrator = generalised-alpha'";
    return key + (key.empty() ? "" : " or ") + "shorter steps";
  }



  template <int dim>
  void
  StepChecks<dim>::write(Archive &archive) const
  {
    archive.write("checks/parts_of_bodies", n_parts);
    archive.write_lines("checks/missed_boundaries",
                        {missed.begin(), missed.end()});
    std::vector<std::string> names_of_depths;
    std::vector<double>      behind;
    for (const auto &[name, depth] : depths)
      {
        names_of_depths.push_back(name);
        behind.push_back(depth);
      }
    archive.write_lines("checks/boundaries_with_depths", names_of_depths);
    archive.write("checks/depths_behind_boundaries", behind, 1, "length");
    archive.write("checks/stretched_bodies",
                  std::vector<unsigned int>(stretched.begin(),
                                            stretched.end()));
    archive.write("checks/far_bodies",
                  std::vector<unsigned int>(far.begin(), far.end()));
    energy.write(archive);
    holds.write(archive);
    crossings.write(archive);
    turns.write(archive);
    slides.write(archive);
    passes.write(archive);
    ends.write(archive);
  }



  template <int dim>
  void
  StepChecks<dim>::read(const Archive &archive)
  {
    n_parts                    = archive.integers("checks/parts_of_bodies");
    const auto names           = archive.lines("checks/missed_boundaries");
    missed                     = {names.begin(), names.end()};
    const auto names_of_depths = archive.lines("checks/boundaries_with_depths");
    const auto behind = archive.numbers("checks/depths_behind_boundaries", 1);
    depths.clear();
    for (unsigned int i = 0; i < behind.size(); ++i)
      depths[names_of_depths[i]] = behind[i];
    const auto bodies_of = [&](const std::string &name) {
      const std::vector<unsigned int> bodies = archive.integers(name);
      return std::set<unsigned int>(bodies.begin(), bodies.end());
    };
    stretched = bodies_of("checks/stretched_bodies");
    far       = bodies_of("checks/far_bodies");
    energy.read(archive);
    holds.read(archive);
    crossings.read(archive);
    turns.read(archive);
    slides.read(archive);
    passes.read(archive);
    ends.read(archive);
  }



  template class StepChecks<2>;
  template class StepChecks<3>;
} // namespace moraine
