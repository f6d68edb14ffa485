// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/hold_watch.h>

#include <moraine/assembly/load_terms.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>

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
    /** Of a cell: by then the force on a pressed column is 3 % too small. */
    constexpr double told_push = 0.25;

    /** What helps if the material must not be lost. */
    const std::string of_nodes =
      "nodes that 'Mesh motion' moves go along, and so "
      "does a boundary with 'Translation'";
    const std::string of_surfaces =
      "its surface stays while 'Displacement' moves the material; "
      "'Translation' moves both";
    const std::string of_sides = "'surface traction' goes with the material";

    /** Of a cell: by then stresses beside a pressed side are wrong by half. */
    constexpr double told_gap_at_side = 0.4;



    /** How far material is from the faces on which a side traction pushes, less
     * half the size of points, in the mean over faces and in cell sizes.
     * Collective. */
    template <int dim>
    double
    gap_at(const SideTraction<dim> &traction, const Model<dim> &model)
    {
      const PointSet<dim> &points = *model.points;
      std::vector<double>  sums(2, 0.);
      for (const auto &in_cell : points.cells())
        for (const unsigned int f : in_cell.cell->face_indices())
          {
            const auto face = in_cell.cell->face(f);
            if (!in_cell.cell->at_boundary(f) ||
                face->boundary_id() != traction.side)
              continue;
            const Tensor<1, dim> outward =
              face->center() - in_cell.cell->center();
            const double h = 2 * outward.norm();
            sums[0] += points.gap_before(in_cell.cell->active_cell_index(),
                                         face->center(),
                                         2 / h * outward,
                                         h) /
                       h;
            sums[1] += 1;
          }
      Utilities::MPI::sum(sums, model.space->communicator(), sums);
      return sums[1] > 0 ? sums[0] / sums[1] : 0.;
    }
  } // namespace



  template <int dim>
  HoldWatch<dim>::HoldWatch(const Scene<dim> &scene, const Model<dim> &model)
    : scene(scene)
    , model(model)
  {}



  template <int dim>
  void
  HoldWatch<dim>::stage_begins()
  {
    counted = false;
    most.clear();
  }



  template <int dim>
  std::vector<std::string>
  HoldWatch<dim>::look(const StageParameters &stage, const double t)
  {
    if (!counted || model.system->coupling_changed())
      count(stage, t);
    const MPI_Comm           communicator = model.space->communicator();
    std::vector<std::string> found;
    for (const auto &boundary : model.boundaries)
      if (contains(stage.boundaries, boundary.name()) &&
          !contains(stage.absorbing, boundary.name()))
        for (const auto &[name, parameters] : scene.boundaries)
          if (name == boundary.name())
            {
              const std::string  section = "Boundaries/" + name;
              const unsigned int n       = boundary.n_points(communicator);
              if (parameters.displacement.empty())
                found.push_back(torn_off(section, n, t));
              else
                {
                  found.push_back(moved_through(boundary, stage, t));
                  check_that_some_is_left(section, n, t, of_surfaces);
                }
            }
    for (unsigned int c = 0; c < conditions.size(); ++c)
      {
        found.push_back(pushed_off(c, stage, t));
        const std::string section = "Grid conditions/" + conditions[c].name;
        if (told.count(section) > 0)
          check_that_some_is_left(section, n_nodes[c], t, of_nodes);
      }
    for (const auto &traction : model.loads.side_tractions)
      if (contains(stage.loads, traction.name))
        {
          const auto faces =
            pushed_faces(traction, *model.space, *model.points);
          found.push_back(
            other_faces("Loads/" + traction.name, faces.size(), t));
          found.push_back(left_behind(traction, t));
        }
    found.erase(std::remove(found.begin(), found.end(), ""), found.end());
    return found;
  }



  template <int dim>
  void
  HoldWatch<dim>::count(const StageParameters &stage, const double t)
  {
    conditions = acting_conditions(model.grid_conditions, stage);
    std::vector<std::vector<HeldPlace>> now(conditions.size());
    n_nodes.assign(conditions.size(), 0);
    for (const auto &entry :
         find_prescribed_nodes(conditions, *model.space, t).entries)
      {
        now[entry.condition].push_back(
          {model.space->node_position(entry.node), entry.component});
        ++n_nodes[entry.condition];
      }
    Utilities::MPI::sum(n_nodes, model.space->communicator(), n_nodes);
    held.resize(conditions.size());
    for (unsigned int c = 0; c < conditions.size(); ++c)
      {
        unsigned int &largest = most["Grid conditions/" + conditions[c].name];
        if (!counted || n_nodes[c] >= largest)
          held[c] = now[c];
        largest = std::max(largest, n_nodes[c]);
      }
    counted = true;
  }



  template <int dim>
  std::string
  HoldWatch<dim>::pushed_off(const unsigned int     c,
                             const StageParameters &stage,
                             const double           t)
  {
    const GridCondition<dim> &condition = conditions[c];
    const std::string         section   = "Grid conditions/" + condition.name;
    if (model.state->mesh_after_step() != MeshAfterStep::reset ||
        model.mesh_motion.moves() || told.count(section) > 0)
      return "";
    // Along a side of a box other material comes.
    const bool of_box  = condition.side && model.mesh->box_grid();
    double     largest = 0;
    for (const HeldPlace &place : held[c])
      if (!of_box || place.component == *condition.side / 2)
        largest = std::max(largest,
                           std::abs(condition.increment(place.x,
                                                        place.x,
                                                        stage.time.start_time,
                                                        t)[place.component]));
    largest = Utilities::MPI::max(largest, model.space->communicator()) /
              model.mesh->cell_size();
    if (!(largest > told_push))
      return "";
    told.insert(section);
    std::ostringstream text;
    text << "grid condition '" << condition.name << "': by t = " << t
         << " it has pushed material by " << std::setprecision(2) << largest
         << " cell sizes, and its nodes stay: the force comes out too small, "
            "the more the further; "
         << of_nodes;
    return text.str();
  }



  template <int dim>
  std::string
  HoldWatch<dim>::moved_through(const ImplicitBoundary<dim> &boundary,
                                const StageParameters       &stage,
                                const double                 t)
  {
    const std::string section = "Boundaries/" + boundary.name();
    if (model.state->mesh_after_step() == MeshAfterStep::keep ||
        told.count(section) > 0)
      return "";
    // Inwards, outwards.
    std::vector<double> largest(2, 0.);
    for (const auto &point : boundary.points())
      {
        const double moved =
          boundary.moved_through(point, stage.time.start_time, t);
        largest[0] = std::max(largest[0], -moved);
        largest[1] = std::max(largest[1], moved);
      }
    Utilities::MPI::max(largest, model.space->communicator(), largest);
    const bool   out = largest[1] > largest[0];
    const double far = largest[out] / model.mesh->cell_size();
    if (!(far > told_push))
      return "";
    told.insert(section);
    std::ostringstream text;
    text << "boundary '" << boundary.name() << "': by t = " << t
         << " it has moved material by " << std::setprecision(2) << far
         << " cell sizes " << (out ? "out" : "in")
         << " through its surface, and holds what is there by now instead of "
            "the rim of the body; "
         << of_surfaces;
    return text.str();
  }



  template <int dim>
  std::string
  HoldWatch<dim>::torn_off(const std::string &section,
                           const unsigned int n,
                           const double       t)
  {
    unsigned int &largest = most[section];
    largest               = std::max(largest, n);
    // What flies may leave a wall.
    if (n > 0 || largest == 0 || model.system->step_context().motion ||
        !told.insert(section).second)
      return "";
    std::ostringstream text;
    text
      << "section '" << section << "': by t = " << t
      << " no material is left where it acts, and its force is zero: what it "
         "held has come off or torn; if it should not, shorter steps, "
         "smaller cells or 'Enforcement = skew Nitsche' may keep it";
    return text.str();
  }



  template <int dim>
  unsigned int
  HoldWatch<dim>::check_that_some_is_left(const std::string &section,
                                          const unsigned int n,
                                          const double       t,
                                          const std::string &remedy)
  {
    unsigned int &largest = most[section];
    largest               = std::max(largest, n);
    if (n > 0 || largest == 0)
      return largest;
    std::ostringstream text;
    text << "section '" << section << "': by t = " << t
         << " no material is left where it acts; " << remedy;
    throw ComputationError(text.str());
  }



  template <int dim>
  std::string
  HoldWatch<dim>::other_faces(const std::string &section,
                              const unsigned int n,
                              const double       t)
  {
    const auto         known = most.find(section);
    const unsigned int before =
      known == most.end() ? n : std::max(known->second, 1u);
    check_that_some_is_left(section, n, t, of_sides);
    if (n == before || !told.insert(section).second)
      return "";
    std::ostringstream text;
    text << "section '" << section << "': by t = " << t;
    if (n < before)
      text << " only " << n << " of " << before
           << " faces of cells are beside material and pushed on; ";
    else
      text << " material has come beside more of the side: it pushes on " << n
           << " whole faces of cells, " << before << " before; ";
    text << of_sides;
    return text.str();
  }



  template <int dim>
  std::string
  HoldWatch<dim>::left_behind(const SideTraction<dim> &traction, const double t)
  {
    const std::string section = "Loads/" + traction.name;
    if (model.state->mesh_after_step() != MeshAfterStep::reset ||
        model.mesh_motion.moves() || told.count(section) > 0)
      return "";
    const double gap = gap_at(traction, model);
    if (!(gap > told_gap_at_side))
      return "";
    told.insert(section);
    std::ostringstream text;
    text << "section '" << section << "': by t = " << t << " material is "
         << std::setprecision(2) << gap
         << " cell sizes away from the side of the mesh, on which it still "
            "pushes: stresses near it are wrong; "
         << of_sides;
    return text.str();
  }



  template <int dim>
  void
  HoldWatch<dim>::write(Archive &archive) const
  {
    std::ostringstream held;
    for (const auto &[section, n] : most)
      held << n << ' ' << section << '\n';
    archive.write_text("checks/holds/most", held.str());
    archive.write_lines("checks/holds/told", {told.begin(), told.end()});
  }



  template <int dim>
  void
  HoldWatch<dim>::read(const Archive &archive)
  {
    std::istringstream held(archive.text("checks/holds/most"));
    const auto         said = archive.lines("checks/holds/told");
    told                    = {said.begin(), said.end()};
    most.clear();
    counted        = false;
    unsigned int n = 0;
    for (std::string section;
         held >> n && std::getline(held >> std::ws, section);)
      most[section] = n;
  }



  template class HoldWatch<2>;
  template class HoldWatch<3>;
} // namespace moraine
