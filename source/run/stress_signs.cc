// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/stress_signs.h>

#include <moraine/core/words.h>
#include <moraine/points/linear_fit.h>
#include <moraine/run/stress_error.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What has to be filled of a cell that is fitted, and of one whose stress
     * does not depend on the cut. */
    constexpr double filled_to_fit = 0.75;
    constexpr double filled_half   = 0.5;

    /** Of points in a unit cell, in each direction, squared. */
    constexpr double least_spread = 0.01;

    /** Jumps over the deviatoric stress, and stress in cuts over that
     * elsewhere, that are told of: healthy scenes have up to 0.9 and 2.5. */
    constexpr double told_jump = 1;
    constexpr double told_cut  = 3;

    /** A saw tooth has jumps larger than steps, which are those of the field
     * that is there: 5 and more where volume locks, at most 1 elsewhere. */
    constexpr double told_saw = 2;

    /** Next to no stress, over the shear modulus; next to no strain energy,
     * over the kinetic energy. */
    constexpr double no_stress = 1e-6;
    constexpr double no_energy = 1e-3;

    /** Over the largest part of the energy of a run. */
    constexpr double no_share_of_energy = 1e-12;

    /** Estimated error of stress: healthy scenes have up to 0.2. */
    constexpr double told_error = 0.25;



    /** Mean stress in a unit cell: volume of what it is fitted to (0: none),
     * value in the middle and gradient. */
    template <int dim>
    struct Fit
    {
      double         volume = 0;
      double         middle = 0;
      Tensor<1, dim> gradient;

      double
      at(const Point<dim> &xi) const
      {
        return middle + gradient * (xi - unit_middle());
      }

      static Point<dim>
      unit_middle()
      {
        Point<dim> xi;
        for (unsigned int d = 0; d < dim; ++d)
          xi[d] = 0.5;
        return xi;
      }
    };



    template <int dim>
    Fit<dim>
    fit_mean_stress(const PointSet<dim>                      &points,
                    const typename PointSet<dim>::CellPoints &in_cell)
    {
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        if (points.body(p) != points.body(in_cell.first))
          return {};
      const LinearFit<dim, double> linear(
        points,
        in_cell,
        [&](const unsigned int p) {
          return points.reference_position(p) - Fit<dim>::unit_middle();
        },
        [&](const unsigned int p) {
          return trace(points.stress_field()(points.values(p))) / 3;
        },
        least_spread);
      if (!linear.is_complete())
        return {};
      Fit<dim> fit;
      fit.volume = linear.volume();
      fit.middle = linear.at(Tensor<1, dim>());
      for (unsigned int d = 0; d < dim; ++d)
        fit.gradient[d] = linear.gradient()[d];
      return fit;
    }



    /** Between the cells of this rank and those after them: the squares of
     * jumps and of steps times volumes, and the sum of these volumes. */
    template <int dim>
    std::array<double, 3>
    squares_of_jumps(const GridSpace<dim>      &space,
                     const std::vector<double> &fits)
    {
      const auto fit_of = [&](const auto &cell) {
        const double *values = &fits[(dim + 2) * cell->active_cell_index()];
        Fit<dim>      fit;
        fit.volume = values[0];
        fit.middle = values[1];
        std::copy_n(values + 2, dim, fit.gradient.begin_raw());
        return fit;
      };
      std::array<double, 3> sums{};
      for (const auto &cell :
           space.mesh().triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            {
              if (cell->at_boundary(f) || !cell->neighbor(f)->is_active() ||
                  cell->neighbor(f)->active_cell_index() <
                    cell->active_cell_index())
                continue;
              const Fit<dim> here  = fit_of(cell),
                             there = fit_of(cell->neighbor(f));
              if (here.volume == 0 || there.volume == 0)
                continue;
              const auto middle = [](const unsigned int face) {
                Point<dim> xi = Fit<dim>::unit_middle();
                xi[face / 2]  = face % 2;
                return xi;
              };
              const double jump =
                here.at(middle(f)) -
                there.at(middle(cell->neighbor_of_neighbor(f)));
              const double step   = here.middle - there.middle;
              const double volume = here.volume + there.volume;
              sums[0] += volume * jump * jump;
              sums[1] += volume * step * step;
              sums[2] += volume;
            }
      return sums;
    }
  } // namespace



  template <int dim>
  StressSigns
  stress_signs(const GridSpace<dim> &space, const PointSet<dim> &points)
  {
    std::vector<double> fits((dim + 2) *
                               space.mesh().triangulation().n_active_cells(),
                             0.);
    double              squares = 0, volume = 0;
    StressSigns         signs;
    for (const auto &in_cell : points.cells())
      {
        double largest = 0, filled = 0;
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          {
            const auto   stress = points.stress_field()(points.values(p));
            const double v      = points.volume(p);
            squares += v * deviator(stress).norm() * deviator(stress).norm();
            filled += v;
            largest = std::max(largest, stress.norm());
          }
        volume += filled;
        filled /= volume_of_cell(in_cell.cell);
        double &of_kind =
          filled < filled_half ? signs.in_cuts : signs.elsewhere;
        of_kind = std::max(of_kind, largest);
        if (filled < filled_to_fit)
          continue;
        const Fit<dim> fit = fit_mean_stress(points, in_cell);
        double *to = &fits[(dim + 2) * in_cell.cell->active_cell_index()];
        to[0]      = fit.volume;
        to[1]      = fit.middle;
        std::copy_n(fit.gradient.begin_raw(), dim, to + 2);
      }
    const MPI_Comm communicator = space.communicator();
    Utilities::MPI::sum(fits, communicator, fits);
    std::array<double, 3> sums = squares_of_jumps(space, fits);
    for (double &sum : sums)
      sum = Utilities::MPI::sum(sum, communicator);
    if (sums[2] > 0)
      {
        signs.jump = std::sqrt(sums[0] / sums[2]);
        signs.step = std::sqrt(sums[1] / sums[2]);
      }
    volume = Utilities::MPI::sum(volume, communicator);
    signs.deviatoric =
      std::sqrt(Utilities::MPI::sum(squares, communicator) / volume);
    signs.in_cuts   = Utilities::MPI::max(signs.in_cuts, communicator);
    signs.elsewhere = Utilities::MPI::max(signs.elsewhere, communicator);
    return signs;
  }



  namespace
  {
    /** Whether what moves has next to none of the energy as strain. */
    template <int dim>
    bool
    has_no_energy(const Model<dim> &model)
    {
      if (!model.system->step_context().motion)
        return false;
      const Works &works = model.motion->works();
      return works.stored <= no_energy * works.kinetic ||
             works.stored <= no_share_of_energy * works.largest();
    }



    /** Whether no point has moved since the start or has a stress. Collective.
     */
    template <int dim>
    bool
    nothing_happened(const Model<dim> &model)
    {
      const PointSet<dim> &points = *model.points;
      const auto           u      = points.displacement_field();
      const auto           stress = points.stress_field();
      bool                 any    = points.forgotten_displacement() > 0;
      for (const auto &in_cell : points.cells())
        for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
          any = any || u(points.values(p)).norm() > 0 ||
                stress(points.values(p)).norm() > 0;
      return !Utilities::MPI::logical_or(any, model.space->communicator());
    }



    template <int dim>
    bool
    is_at_rest(const Model<dim> &model, const StressSigns &signs)
    {
      double mu = std::numeric_limits<double>::max();
      for (const auto &material : model.materials)
        mu = std::min(mu, material->elastic_stiffness().mu);
      return !(signs.deviatoric > no_stress * mu) || has_no_energy(model);
    }



    /** Stress is a mean over cells, and volumetric strain cannot be one. */
    template <int dim>
    bool
    may_lock_unseen(const Scene<dim> &scene)
    {
      return scene.method.chosen().has_own_internal_force &&
             std::any_of(scene.materials.begin(),
                         scene.materials.end(),
                         [](const auto &named) {
                           return named.second.hardly_changes_volume();
                         });
    }



    /** That mean stress is a saw tooth, or "". */
    template <int dim>
    std::string
    doubt_of_saw(const MethodParameters<dim> &method, const StressSigns &signs)
    {
      if (!(signs.jump > told_jump * signs.deviatoric) ||
          !(signs.jump > told_saw * signs.step))
        return "";
      std::ostringstream text;
      text << std::setprecision(3) << "mean stress jumps from cell to cell by "
           << signs.jump << " (root of the mean square), "
           << signs.jump / signs.deviatoric
           << " times the deviatoric stress: do not trust it, nor forces and "
              "displacements if material flows or hardly changes its volume";
      if (method.volumetric() == VolumetricStrain::pointwise &&
          method.can_average_volume())
        text << "; there 'Volumetric strain = cell mean' in section 'Method' "
                "helps";
      if (method.method == "material point")
        text << "; where points cross cells 'Method = GIMP' does";
      return text.str();
    }



    /** That stress is largest where little of a cell is filled, or "". Where
     * all cells are filled that little there is nothing to compare with. */
    template <int dim>
    std::string
    doubt_of_cuts(const MethodParameters<dim> &method, const StressSigns &signs)
    {
      if (!(signs.elsewhere > 0) ||
          !(signs.in_cuts > told_cut * signs.elsewhere))
        return "";
      std::ostringstream text;
      text
        << std::setprecision(3)
        << "stress of points in cells that are filled by less than a half is "
           "up to "
        << signs.in_cuts / signs.elsewhere
        << " times that of all others: it depends on where the mesh cuts";
      if (method.aggregate_below < 0.5)
        text << "; 'Aggregate below = "
             << (method.aggregate_below < 0.1 ? 0.1 : 0.5)
             << "' in section 'Method' helps";
      return text.str();
    }



    /** That the estimated @p error of stress is large, or "". */
    template <int dim>
    std::string
    doubt_of_error(const MethodParameters<dim> &method,
                   const Model<dim>            &model,
                   const std::optional<double> &error)
    {
      if (!error || !(*error > told_error))
        return "";
      const bool pointwise = method.volumetric() == VolumetricStrain::pointwise;
      std::ostringstream text;
      text << "cells do not resolve the stress: its error is estimated at "
           << per_cent(*error) << " in the energy norm";
      // Means over cells make bending too soft, not too stiff.
      if (*error < 1 && pointwise)
        text << ", of an elastic body by forces " << per_cent(*error * *error)
             << " of the deflection";
      text << "; smaller cells help, but where bands form";
      if (!pointwise && model.basis->has_domains() &&
          model.state->strain_measure() == StrainMeasure::finite)
        text << " and where a body is stretched to twice its length and more "
                "with means over cells: compare with 'Volumetric strain = "
                "pointwise' in section 'Method' there";
      return text.str();
    }
  } // namespace



  template <int dim>
  std::optional<double>
  stress_error(const Model<dim> &model)
  {
    if (has_no_energy(model))
      return {};
    std::vector<LameConstants> moduli;
    for (const auto &material : model.materials)
      moduli.push_back(material->elastic_stiffness());
    return estimated_stress_error(*model.points, moduli);
  }



  template <int dim>
  std::vector<std::string>
  doubts_of_stress(const Scene<dim>            &scene,
                   const Model<dim>            &model,
                   const std::optional<double> &error)
  {
    if (nothing_happened(model))
      return {"nothing has moved or been stressed by the end: no load, motion "
              "or initial value of this scene acts on its bodies"};
    const StressSigns signs = stress_signs(*model.space, *model.points);
    if (is_at_rest(model, signs))
      return {};
    if (const std::string saw = doubt_of_saw(scene.method, signs); !saw.empty())
      return {saw};
    std::vector<std::string> doubts;
    // Of waves the end is one moment, which may have next to no stress.
    if (!model.system->step_context().motion)
      for (const std::string &doubt :
           {doubt_of_cuts(scene.method, signs),
            doubt_of_error(scene.method, model, error)})
        if (!doubt.empty())
          doubts.push_back(doubt);
    if (doubts.empty() && may_lock_unseen(scene))
      doubts.push_back(
        "method '" + scene.method.method +
        "' keeps the volume of every point and smooths stress, which does not "
        "show where that makes a body much too stiff, as with a Poisson ratio "
        "near 0.5 or in plastic flow: compare with 'Method = GIMP', whose "
        "cells have means of the volumetric strain");
    return doubts;
  }



  template std::vector<std::string>
  doubts_of_stress(const Scene<2> &,
                   const Model<2> &,
                   const std::optional<double> &);
  template std::optional<double>
  stress_error(const Model<2> &);
  template std::vector<std::string>
  doubts_of_stress(const Scene<3> &,
                   const Model<3> &,
                   const std::optional<double> &);
  template std::optional<double>
  stress_error(const Model<3> &);
  template StressSigns
  stress_signs(const GridSpace<2> &, const PointSet<2> &);
  template StressSigns
  stress_signs(const GridSpace<3> &, const PointSet<3> &);
} // namespace moraine
