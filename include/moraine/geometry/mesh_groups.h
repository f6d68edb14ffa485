// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_geometry_mesh_groups_h
#define moraine_geometry_mesh_groups_h

#include <moraine/geometry/shape.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/make_mesh.h>

#include <memory>
#include <string>
#include <vector>

namespace moraine
{
  /** The physical groups of cells of a mesh file, as shapes. */
  template <int dim>
  class MeshGroups
  {
  public:
    /** Reads the file a second time: the mesh of the run may move. */
    explicit MeshGroups(const MeshParameters<dim> &parameters);

    /**
     * The cells of the groups called @p names, where they are in the file.
     * Convex parts of a cell are all of them inside or all outside; parts of
     * several cells are cut along the faces (3D: along the mean plane of a
     * bent face). The shape has no rim.
     * @throws InputError naming @p section for a name that is not there or is
     * there twice.
     */
    ShapePointer<dim>
    shape(const std::vector<std::string> &names,
          const std::string              &section) const;

  private:
    std::shared_ptr<const BackgroundMesh<dim>> mesh;
    CellGroups                                 groups;
  };
} // namespace moraine

#endif
