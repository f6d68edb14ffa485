// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_points_point_set_h
#define moraine_points_point_set_h

#include <moraine/core/simulation_state.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/points/point_fields.h>

#include <deal.II/grid/grid_tools_cache.h>

#include <deal.II/particles/particle_handler.h>

#include <optional>
#include <vector>

namespace moraine
{
  /**
   * The material points: deal.II's ParticleHandler stores, finds and migrates
   * them. This class adds named fields, a flat numbering of the local points in
   * cell order (valid until the next search), ids that do not depend on the
   * number of ranks, and the promise that no point is ever lost silently.
   *
   * Every point has the fields
   *
   * | field        | components | meaning                                   |
   * |--------------|------------|-------------------------------------------|
   * | volume       | 1          | @f$v_p@f$                                 |
   * | body         | 1          | index of the body it belongs to           |
   * | displacement | dim        | @f$u_p@f$ since the start                 |
   * | stress       | 4 or 6     | Cauchy stress @f$\sigma_p@f$              |
   */
  template <int dim>
  class PointSet : public StatePart
  {
  public:
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;

    /** The points [first, last) of the flat numbering that lie in one cell. */
    struct CellPoints
    {
      CellIterator cell;
      unsigned int first;
      unsigned int last;
    };

    /** To the layout @p fields those of the table above are added. */
    PointSet(const BackgroundMesh<dim> &mesh, PointFields fields);

    /**
     * Put a point into a locally owned cell; finish_insertion() ends it. A
     * place outside of the cell, as round-off makes it for one on a face, is
     * moved to the nearest one at which the search finds this cell.
     */
    void
    insert(const CellIterator       &cell,
           const dealii::Point<dim> &position,
           const dealii::Point<dim> &reference_position,
           const unsigned int        id,
           const unsigned int        body,
           const double              volume);

    /** Number the points after the last insert(). Collective. */
    void
    finish_insertion();

    /** A point like the local point @p of at another place. */
    struct Copy
    {
      unsigned int       of;
      unsigned int       id;
      dealii::Point<dim> position;
    };

    /** Add points. Until find_cells() they have the numbers after the last one
     * and do not occur in cells(). Collective. */
    void
    insert_copies(const std::vector<Copy> &copies);

    /** A point of this rank, to be put where it was later. */
    struct Record
    {
      CellIterator        cell;
      dealii::Point<dim>  position;
      dealii::Point<dim>  reference_position;
      unsigned int        id;
      std::vector<double> values;
    };

    /** The points of @p body. */
    std::vector<Record>
    records_of(const unsigned int body) const;

    /** Let only the points of the bodies flagged in @p stay remain, and add @p
     * others: points of the start that are not here. Collective. */
    void
    exchange_bodies(const std::vector<bool>   &stay,
                    const std::vector<Record> &others);

    /** Whether exchange_bodies() was called. */
    bool
    exchanged() const
    {
      return was_exchanged;
    }

    /**
     * Find the cell of every point after positions changed and hand points
     * over to the rank that owns it. Collective.
     *
     * @throws ComputationError with id and position of a point that is outside
     * the mesh.
     */
    void
    find_cells();

    /**
     * Let points that end outside the mesh, but not further than @p distance
     * from it, be returned to its edge by find_cells() instead of ending the
     * run.
     */
    void
    set_return_tolerance(const double distance)
    {
      return_tolerance = distance;
    }

    /** Number of points of this rank that find_cells() returned so far. */
    unsigned int
    n_returned() const
    {
      return returned_points;
    }

    /** The place in the mesh that @p x outside of it is returned to, if any. */
    std::optional<dealii::Point<dim>>
    place_for(const dealii::Point<dim> &x) const;

    /**
     * Data sets "points/position", "points/cell" and so on, one for each field.
     * The order of points in memory is kept on the same number of ranks.
     */
    void
    write(Archive &archive) const override;

    /** The mesh and the fields must be those of the time of writing. */
    void
    read(const Archive &archive) override;

    const std::vector<CellPoints> &
    cells() const
    {
      return cell_points;
    }

    /** The first point of an active cell, and the one after its last. */
    std::pair<unsigned int, unsigned int>
    points_in(const unsigned int active_cell_index) const;

    /** How far the points of an active cell, less half their size, are from the
     * plane through @p x on its inner side; @p largest if there are none, or it
     * is more [length]. @p normal is the outward one. */
    double
    gap_before(const unsigned int            active_cell_index,
               const dealii::Point<dim>     &x,
               const dealii::Tensor<1, dim> &normal,
               const double                  largest) const;

    /** What the points of all ranks fill of each cell, by active_cell_index().
     * Collective. */
    std::vector<double>
    volumes_in_cells() const;

    /** The cell the point was in when cells were searched last. */
    CellIterator
    cell_of(const unsigned int p) const;

    unsigned int
    n_local() const
    {
      return handles.size();
    }

    dealii::types::particle_index
    n_global() const
    {
      return handler.n_global_particles();
    }

    const dealii::Point<dim> &
    position(const unsigned int p) const
    {
      return pool->get_location(handles[p]);
    }

    void
    set_position(const unsigned int p, const dealii::Point<dim> &x)
    {
      pool->set_location(handles[p], x);
    }

    /** Position in the unit cell of the cell the point lies in. */
    const dealii::Point<dim> &
    reference_position(const unsigned int p) const
    {
      return pool->get_reference_location(handles[p]);
    }

    unsigned int
    id(const unsigned int p) const
    {
      return pool->get_id(handles[p]);
    }

    /** Above the ids of all points that are here or were at the start: those
     * may come back. Collective. */
    unsigned int
    next_id() const;

    /** The n_values() numbers of point @p p. */
    double *
    values(const unsigned int p)
    {
      return pool->get_properties(handles[p]).data();
    }

    const double *
    values(const unsigned int p) const
    {
      return pool->get_properties(handles[p]).data();
    }

    double
    volume(const unsigned int p) const
    {
      return volume_field(values(p));
    }

    void
    set_volume(const unsigned int p, const double v)
    {
      volume_field.store(v, values(p));
    }

    unsigned int
    body(const unsigned int p) const
    {
      return static_cast<unsigned int>(body_field(values(p)));
    }

    const PointField<dim, dealii::Tensor<1, dim>> &
    displacement_field() const
    {
      return u_field;
    }

    /** Let displacements count from now. Collective. */
    void
    reset_displacements();

    /** How far points may have been moved that displacements do not know of any
     * more [length]. */
    double
    forgotten_displacement() const
    {
      return forgotten;
    }

    const PointField<dim, dealii::SymmetricTensor<2, 3>> &
    stress_field() const
    {
      return sigma_field;
    }

    unsigned int
    displacement_offset() const
    {
      return u_field.offset();
    }

    unsigned int
    stress_offset() const
    {
      return sigma_field.offset();
    }

    const PointFields &
    fields() const
    {
      return layout;
    }

    const BackgroundMesh<dim> &
    mesh() const
    {
      return background;
    }

    /** Bytes of one point: location, reference location, id and values. */
    unsigned int
    bytes_per_point() const
    {
      return 2 * sizeof(dealii::Point<dim>) +
             sizeof(dealii::types::particle_index) +
             layout.n_values() * sizeof(double);
    }

  private:
    struct LostPoint
    {
      dealii::types::particle_index id;
      dealii::Point<dim>            position;
      std::vector<double>           values;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &id;
        archive &position;
        archive &values;
      }
    };

    /** Renew the flat numbering. */
    void
    number_points();

    Record
    record(const CellIterator &cell, const unsigned int p) const;

    /** Put points that jumped past the neighbouring ranks where they belong. */
    void
    reinsert_lost_points();

    const BackgroundMesh<dim>                     &background;
    PointFields                                    layout;
    PointField<dim, double>                        volume_field;
    PointField<dim, double>                        body_field;
    PointField<dim, dealii::Tensor<1, dim>>        u_field;
    PointField<dim, dealii::SymmetricTensor<2, 3>> sigma_field;
    dealii::Particles::ParticleHandler<dim>        handler;
    dealii::Particles::PropertyPool<dim>          *pool;
    std::vector<unsigned int>                      handles;
    std::vector<CellPoints>                        cell_points;
    std::vector<CellIterator>                      cells_of_copies;
    std::vector<LostPoint>                         lost_points;
    double                                         forgotten        = 0;
    double                                         return_tolerance = 0;
    unsigned int                                   returned_points  = 0;
    unsigned int first_new_id  = 0; ///< above all ids of the start
    bool         was_exchanged = false;
  };
} // namespace moraine

#endif
