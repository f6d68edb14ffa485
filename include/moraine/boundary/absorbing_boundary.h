// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_absorbing_boundary_h
#define moraine_boundary_absorbing_boundary_h

#include <moraine/core/simulation_state.h>
#include <moraine/geometry/carried_places.h>
#include <moraine/material/material.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/symmetric_tensor.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** Coefficients of a surface: normal to it, and along it. */
  struct NormalAndAlong
  {
    double normal = 0;
    double along  = 0;

    /** @f$c_n\, n \otimes n + c_s (1 - n \otimes n)@f$ */
    template <int dim>
    dealii::SymmetricTensor<2, dim>
    matrix(const dealii::Tensor<1, dim> &n) const
    {
      return (normal - along) *
               dealii::symmetrize(dealii::outer_product(n, n)) +
             along * dealii::unit_symmetric_tensor<dim>();
    }
  };



  /**
   * Dashpots and springs per area that stand for the medium outside a surface:
   *
   * @f[ t = -C\, (v - 2 v_{in}) - K\, (u - u_{in}) + t_0, \quad
   *     C = a \rho c_p\, n \otimes n + b \rho c_s (1 - n \otimes n) @f]
   *
   * with a = b = 1 Lysmer and Kuhlemeyer's (1969). @f$v_{in}@f$ is a wave that
   * comes from outside, along the normal, @f$u_{in}@f$ its displacement;
   * @f$t_0@f$ is a traction held. Springs K are
   *  - @f$2G/r_b@f$ normal and @f$G/(2 r_b)@f$ along (Deeks and Randolph 1994),
   *    the first one being the static stiffness of a plane infinite medium
   *    around a cavity whose axis is @f$r_b@f$ away,
   *  - @f$\rho c_p^2/\delta@f$ and @f$\rho c_s^2/\delta@f$, a layer of virtual
   *    thickness @f$\delta@f$ (Kelvin and Voigt), or
   *  - given.
   */
  struct AbsorbingLaw
  {
    /** Springs of a distance or thickness [length], or [force/length^3]. */
    enum class Springs
    {
      none,
      radius,
      thickness,
      given
    };

    /** The medium outside, if it is not the material beside the surface. */
    struct Medium
    {
      double density;
      double c_p; ///< speed of pressure waves
      double c_s; ///< speed of shear waves
    };

    /** Per area: [force time/length^3] and [force/length^3]. */
    struct Coefficients
    {
      NormalAndAlong dashpots;
      NormalAndAlong springs;
    };

    NormalAndAlong                dashpot_factors = {1., 1.}; ///< a, b
    Springs                       springs         = Springs::none;
    double                        spring_length   = 0; ///< @f$r_b, \delta@f$
    NormalAndAlong                spring_stiffness;    ///< if given
    std::optional<Medium>         medium;
    std::optional<NormalAndAlong> impedances; ///< @f$\rho c@f$, if given

    /** Beside a material with stiffness @p C and @p density. */
    Coefficients
    coefficients(const LameConstants &C, const double density) const;
  };



  /**
   * A surface or a side of the mesh that swallows waves. Its places carry the
   * extension of their springs, @f$u - u_{in}@f$ since the springs were
   * attached, and the traction that they hold. On a surface the material
   * carries the places along; on a side they stay, unless the mesh moves with
   * the material.
   */
  template <int dim>
  class AbsorbingBoundary : public StatePart
  {
  public:
    using Place = typename CarriedPlaces<dim>::Place;
    /** The places, where they are at time t in the mesh as it was built; the
     * same on all ranks. */
    using Finder =
      std::function<std::vector<Place>(const GridSpace<dim> &, const double)>;
    /** Velocity of a wave that comes from outside, at (x, t). */
    using Velocity =
      std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                           const double)>;

    /** What happens to the places at the end of a step. */
    struct Following
    {
      bool moves        = false; ///< with the material
      bool through_mesh = false; ///< which stays where it is
      bool turns        = false; ///< areas and normals follow too
      bool attached     = true;  ///< springs; else they have no extension
    };

    /** @p find_places is asked when the boundary begins to act. @p on_side: the
     * places are of a side of the mesh. */
    AbsorbingBoundary(const std::string  &name,
                      const Finder       &find_places,
                      const AbsorbingLaw &law,
                      const Velocity     &incident,
                      const bool          on_side)
      : boundary_name(name)
      , find_places(find_places)
      , absorbing_law(law)
      , incident(incident)
      , on_side(on_side)
    {}

    /**
     * Find the cells of the places, and the places themselves the first time.
     * Those that are on no material at first are left out, and so are those of
     * a side beside the bodies of the stage in which it begins.
     * @param space the grid
     * @param search_tolerance how far from its cell material reaches
     * @param t time at which the step starts
     * @throws ComputationError if a place has lost the material later.
     */
    void
    find_cells(const GridSpace<dim> &space,
               const double          search_tolerance,
               const double          t);

    bool
    has_cells() const
    {
      return found;
    }

    /** @f$u_{in}@f$ at a place gained from @p t_start to @p t_end, by the
     * trapezoidal rule. */
    dealii::Tensor<1, dim>
    incident_increment(const unsigned int place,
                       const double       t_start,
                       const double       t_end) const;

    /** Find what the places will carry after the trial increments of a step.
     * Collective. */
    void
    prepare(const GridSpace<dim>                      &space,
            const std::vector<dealii::Tensor<1, dim>> &nodal_increments,
            const double                               t_start,
            const double                               t_end,
            const Following                           &following);

    /** Carry what was prepared. */
    void
    keep() noexcept
    {
      std::swap(extensions, next_extensions);
      carried.move();
    }

    /** Hold these tractions, one for each place, from now on. */
    void
    hold(std::vector<dealii::Tensor<1, dim>> tractions)
    {
      AssertDimension(tractions.size(), places().size());
      held = std::move(tractions);
    }

    /** What it carries, in a group "absorbing/". */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    void
    undo() override
    {
      carried.undo();
      next_extensions.clear();
    }

    const std::string &
    name() const
    {
      return boundary_name;
    }

    const AbsorbingLaw &
    law() const
    {
      return absorbing_law;
    }

    const std::vector<Place> &
    places() const
    {
      return carried.places();
    }

    const dealii::Tensor<1, dim> &
    extension(const unsigned int place) const
    {
      return extensions[place];
    }

    const dealii::Tensor<1, dim> &
    held_traction(const unsigned int place) const
    {
      return held[place];
    }

    dealii::Tensor<1, dim>
    incident_velocity(const unsigned int place, const double t) const
    {
      return incident ? incident(places()[place].x, t) :
                        dealii::Tensor<1, dim>();
    }

    /** Leave out places by their numbers, ascending, the same on all ranks. */
    void
    remove_places(const std::vector<unsigned int> &numbers);

    bool
    is_on_side() const
    {
      return on_side;
    }

    /** How many places saw material when cells were found last. */
    unsigned int
    n_on_material() const
    {
      return n_with_cell;
    }

  private:
    /** Of what it carries in an archive. */
    std::string
    group() const
    {
      return (on_side ? "absorbing/side " : "absorbing/") + boundary_name;
    }

    const std::string                   boundary_name;
    const Finder                        find_places;
    const AbsorbingLaw                  absorbing_law;
    const Velocity                      incident;
    const bool                          on_side;
    CarriedPlaces<dim>                  carried{{}};
    bool                                found  = false; ///< cells, since read()
    bool                                placed = false; ///< once
    unsigned int                        n_with_cell = 0;
    std::vector<dealii::Tensor<1, dim>> extensions;
    std::vector<dealii::Tensor<1, dim>> held;
    std::vector<dealii::Tensor<1, dim>> next_extensions;
  };
} // namespace moraine

#endif
