// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_probes_h
#define moraine_output_probes_h

#include <moraine/output/grid_evaluation.h>
#include <moraine/output/named_value.h>
#include <moraine/points/point_set.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace moraine
{
  /**
   * Section `Probes/<name>`: a place whose values become columns of
   * history.csv.
   */
  template <int dim>
  struct ProbeParameters
  {
    std::string              name;
    std::vector<double>      location;
    std::string              kind = "nearest point";
    std::string              body;
    std::vector<std::string> quantities = {"displacement"};

    void
    add_parameters(dealii::ParameterHandler &prm);

    /**
     * @throws InputError if the location is missing, or if a quantity is asked
     * for that this kind of probe, or a scene that is not dynamic or has no
     * water, does not have.
     */
    void
    check(const bool is_dynamic, const bool has_water) const;
  };

  /**
   * The probes of a scene.
   *
   * A probe of kind *nearest point* chooses the point that is nearest to its
   * location at the start (of equally near ones the one with the smallest id),
   * of the body that it names, if it names one, and follows it. A probe of kind
   * *interpolated* stands on the material: the increments of the mesh
   * displacement at its place add up to its displacement and carry it along.
   * Where an interpolated probe leaves the active cells it follows the point
   * that is nearest to it from then on, and changes() says so. It waits where
   * it is as long as it has not stood on a body, or while that body is not
   * there.
   */
  template <int dim>
  class Probes : public StatePart
  {
  public:
    /**
     * Chooses the points. Collective.
     *
     * @p moves_through_mesh says whether material moves through the mesh (the
     * mesh is reset after a step). Otherwise a place keeps its position in its
     * cell, and step increments are always evaluated at its location at the
     * start. @p points are those of all bodies, those that come later too.
     *
     * @throws InputError if a probe names a body that is not among @p
     * body_names
     */
    Probes(const std::vector<ProbeParameters<dim>> &parameters,
           const PointSet<dim>                     &points,
           const std::vector<std::string>          &body_names,
           const bool                               moves_through_mesh);

    /**
     * @p on_material finds a place on the mesh that bodies cover. An
     * interpolated probe beside it waits for a body if @p bodies_are_away.
     * Collective.
     * @throws InputError for an interpolated probe beside it, and for a point
     * more than two cells away from the location.
     */
    void
    check_places(const PlaceFunction<dim> &on_material,
                 const bool                bodies_are_away = false) const;

    /** Add to @p notes which probes follow points of bodies that are not there.
     * Collective.
     * @param points those that are there
     * @param body_names by number
     * @param notes what is told */
    void
    report_absent(const PointSet<dim>            &points,
                  const std::vector<std::string> &body_names,
                  std::vector<std::string>       &notes) const;

    /** Whether there are interpolated probes, which try_step() moves. */
    bool
    any_interpolated() const;

    /**
     * Follow the trial step with the interpolated probes. Collective.
     *
     * @param step_increment displacement of this step at a place of the mesh as
     * it stood before the step; see grid_evaluation().
     * @param points as they stood before the step
     * @param velocity,acceleration at the end of the step, at the same places;
     * empty if there are none
     * @param move how far nodes have taken places before the step, where they
     * stay with the material; empty if they do not. A body that comes is where
     * they are by then.
     */
    void
    try_step(const PlaceFunction<dim> &step_increment,
             const PointSet<dim>      &points,
             const PlaceFunction<dim> &velocity     = {},
             const PlaceFunction<dim> &acceleration = {},
             const PlaceFunction<dim> &move         = {});

    /** The step of the last try_step() is accepted. */
    void
    keep_step();

    /** Let displacements of interpolated probes count from now; to be called
     * before those of @p points do. Collective. */
    void
    reset_displacements(const PointSet<dim> &points);

    /** What the last keep_step() changed for the user, sentence by sentence. */
    const std::vector<std::string> &
    changes() const
    {
      return sentences;
    }

    /**
     * The values now, the same on every rank, named "u_x at A" and so on.
     * Collective.
     *
     * @throws ComputationError if a point that is followed is gone.
     */
    std::vector<NamedValue>
    values(const PointSet<dim> &points) const;

    /** Data sets "probes/...": which points they follow, and how far places
     * went. */
    void
    write(Archive &archive) const override;

    /** The probes must be those of the time of writing. */
    void
    read(const Archive &archive) override;

  private:
    struct Probe
    {
      ProbeParameters<dim> parameters;
      dealii::Point<dim>   start;
      unsigned int         point_id = 0;
      /** Of an interpolated probe: what it stands on, or stood on last. */
      unsigned int           body     = dealii::numbers::invalid_unsigned_int;
      double                 distance = 0; ///< of the point that is followed
      dealii::Tensor<1, dim> displacement;
      dealii::Tensor<1, dim> increment;            ///< of the trial step
      dealii::Tensor<1, dim> v, a;                 ///< at its end
      bool                   leaves_cells = false; ///< in the trial step
      bool                   has_left     = false;
      /** Of a probe that has left the cells: over that of its point. */
      dealii::Tensor<1, dim> ahead;
      /** The displacement that does not count any more. */
      dealii::Tensor<1, dim> before_reset;

      bool
      follows_point() const;
    };

    /** Find the point nearest to @p place, of @p body if it is valid.
     * Collective. */
    void
    choose_point(const dealii::Point<dim> &place,
                 const PointSet<dim>      &points,
                 const unsigned int        body,
                 Probe                    &probe) const;

    /** Position, displacement, stress, velocity, acceleration and pore pressure
     * of the points that are followed, and 1; zeros alone while the body is not
     * there. */
    std::vector<std::vector<double>>
    gather_points(const PointSet<dim> &points) const;

    std::vector<Probe>                      probes;
    std::vector<std::string>                sentences;
    double                                  cell_size;
    bool                                    moves_through_mesh;
    PointField<dim, dealii::Tensor<1, dim>> v_field, a_field;
    PointField<dim, double>                 pressure_field;
  };
} // namespace moraine

#endif
