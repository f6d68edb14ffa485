// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_mesh_vtu_h
#define moraine_output_mesh_vtu_h

#include <moraine/mesh/grid_space.h>
#include <moraine/output/smoothed_stress.h>
#include <moraine/output/vtu_file.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace moraine
{
  /** A vector at every node of a GridSpace, with the name to draw it under. */
  template <int dim>
  struct NodeField
  {
    std::string                                name;
    std::string                                unit;
    const std::vector<dealii::Tensor<1, dim>> &values;
  };

  /**
   * Write the active cells with vectors at their nodes and the smoothed stress
   * of points, its von Mises stress and its mean as one VTU file, whatever the
   * number of ranks. A vertex that no point is around has the mean stress of
   * the other ones of the cell. Collective. Cells are drawn where the nodes
   * are, so a mesh that follows the material is drawn deformed. Q2 cells are
   * drawn as 2^dim smaller ones. The file appears only when it is
   * complete. The @p effective stress is written too, if materials are
   * undrained.
   *
   * @throws InputError naming the file if it cannot be written.
   */
  template <int dim>
  void
  write_mesh_vtu(const GridSpace<dim>              &space,
                 const std::vector<NodeField<dim>> &fields,
                 const SmoothedStress<dim>         &stress,
                 const VtuTarget                   &target,
                 const SmoothedStress<dim>         *effective = nullptr);
} // namespace moraine

#endif
