// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/crossing_watch.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /**
     * Forces out of balance in the mean, and steps at least. Beams, bars and
     * columns of standard MPM whose forces or settlements were 7 to 70 % off
     * had 0.4 to 0.9 of them; blocks that hardly move, less than 0.2.
     */
    constexpr double       told_imbalance = 0.25;
    constexpr unsigned int told_steps     = 3;

    /** Stress over the stiffness of the stiffest material. */
    constexpr double unstressed = 1e-8;
  } // namespace



  template <int dim>
  CrossingWatch<dim>::CrossingWatch(const Scene<dim> &scene,
                                    const Model<dim> &model)
    : scene(scene)
    , model(model)
    , smallest_stress(unstressed * model.largest_modulus())
  {}



  template <int dim>
  bool
  CrossingWatch<dim>::has_stress() const
  {
    const PointSet<dim> &points = *model.points;
    const auto           stress = points.fields().find(FieldNames<dim>::stress);
    double               largest = 0;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      largest = std::max(largest, stress(points.values(p)).norm());
    return Utilities::MPI::max(largest,
                               model.mesh->triangulation().get_communicator()) >
           smallest_stress;
  }



  template <int dim>
  std::string
  CrossingWatch<dim>::look(const StageParameters &stage, const double t)
  {
    if (begins || told || stage.time.integrator.dynamic() ||
        scene.method.method != "material point" ||
        model.state->mesh_after_step() != MeshAfterStep::reset || !has_stress())
      {
        begins = false;
        return "";
      }
    ++n_steps;
    shares += model.system->unbalanced_share();
    if (n_steps < told_steps || shares < told_imbalance * n_steps)
      return "";
    told = true;
    std::ostringstream text;
    text
      << "points move through the mesh and leave equilibrium: by t = " << t
      << ", " << std::setprecision(2) << 100 * shares / n_steps
      << " % of the forces are out of balance at the start of a step. Each "
         "step takes this as a motion, so that bodies become too soft, the "
         "more the more steps there are; in section 'Method' 'Method = GIMP' "
         "or 'CPDI1' help";
    return text.str();
  }



  template <int dim>
  void
  CrossingWatch<dim>::write(Archive &archive) const
  {
    archive.write("checks/crossing/n_steps", n_steps);
    archive.write("checks/crossing/shares", shares);
    archive.write("checks/crossing/told", told ? 1u : 0u);
  }



  template <int dim>
  void
  CrossingWatch<dim>::read(const Archive &archive)
  {
    n_steps = archive.integer("checks/crossing/n_steps");
    shares  = archive.number("checks/crossing/shares");
    told    = archive.integer("checks/crossing/told") != 0;
    begins  = false;
  }



  template class CrossingWatch<2>;
  template class CrossingWatch<3>;
} // namespace moraine
