// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_mesh_parameters_h
#define moraine_mesh_mesh_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace moraine
{
  /** Where the cells come from, in keys that need no dimension. */
  struct MeshSource
  {
    std::string  type = "box"; ///< box, generator or file
    std::string  generator;
    std::string  arguments;
    std::string  file;
    std::string  side_names;
    unsigned int refinements = 0;
  };



  /**
   * Section `Mesh`: a box of equal cells, offset anywhere; the mesh of a
   * generator of deal.II; or a file of gmsh. In 3D the last two may be plane
   * and extruded along z.
   */
  template <int dim>
  struct MeshParameters : public MeshSource
  {
    dealii::Point<dim>        lower_corner;
    dealii::Point<dim>        upper_corner;
    std::vector<unsigned int> cells;
    double                    cell_size        = 0;
    double                    extrusion_height = 0;
    unsigned int              extrusion_layers = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);

    bool
    is_box() const
    {
      return type == "box";
    }

    /** Whether a mesh of this type looks at the key. */
    bool
    uses(const std::string &key) const;

    /** @throws InputError for what is missing or contradicts itself. */
    void
    check() const;

    /**
     * Of a box: number of cells in each direction.
     *
     * @throws InputError if the corners do not span a box, if none or both of
     * `Cells` and `Cell size` are given, or if the size does not divide the
     * box.
     */
    std::array<unsigned int, dim>
    n_cells() const;
  };
} // namespace moraine

#endif
