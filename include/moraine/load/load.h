// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_load_load_h
#define moraine_load_load_h

#include <moraine/load/water.h>
#include <moraine/geometry/carried_places.h>
#include <moraine/core/simulation_state.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** A vector prescribed at places and times. */
  template <int dim>
  using VectorFunction =
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                         const double)>;

  /** A number prescribed at places and times. */
  template <int dim>
  using ScalarFunction =
    std::function<double(const dealii::Point<dim> &, const double)>;

  /**
   * A force per volume in some of the bodies: b(x, t), or gravity
   * @f$\rho\, g(x, t)@f$, with x where the material is, or where it was at the
   * start.
   */
  template <int dim>
  struct BodyForce
  {
    std::string         name;
    VectorFunction<dim> value;
    bool                times_density = false;
    std::vector<bool>   acts_on;          ///< one entry per body
    bool                at_start = false; ///< x of value is that of the start
  };

  /** A pressure p(x, t). Its force is @f$-p\,n\,da@f$, n pointing out of the
   * body. */
  template <int dim>
  struct Pressure
  {
    ScalarFunction<dim> value;
    bool                follows; ///< areas and normals go with the material
  };

  /**
   * Forces carried by the material: tractions or a pressure on a surface or on
   * what is at a side of the mesh as they begin to act, or single forces.
   */
  template <int dim>
  class CarriedLoad : public StatePart
  {
  public:
    using Place = typename CarriedPlaces<dim>::Place;

    /** @p kind: side traction, surface traction or point force; @p
     * share_outside: the part of its surface that is outside the mesh. */
    CarriedLoad(const std::string         &name,
                const std::string         &kind,
                const VectorFunction<dim> &value,
                std::vector<Place>         places,
                const double               share_outside = 0.);

    /** @p kind: pressure or side pressure. */
    CarriedLoad(const std::string   &name,
                const std::string   &kind,
                const Pressure<dim> &pressure,
                std::vector<Place>   places,
                const double         share_outside = 0.);

    /**
     * Find the cells of the places, which the first time are where they were in
     * the mesh as it was built; those of a side that are beside no material
     * then are left out. Collective.
     * @throws InputError naming the load if there are none or one is not on the
     * material the first time, ComputationError later.
     */
    void
    find_cells(const GridSpace<dim> &space, const double search_tolerance);

    /** Let the places be as drawn again: it begins to act anew. */
    void
    forget();

    /** Let @p functions carry the forces from the places to the nodes of this
     * rank, and the places along. */
    void
    set_functions(PlaceFunctions<dim> functions)
    {
      place_functions = std::move(functions);
    }

    /** As set_functions() was told. */
    const PlaceFunctions<dim> &
    functions() const
    {
      return place_functions;
    }

    /** Find where the trial increments carry the places, through a mesh that
     * stays or not. Collective. */
    void
    prepare_move(const GridSpace<dim>                      &space,
                 const std::vector<dealii::Tensor<1, dim>> &nodal_increments,
                 const bool                                 through_mesh);

    /** Let the places be where prepare_move() found them, if it was called. */
    void
    move() noexcept;

    /** The places, in the group "loads/" and its name. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    void
    undo() override;

    const std::vector<Place> &
    places() const
    {
      return carried.places();
    }

    /** The places in the mesh as it was built. */
    const std::vector<Place> &
    places_as_drawn() const
    {
      return drawn;
    }

    /** Force per area of a place, or the force of a single one. */
    dealii::Tensor<1, dim>
    value(const Place &place, const double t) const
    {
      return pressure.value ? -pressure.value(place.x, t) * place.normal :
                              function(place.x, t);
    }

    /** Whether it is a pressure whose areas and normals follow the material. */
    bool
    follows() const
    {
      return pressure.follows;
    }

    /** Of a pressure. */
    double
    pressure_at(const Place &place, const double t) const
    {
      return pressure.value(place.x, t);
    }

    const std::string &
    name() const
    {
      return load_name;
    }

    /** The part of its surface that is outside the mesh. */
    double
    share_outside() const
    {
      return outside;
    }

    const std::string &
    kind() const
    {
      return load_kind;
    }

  private:
    const std::string         load_name, load_kind;
    const VectorFunction<dim> function;
    const Pressure<dim>       pressure{{}, false}; ///< instead of a function
    const std::vector<Place>  drawn;
    CarriedPlaces<dim>        carried;
    PlaceFunctions<dim>       place_functions;
    double                    outside;
    bool                      placed = false;
  };

  /**
   * A force on the material points that are nearest to a place at the start;
   * all that are equally near share it. It goes to the nodes like the weight of
   * a point, @f$f_a = \sum_p N_a(x_p) F / n@f$, so that it stays on the
   * material where a place that the grid carries can drift off its edge. Points
   * that carry must not be split (checked with the input).
   */
  template <int dim>
  class ForceOnPoints : public StatePart
  {
  public:
    /** Where a local point was when its displacement was zero. */
    using OriginalPosition =
      std::function<dealii::Point<dim>(const unsigned int point)>;

    ForceOnPoints(const std::string         &name,
                  const VectorFunction<dim> &value,
                  const dealii::Point<dim>  &place);

    /**
     * Learn the numbers that the points have in this step; the first time
     * choose them, by where they were, as bodies may have moved before the
     * force begins to act. Collective.
     * @throws InputError naming the load if at first no point is within two
     * cells of the place.
     */
    void
    find_points(const PointSet<dim>    &points,
                const OriginalPosition &original_position);

    /** The points, in the group "loads/" and its name. */
    void
    write(Archive &archive) const override;

    void
    read(const Archive &archive) override;

    /** Whether the point of this rank has a share. */
    bool
    acts_on(const unsigned int point) const
    {
      return std::binary_search(local_points.begin(),
                                local_points.end(),
                                point);
    }

    /** Whether the point with this id, here or elsewhere, has a share. */
    bool
    is_on(const unsigned int id) const
    {
      return std::binary_search(ids.begin(), ids.end(), id);
    }

    /** That share it, be they there or not; 0 before it first acts. */
    unsigned int
    n_points() const
    {
      return ids.size();
    }

    /** The share of a point at @p x. */
    dealii::Tensor<1, dim>
    value(const dealii::Point<dim> &x, const double t) const
    {
      return 1. / ids.size() * function(x, t);
    }

    const std::string &
    name() const
    {
      return load_name;
    }

  private:
    void
    choose(const PointSet<dim>    &points,
           const OriginalPosition &original_position);

    const std::string         load_name;
    const VectorFunction<dim> function;
    const dealii::Point<dim>  place;
    std::vector<unsigned int> ids;          ///< sorted, the same on all ranks
    std::vector<unsigned int> local_points; ///< flat numbers, sorted
  };

  /** Everything that pushes from outside. */
  template <int dim>
  struct Loads
  {
    std::vector<BodyForce<dim>>         body_forces;
    std::vector<CarriedLoad<dim>>       carried;
    std::vector<ForceOnPoints<dim>>     on_points;
    std::unique_ptr<WaterInBodies<dim>> water; ///< null without
  };
} // namespace moraine

#endif
