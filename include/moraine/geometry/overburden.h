// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_overburden_h
#define moraine_geometry_overburden_h

#include <moraine/geometry/shape.h>

#include <array>
#include <vector>

namespace moraine
{
  /**
   * What lies above a place: the bodies that a straight line from it against
   * gravity goes through until it comes to the surface, the first gap between
   * them.
   */
  template <int dim>
  class Overburden
  {
  public:
    /** A piece of a surface: a segment or a triangle. */
    using Facet = std::array<dealii::Point<dim>, dim>;

    /**
     * Of bodies that share no volume.
     *
     * @param bodies their shapes; null for those that are not there
     * @param mesh_box bodies without limits end at its sides
     * @param cell_size bodies thinner than a 32nd of it may be missed, and if
     * they are expressions, than a quarter; gaps below its hundredth are none:
     * such bodies bear each other
     * @param mesh_surface where bodies end, too, if the mesh is no box
     */
    Overburden(const std::vector<ShapePointer<dim>> &bodies,
               const dealii::BoundingBox<dim>       &mesh_box,
               const double                          cell_size,
               const std::vector<Facet>             &mesh_surface = {});

    /** A part of a line in one body, by distance from its start. */
    struct Part
    {
      double       begin, end;
      unsigned int body;
    };

    /** What lies above a place. */
    struct Column
    {
      double             pressure; ///< vertical [stress]
      unsigned int       top;      ///< the body at the surface
      dealii::Point<dim> surface;  ///< the place where the line leaves it
      std::vector<Part>  parts;    ///< that bear each other, from below
    };

    /**
     * What counts by its mean: one line, or where that runs along the edge of a
     * body, as between two that stand side by side, those close beside it.
     *
     * Of @p x in body @p body, with the direction @p up of unit length.
     * @p weights are those of the bodies per volume,
     * @f$\rho\,|g|@f$ [force/length^dim].
     */
    std::vector<Column>
    above(const dealii::Point<dim>     &x,
          const unsigned int            body,
          const dealii::Tensor<1, dim> &up,
          const std::vector<double>    &weights) const;

  private:
    /** One line; set @p runs_along if it runs along the edge of a body. */
    Column
    column(const dealii::Point<dim>     &x,
           const unsigned int            body,
           const dealii::Tensor<1, dim> &up,
           const std::vector<double>    &weights,
           bool                         &runs_along) const;

    /** Those of body @p b up to @p length. @return whether the line runs along
     * its edge somewhere. */
    bool
    add_parts(const unsigned int            b,
              const dealii::Point<dim>     &x,
              const dealii::Tensor<1, dim> &up,
              const double                  length,
              std::vector<Part>            &parts) const;

    /** How far it is from @p x to the end of the mesh. */
    double
    length_in_mesh(const dealii::Point<dim>     &x,
                   const dealii::Tensor<1, dim> &up) const;

    const std::vector<ShapePointer<dim>> bodies;
    const dealii::BoundingBox<dim>       box;
    const double                         cell_size;
    const std::vector<Facet>             mesh_surface;
  };
} // namespace moraine

#endif
