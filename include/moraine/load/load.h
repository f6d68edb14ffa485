// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_load_load_h
#define moraine_load_load_h

#include <moraine/geometry/shape.h>
#include <moraine/core/simulation_state.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/point_set.h>

#include <deal.II/grid/grid_tools_cache.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace moraine
{
  /** A vector prescribed at places and times. */
  template <int dim>
  using VectorFunction =
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                         const double)>;

  /**
   * A force per volume in some of the bodies: b(x, t), or gravity
   * @f$\rho\, g(x, t)@f$.
   */
  template <int dim>
  struct BodyForce
  {
    std::string         name;
    VectorFunction<dim> value;
    bool                times_density = false;
    std::vector<bool>   acts_on; ///< one entry per body
  };

  /** A force per area (2D: per length) on a side of the mesh. */
  template <int dim>
  struct SideTraction
  {
    std::string                name;
    dealii::types::boundary_id side = 0;
    VectorFunction<dim>        value;
  };

  /**
   * Forces carried by the material: tractions on a surface, or single forces.
   * Places are moved with the displacement increment of the grid. They are few
   * and known to all ranks.
   */
  template <int dim>
  class CarriedLoad : public StatePart
  {
  public:
    struct Place
    {
      dealii::Point<dim> x;
      double             weight; ///< area it stands for; 1 for a single force
      /** Cell whose functions it sees, if this rank owns it. */
      unsigned int active_cell_index = GridSpace<dim>::no_cell;
    };

    CarriedLoad(const std::string         &name,
                const VectorFunction<dim> &value,
                std::vector<Place>         places);

    /**
     * Find the cells of the places.
     * @throws InputError naming the load if a place is not on the material the
     * first time, ComputationError later.
     */
    void
    find_cells(const GridSpace<dim> &space, const double search_tolerance);

    /** Find where the trial increments carry the places. Collective. */
    void
    prepare_move(const GridSpace<dim>                      &space,
                 const std::vector<dealii::Tensor<1, dim>> &nodal_increments);

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
      return load_places;
    }

    dealii::Tensor<1, dim>
    value(const dealii::Point<dim> &x, const double t) const
    {
      return function(x, t);
    }

    const std::string &
    name() const
    {
      return load_name;
    }

    /** Whether it is one force at one place. */
    bool
    is_single() const
    {
      return load_places.size() == 1 && load_places[0].weight == 1;
    }

  private:
    const std::string         load_name;
    const VectorFunction<dim> function;
    std::vector<Place>        load_places;
    std::vector<Place>        next_places; ///< if the trial is accepted
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
    ForceOnPoints(const std::string         &name,
                  const VectorFunction<dim> &value,
                  const dealii::Point<dim>  &place);

    /**
     * Learn the numbers that the points have in this step; the first time
     * choose them. Collective.
     * @throws InputError naming the load if at first no point is within two
     * cells of the place.
     */
    void
    find_points(const PointSet<dim> &points);

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
    choose(const PointSet<dim> &points);

    const std::string         load_name;
    const VectorFunction<dim> function;
    const dealii::Point<dim>  place;
    std::vector<unsigned int> ids;          ///< sorted, the same on all ranks
    std::vector<unsigned int> local_points; ///< flat numbers, sorted
  };

  /** The places of a traction surface in a mesh, the same on all ranks. */
  template <int dim>
  std::vector<typename CarriedLoad<dim>::Place>
  places_on(const Surface<dim> &surface, const BackgroundMesh<dim> &mesh);

  /** Everything that pushes from outside. */
  template <int dim>
  struct Loads
  {
    std::vector<BodyForce<dim>>     body_forces;
    std::vector<SideTraction<dim>>  side_tractions;
    std::vector<CarriedLoad<dim>>   carried;
    std::vector<ForceOnPoints<dim>> on_points;
  };
} // namespace moraine

#endif
