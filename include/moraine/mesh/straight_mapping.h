// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_mesh_straight_mapping_h
#define moraine_mesh_straight_mapping_h

#include <deal.II/fe/mapping_q1.h>

#include <memory>

namespace moraine
{
  /**
   * deal.II's MappingQ1 with a faster inverse map to the unit cell,
   * CellInverse, which is most of what the search for points does on cells that
   * are no parallelograms. Where that finds nothing, MappingQ1 has the last
   * word.
   */
  template <int dim>
  class StraightMapping : public dealii::MappingQ1<dim>
  {
  public:
    using CellIterator = typename dealii::Triangulation<dim>::cell_iterator;

    std::unique_ptr<dealii::Mapping<dim>>
    clone() const override;

    /** @throws dealii::Mapping::ExcTransformationFailed as MappingQ1 does. */
    dealii::Point<dim>
    transform_real_to_unit_cell(const CellIterator       &cell,
                                const dealii::Point<dim> &x) const override;

    /** Infinity in component 0 of a place that has none in the unit cell. */
    void
    transform_points_real_to_unit_cell(
      const CellIterator                                &cell,
      const dealii::ArrayView<const dealii::Point<dim>> &places,
      const dealii::ArrayView<dealii::Point<dim>> &unit_places) const override;
  };
} // namespace moraine

#endif
