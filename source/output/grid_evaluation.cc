// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/output/grid_evaluation.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_q.h>

#include <cmath>
#include <memory>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Less of a cell gets no points (see CellSeeder). */
    constexpr double smallest_filled_part = 1e-12;



    /** Unit cell coordinates of @p place, if it is in the cell or nearer to it
     * than @p margin. */
    template <int dim>
    bool
    find_in_cell(const BackgroundMesh<dim>                        &mesh,
                 const typename BackgroundMesh<dim>::CellIterator &cell,
                 const Point<dim>                                 &place,
                 const double                                      margin,
                 Point<dim>                                       &unit)
    {
      BoundingBox<dim> box = cell->bounding_box();
      box.extend(margin);
      if (!box.point_inside(place))
        return false;
      try
        {
          unit = mesh.mapping().transform_real_to_unit_cell(cell, place);
        }
      catch (const typename Mapping<dim>::ExcTransformationFailed &)
        {
          return false;
        }
      return GeometryInfo<dim>::is_inside_unit_cell(
        unit, margin / cell->minimum_vertex_distance());
    }
  } // namespace



  template <int dim>
  PlaceFunction<dim>
  grid_evaluation(const GridSpace<dim>              &space,
                  const std::vector<Tensor<1, dim>> &values)
  {
    const auto element       = std::make_shared<FE_Q<dim>>(space.degree());
    const auto lexicographic = element->get_poly_space_numbering_inverse();

    return [&space, &values, element, lexicographic](const Point<dim> &place,
                                                     Tensor<1, dim>   &result) {
      const auto &mesh = space.mesh();
      // The corner of a body may reach into a cell by so little that it has no
      // points there; then a cell beside it counts.
      for (const double margin :
           {mesh.round_off(),
            2 * mesh.cell_size() * std::pow(smallest_filled_part, 1. / dim)})
        {
          constexpr auto nowhere   = numbers::invalid_unsigned_int;
          unsigned int   cell_here = nowhere;
          Tensor<1, dim> value_here;
          Point<dim>     unit;
          for (const auto &cell : mesh.triangulation().active_cell_iterators())
            if (cell->is_locally_owned() && space.is_active(cell) &&
                find_in_cell<dim>(mesh, cell, place, margin, unit))
              {
                const unsigned int *nodes = space.cell_nodes(cell);
                for (unsigned int a = 0; a < space.nodes_per_cell(); ++a)
                  value_here += element->shape_value(lexicographic[a], unit) *
                                values[nodes[a]];
                cell_here = cell->active_cell_index();
                break;
              }

          // On a face between ranks both have found a cell: take the first.
          const unsigned int cell_taken =
            Utilities::MPI::min(cell_here, space.communicator());
          if (cell_taken == nowhere)
            continue;
          result =
            Utilities::MPI::sum(cell_here == cell_taken ? value_here :
                                                          Tensor<1, dim>(),
                                space.communicator());
          return true;
        }
      return false;
    };
  }



  template PlaceFunction<2>
  grid_evaluation(const GridSpace<2> &, const std::vector<Tensor<1, 2>> &);
  template PlaceFunction<3>
  grid_evaluation(const GridSpace<3> &, const std::vector<Tensor<1, 3>> &);
} // namespace moraine
