// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_contact_boundary_h
#define moraine_boundary_contact_boundary_h

#include <moraine/boundary/contact_law.h>
#include <moraine/boundary/enforcement.h>
#include <moraine/core/simulation_state.h>
#include <moraine/geometry/carried_places.h>
#include <moraine/geometry/shape.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace moraine
{
  /** State of a place of the rim, kept from step to step. */
  template <int dim>
  struct ContactPlace
  {
    dealii::Tensor<1, dim> traction; ///< on the body [stress]
    /** Of Nitsche's method: what the shear traction has over that of the stress
     * beside it, @f$-c_t@f$ times the slip since the place stuck [stress]. */
    dealii::Tensor<1, dim> excess;
    /** Since the contact began, where places stay in the mesh. */
    dealii::Tensor<1, dim> displacement;
    double                 slip   = 0; ///< path along the surface [length]
    double                 work   = 0; ///< of friction [force length/area]
    double                 status = 1; ///< of ContactStatus; at first stick
    double                 body   = 0; ///< whose rim it is of
  };

  /**
   * The places of the rim in a cell, and in cells next to it if they are less
   * than half a cell. They share one mean gap and one status: shorter units
   * over-constrain the cells, and their tractions oscillate. The same on all
   * ranks.
   */
  template <int dim>
  struct ContactUnit
  {
    std::vector<unsigned int> places;   ///< numbers, ascending
    dealii::Point<dim>        x;        ///< mean place at the start of the step
    dealii::Tensor<1, dim>    normal;   ///< of the surface, out of the body
    double                    area = 0; ///< of the rim
    unsigned int              cell = 0; ///< of the first place
    double                    h    = 0; ///< size of that cell
    double                    gap  = 0; ///< mean, at the start of the step
    /** Mean gap at the start minus the level of the surface at @p x; not zero
     * on curved surfaces. */
    double                 level = 0;
    dealii::Tensor<1, dim> traction_at_start;
    dealii::Tensor<1, dim> excess;     ///< mean, at the start
    dealii::Tensor<1, dim> multiplier; ///< t of the present pass
    bool                   was_open = false;
    /** All places are in front of the surface and were open before. */
    bool apart = false;
    /** No unit touches the surface yet, or it begins to act: the first tangent
     * lets this one stick, as nothing else may hold the body. */
    bool touches_first = false;
  };

  /** The end of a step at the mean place of a unit. */
  template <int dim>
  struct ContactGap
  {
    double                 gap; ///< positive: apart
    dealii::Tensor<1, dim> normal;
    dealii::Tensor<1, dim> of_surface; ///< its motion, @f$\Delta g@f$
    /** @f$(1 - n \otimes n)(\Delta u - \Delta g)@f$ */
    dealii::Tensor<1, dim> slip;
  };

  /**
   * A rigid surface that bodies touch, let go and rub. The rim of the bodies
   * carries places with it, so that a gap is known after they parted and
   * contact ends where the body does. The gap is the distance from the surface
   * at the end of the step, @f$\phi_{n+1}(x + \Delta u)@f$, never a sum.
   */
  template <int dim>
  class ContactBoundary : public StatePart
  {
  public:
    using Place = typename CarriedPlaces<dim>::Place;
    /** The places of the rim of a body in the mesh as it was built. */
    using Finder = std::function<std::vector<Place>(const BackgroundMesh<dim> &,
                                                    const unsigned int body)>;

    ContactBoundary(const std::string         &name,
                    const SurfacePointer<dim> &surface,
                    const RigidMotion<dim>    &motion,
                    const Finder              &find_places,
                    const ContactLaw          &law,
                    const Enforcement         &enforcement);

    /** Place the surface at the start @p t of a step and find the cells of the
     * places. Rims of new bodies are added, those of removed ones deleted;
     * @p present by number. When the surface or a body becomes active, places
     * with a gap of at most 1e-6 h start in contact. @p turns says that normals
     * turn with the material. Collective. */
    void
    find_cells(const GridSpace<dim>    &space,
               const double             search_tolerance,
               const double             t,
               const bool               acts,
               const bool               turns,
               const std::vector<bool> &present);

    /** Find the units of the step. Collective. */
    void
    find_units(const GridSpace<dim> &space);

    /** Aim at @p t_end, with the multipliers of the start if @p anew. */
    void
    set_target(const double t_end, const bool anew);

    /** Where a unit is if its mean place moves by @p du. */
    ContactGap<dim>
    gap(const ContactUnit<dim> &unit, const dealii::Tensor<1, dim> &du) const;

    /** Depth behind the surface at the end of the step of the place @p k that
     * moves by @p du; 0 if it is in front, beyond the ends, or on the other
     * side of the wall. */
    double
    depth(const unsigned int k, const dealii::Tensor<1, dim> &du) const;

    /** Result of a step for a unit; all its places take it over. */
    struct OfUnit
    {
      dealii::Tensor<1, dim> traction, excess; ///< of ContactPlace
      ContactStatus          status = ContactStatus::open;
      double                 slip   = 0; ///< of the step
      double                 work   = 0; ///< of friction in it, per area
    };
    /** Compute the state at the end of the step, and where the places move.
     * Nothing changes before keep(). Collective. */
    void
    prepare(const std::vector<OfUnit>                                 &of_units,
            const std::vector<typename CarriedPlaces<dim>::Increment> &moves,
            const bool moves_places,
            const bool through_mesh,
            const bool turns);

    /** Where a place is now. */
    dealii::Point<dim>
    position(const unsigned int k) const
    {
      return rim.places()[k].x + carried[k].displacement;
    }

    /** The state of place @p k. */
    const ContactPlace<dim> &
    at_place(const unsigned int k) const
    {
      return carried[k];
    }

    /** Distance of a place from the surface at the start of the step, negative
     * behind it; none if it is beyond its ends, or the rim does not face it. */
    std::optional<double>
    distance_at_start(const unsigned int k) const;

    /** Whether it did not act in the last step, and does now. */
    bool
    begins() const
    {
      return began;
    }

    /** Distance of a place from the surface at the end of the last step. */
    double
    distance(const unsigned int k) const
    {
      return at_end.level(position(k));
    }

    dealii::Tensor<1, dim>
    normal_at_start(const dealii::Point<dim> &x) const
    {
      return at_start.normal(x);
    }

    /** Whether a place is at the surface, or was at the start of a run. */
    bool
    touches(const unsigned int k) const
    {
      return carried[k].status != 0;
    }

    /** Let the places have these tractions; nothing where they do not touch. */
    void
    set_tractions(const std::vector<dealii::Tensor<1, dim>> &tractions)
    {
      for (unsigned int k = 0; k < carried.size(); ++k)
        carried[k].traction = tractions[k];
    }

    /** The longest path of a place along the surface, of what is prepared. */
    double
    largest_slip() const;

    /** Over the rim, of what is prepared [force length]. */
    double
    work_of_friction() const;

    /** Carry what was prepared. */
    void
    keep() noexcept
    {
      std::swap(carried, prepared);
      rim.move();
      acted = acts_now;
    }

    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    void
    undo() override
    {
      rim.undo();
      prepared.clear();
    }

    const std::string &
    name() const
    {
      return boundary_name;
    }

    const ContactLaw &
    law() const
    {
      return contact_law;
    }

    const RigidMotion<dim> &
    rigid_motion() const
    {
      return motion;
    }

    const CarriedPlaces<dim> &
    places_of_rim() const
    {
      return rim;
    }

    const std::vector<ContactUnit<dim>> &
    units() const
    {
      return all_units;
    }

    /** Let steps begin with these tractions of the stress beside units, and the
     * excess of the shear traction. */
    void
    set_fluxes(const std::vector<dealii::Tensor<1, dim>> &fluxes);

    /** Take the multipliers of the next pass. */
    void
    set_multipliers(const std::vector<dealii::Tensor<1, dim>> &multipliers);

    const Enforcement &
    enforcement() const
    {
      return how;
    }

    const MovedSurface<dim> &
    surface_at_end() const
    {
      return at_end;
    }

  private:
    std::string
    group() const
    {
      return "contact/" + boundary_name;
    }

    /** Add the places of the rim of a body. Collective. */
    void
    add_rim(const GridSpace<dim> &space,
            const double          search_tolerance,
            const bool            turns,
            const unsigned int    body);

    /** Whether the rim at place @p k faces the surface at @p nearest, within
     * the ends of it. */
    bool
    faces(const unsigned int k, const NearestPoint<dim> &nearest) const;

    /** The active cells of @p places. @throws ComputationError for a place
     * without one. Collective. */
    std::vector<unsigned int>
    cells_of(const std::vector<unsigned int> &places,
             const GridSpace<dim>            &space) const;

    /** Let each cell's places near the surface be a unit. */
    void
    gather_units(const GridSpace<dim> &space);

    /** Let units below half a cell join the nearest one, apart with apart. */
    void
    merge_small_units();

    void
    set_means();

    /** Halve places that have become long. */
    void
    halve_long_places(const double h);

    /** Shift the zero of the gap of closed units, so that a step closes 0.002 h
     * of it: the mean gap jumps when places enter or leave a cell. */
    void
    keep_gaps();

    const std::string              boundary_name;
    MovedSurface<dim>              at_start, at_end;
    const RigidMotion<dim>         motion;
    const Finder                   find_places;
    const ContactLaw               contact_law;
    const Enforcement              how;
    CarriedPlaces<dim>             rim{{}};
    std::vector<ContactPlace<dim>> carried, prepared; ///< of the places
    std::vector<ContactUnit<dim>>  all_units;
    /** The nearest point to each place of a unit, at the start of the step. */
    std::vector<NearestPoint<dim>> on_surface;
    std::vector<bool>              has_rim;          ///< bodies with places
    double                         reach    = 0;     ///< of units [length]
    bool                           acted    = false; ///< in the last step
    bool                           acts_now = false; ///< in this one
    bool                           began    = false; ///< to act in it
  };
} // namespace moraine

#endif
