// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/load_notes.h>

#include <moraine/assembly/load_terms.h>
#include <moraine/core/exceptions.h>
#include <moraine/core/words.h>
#include <moraine/run/hold_watch.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Which cells material fills to less than nine tenths, on all ranks. Those
     * that go with their points are filled as at the start. */
    template <int dim>
    std::vector<bool>
    partly_filled_cells(const Model<dim> &model)
    {
      const bool resets =
        model.state->mesh_after_step() == MeshAfterStep::reset;
      std::vector<double> filled(model.mesh->triangulation().n_active_cells());
      for (const auto &in_cell : model.points->cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          filled[in_cell.cell->active_cell_index()] +=
            resets ? model.points->volume(p) : model.state->initial_volume(p);
      Utilities::MPI::sum(filled, model.space->communicator(), filled);
      std::vector<bool> partly(filled.size());
      for (const auto &cell :
           model.mesh->triangulation().active_cell_iterators())
        partly[cell->active_cell_index()] =
          filled[cell->active_cell_index()] < 0.9 * volume_of_cell(cell);
      return partly;
    }



    /** By how much the force of a load may change with finer places. */
    constexpr double told_force = 0.03;

    /** More points or faces than this are not looked at. */
    constexpr unsigned int most_points = 20000, most_faces = 2000;



    /** Of where an expression is no number the run tells when it comes there;
     * what is near a place that counts may be off the body. */
    template <int dim>
    Tensor<1, dim>
    value_or(const VectorFunction<dim> &value,
             const Point<dim>          &x,
             const double               t,
             const Tensor<1, dim>      &otherwise)
    {
      try
        {
          return value(x, t);
        }
      catch (const InputError &)
        {
          return otherwise;
        }
    }



    /** The force of a load by the places that count and by finer ones, and what
     * it would be by these without signs. */
    template <int dim>
    struct Forces
    {
      Tensor<1, dim> counts, finer;
      double         size = 0;

      void
      add_finer(const Tensor<1, dim> &force)
      {
        finer += force;
        size += force.norm();
      }

      double
      error() const
      {
        return size > 0 ? (counts - finer).norm() / size : 0.;
      }
    };



    template <int dim>
    Forces<dim>
    forces_of(const SideTraction<dim> &load,
              const Model<dim>        &model,
              const double             t)
    {
      const FE_Nothing<dim>    no_functions;
      const QIterated<dim - 1> finer(QGauss<1>(2), dim == 2 ? 64 : 8);
      const UpdateFlags flags = update_quadrature_points | update_JxW_values;
      FEFaceValues<dim> at_places(no_functions,
                                  side_quadrature<dim>(model.space->degree()),
                                  flags);
      FEFaceValues<dim> at_finer(no_functions, finer, flags);
      Forces<dim>       forces;
      for (const auto &cell :
           model.mesh->triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary() &&
            model.space->is_active(cell))
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() &&
                cell->face(f)->boundary_id() == load.side)
              {
                at_places.reinit(cell, f);
                at_finer.reinit(cell, f);
                Tensor<1, dim> value;
                for (const unsigned int q :
                     at_places.quadrature_point_indices())
                  {
                    value = value_or(load.value,
                                     at_places.quadrature_point(q),
                                     t,
                                     {});
                    forces.counts += at_places.JxW(q) * value;
                  }
                for (const unsigned int q : at_finer.quadrature_point_indices())
                  forces.add_finer(at_finer.JxW(q) *
                                   value_or(load.value,
                                            at_finer.quadrature_point(q),
                                            t,
                                            value));
              }
      return forces;
    }



    /** Each point stands for a cube of its volume. */
    template <int dim>
    Forces<dim>
    forces_of(const BodyForce<dim> &load,
              const Model<dim>     &model,
              const double          t)
    {
      const PointSet<dim> &points = *model.points;
      const QIterated<dim> of_cube(QMidpoint<1>(), dim == 2 ? 6 : 3);
      Forces<dim>          forces;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        if (load.acts_on[points.body(p)])
          {
            const unsigned int body = points.body(p);
            const double       V    = points.volume(p);
            const double       edge = std::pow(V, 1. / dim);
            const double       of_value =
              (load.times_density ? model.materials[body]->density() : 1.) * V;
            const Point<dim>     x     = load.at_start ?
                                           model.state->original_position(p) :
                                           points.position(p);
            const Tensor<1, dim> value = value_or(load.value, x, t, {});
            forces.counts += of_value * value;
            for (const Point<dim> &xi : of_cube.get_points())
              {
                Tensor<1, dim> way = xi;
                for (unsigned int d = 0; d < dim; ++d)
                  way[d] -= 0.5;
                forces.add_finer(
                  of_value / of_cube.size() *
                  value_or(load.value, x + edge * way, t, value));
              }
          }
      return forces;
    }



    /** That an expression changes so much between the places where it is
     * evaluated that its force is another one. */
    template <int dim, typename Load>
    void
    tell_of_coarse_places(const StageParameters    &stage,
                          const Load               &load,
                          const Model<dim>         &model,
                          std::vector<std::string> &notes)
    {
      const MPI_Comm communicator = model.space->communicator();
      Forces<dim>    worst;
      for (const double part : {0.4, 1.})
        {
          Forces<dim> forces =
            forces_of(load,
                      model,
                      stage.time.start_time +
                        part * (stage.time.end_time - stage.time.start_time));
          forces.counts = Utilities::MPI::sum(forces.counts, communicator);
          forces.finer  = Utilities::MPI::sum(forces.finer, communicator);
          forces.size   = Utilities::MPI::sum(forces.size, communicator);
          if (forces.error() > worst.error())
            worst = forces;
        }
      if (!(worst.error() > told_force))
        return;
      std::ostringstream text;
      text
        << std::setprecision(3) << "load " << load.name
        << ": the places where its expression is evaluated miss its force by "
        << per_cent(worst.error()) << " (" << worst.counts.norm()
        << ", by finer ones " << worst.finer.norm()
        << "); let it change on mesh lines, take smaller cells, or let it "
           "act on a drawn surface or body alone";
      notes.push_back(text.str());
    }
  } // namespace



  template <int dim>
  void
  check_loads(const StageParameters    &stage,
              const Model<dim>         &model,
              std::vector<std::string> &notes)
  {
    for (const auto &force : model.loads.body_forces)
      for (unsigned int b = 0; b < model.bodies.size(); ++b)
        if (force.times_density && force.acts_on[b] &&
            !(model.materials[b]->density() > 0))
          throw InputError("section 'Loads/" + force.name +
                           "': found gravity on body '" + model.bodies[b].name +
                           "', whose material has no 'Density', allowed: "
                           "bodies with a density > 0");
    for (const auto &traction : model.loads.side_tractions)
      {
        if (!contains(stage.loads, traction.name))
          continue;
        const auto faces = pushed_faces(traction, *model.space, *model.points);
        const unsigned int n_faces = faces.size();
        if (n_faces == 0)
          throw InputError("section 'Loads/" + traction.name +
                           "': found a side of the mesh without a body beside "
                           "it, allowed: a side that a body touches");
        const std::vector<bool> partly = partly_filled_cells(model);
        const unsigned int      n_partly =
          std::count_if(faces.begin(),
                        faces.end(),
                        [&partly](const CellFace<dim> &face) {
                          return partly[face.cell->active_cell_index()];
                        });
        if (n_partly > 0)
          notes.push_back(
            traction.name + ": " + std::to_string(n_partly) + " of the " +
            std::to_string(n_faces) +
            " faces of cells that it pushes on belong to cells that material "
            "fills in part, and are pushed on as a whole; 'surface traction' "
            "acts on the rim of a body");
        if (n_faces <= most_faces)
          tell_of_coarse_places(stage, traction, model, notes);
      }
    if (Utilities::MPI::sum(model.points->n_local(),
                            model.space->communicator()) <= most_points)
      for (const auto &force : model.loads.body_forces)
        if (contains(stage.loads, force.name))
          tell_of_coarse_places(stage, force, model, notes);
  }



  template <int dim>
  void
  tell_of_loads_outside(const Model<dim>         &model,
                        std::vector<std::string> &notes)
  {
    for (const auto &load : model.loads.carried)
      if (load.share_outside() > 0.01)
        notes.push_back(
          "load " + load.name() + ": " +
          std::to_string(std::lround(100 * load.share_outside())) +
          " % of its surface is outside the mesh or beside no body, "
          "where it does not act");
  }



#define INSTANTIATE(dim)                                  \
  template void check_loads(const StageParameters &,      \
                            const Model<dim> &,           \
                            std::vector<std::string> &);  \
  template void tell_of_loads_outside(const Model<dim> &, \
                                      std::vector<std::string> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
