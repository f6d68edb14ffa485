// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/straight_mapping.h>

#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/cell_inverse.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  std::unique_ptr<Mapping<dim>>
  StraightMapping<dim>::clone() const
  {
    return std::make_unique<StraightMapping<dim>>();
  }



  template <int dim>
  Point<dim>
  StraightMapping<dim>::transform_real_to_unit_cell(const CellIterator &cell,
                                                    const Point<dim>   &x) const
  {
    const auto xi = CellInverse<dim>(vertices_of<dim>(cell))(x);
    return xi ? *xi : MappingQ1<dim>::transform_real_to_unit_cell(cell, x);
  }



  template <int dim>
  void
  StraightMapping<dim>::transform_points_real_to_unit_cell(
    const CellIterator                &cell,
    const ArrayView<const Point<dim>> &places,
    const ArrayView<Point<dim>>       &unit_places) const
  {
    const CellInverse<dim> inverse(vertices_of<dim>(cell));
    for (unsigned int p = 0; p < places.size(); ++p)
      if (const auto xi = inverse(places[p]))
        unit_places[p] = *xi;
      else
        MappingQ1<dim>::transform_points_real_to_unit_cell(
          cell,
          ArrayView<const Point<dim>>(&places[p], 1),
          ArrayView<Point<dim>>(&unit_places[p], 1));
  }



  template class StraightMapping<2>;
  template class StraightMapping<3>;
} // namespace moraine
