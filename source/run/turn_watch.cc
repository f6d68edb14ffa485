// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/turn_watch.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Of the largest elastic strain, in the norm of energy. */
    constexpr double told_share_of_turns = 0.2;

    /** A turn by a quarter of a degree: less is no stress to speak of. */
    constexpr double least_strain = 1e-5;



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
  } // namespace



  template <int dim>
  TurnWatch<dim>::TurnWatch(const Scene<dim> &scene, const Model<dim> &model)
    : model(model)
    , last(scene.start_time())
  {}



  template <int dim>
  std::string
  TurnWatch<dim>::look(const double                            t,
                       const std::vector<BoundaryReport<dim>> &reports)
  {
    const double before = last;
    last                = t;
    if (model.state->strain_measure() != StrainMeasure::small || told)
      return "";
    const bool  moves = model.state->mesh_after_step() != MeshAfterStep::keep;
    std::string worst;
    double      largest = least_strain;
    const auto  count   = [&](const std::string      &name,
                           const RigidMotion<dim> &motion) {
      if (!motion.turns() ||
          std::none_of(reports.begin(), reports.end(), [&](const auto &report) {
            return report.name == name;
          }))
        return;
      Turn &turn  = turns.try_emplace(name, Turn{before}).first->second;
      turn.strain = moves ? turn.strain + strain_of_turn(motion, before, t) :
                               strain_of_turn(motion, turn.since, t);
      if (turn.strain > largest)
        {
          largest = turn.strain;
          worst   = name;
        }
    };
    for (const auto &boundary : model.boundaries)
      count(boundary.name(), boundary.rigid_motion());
    for (const auto &condition : model.grid_conditions)
      count(condition.name, condition.motion);
    if (worst.empty())
      return "";
    const double share = largest / largest_strain_by_energy();
    if (!(share > told_share_of_turns))
      return "";
    told = true;
    std::ostringstream text;
    text << "'" << worst << "': by t = " << t
         << " it has turned what it holds, which small strain takes for a "
            "strain of "
         << std::setprecision(2) << largest << ", by its energy " << share
         << " times the largest that stress stands for; 'Strain = finite' "
            "knows of turns"
         << (moves ? ", and more 'Steps' make less of it" : "");
    return text.str();
  }



  template <int dim>
  double
  TurnWatch<dim>::largest_strain_by_energy() const
  {
    const PointSet<dim> &points  = *model.points;
    double               largest = 0;
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        const LameConstants C =
          model.materials[points.body(p)]->elastic_stiffness();
        const auto sigma = points.stress_field()(points.values(p));
        largest =
          std::max(largest,
                   sigma * C.strain_of(sigma) / (4 * (C.lambda + C.mu)));
      }
    return std::sqrt(Utilities::MPI::max(largest, model.space->communicator()));
  }



  template <int dim>
  void
  TurnWatch<dim>::write(Archive &archive) const
  {
    std::vector<std::string> names;
    std::vector<double>      values;
    for (const auto &[name, turn] : turns)
      {
        names.push_back(name);
        values.push_back(turn.since);
        values.push_back(turn.strain);
      }
    archive.write("checks/turns/last", last, "time");
    archive.write_lines("checks/turns/names", names);
    archive.write("checks/turns/since_and_strain", values, 2);
    archive.write("checks/turns/told", told ? 1u : 0u);
  }



  template <int dim>
  void
  TurnWatch<dim>::read(const Archive &archive)
  {
    last              = archive.number("checks/turns/last");
    told              = archive.integer("checks/turns/told") != 0;
    const auto values = archive.numbers("checks/turns/since_and_strain", 2);
    turns.clear();
    unsigned int k = 0;
    for (const std::string &name : archive.lines("checks/turns/names"))
      {
        turns[name] = {values[k], values[k + 1]};
        k += 2;
      }
  }



  template class TurnWatch<2>;
  template class TurnWatch<3>;
} // namespace moraine
