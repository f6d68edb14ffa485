// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Forces on the rims of domains.

#include <moraine/basis/cpdi_basis.h>

#include <moraine/mesh/cell_inverse.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** In lengths of a domain: what is further off is not on its rim. */
    constexpr double reach = 0.1;



    /** Of a cell: places nearer to a domain than this are in it. */
    constexpr double round_off_of_places = 1e-9;



    /** Where a place is in the domain that has @p corners, also beyond it, and
     * how far it is from it; nothing if that is out of reach. */
    template <int dim>
    std::optional<std::pair<Point<dim>, double>>
    place_in_domain(const CellInverse<dim>  &inverse,
                    const CellVertices<dim> &corners,
                    const Point<dim>        &x)
    {
      const std::optional<Point<dim>> xi = inverse(x);
      if (!xi)
        return {};
      Point<dim> inside = *xi;
      for (unsigned int d = 0; d < dim; ++d)
        inside[d] = std::clamp(inside[d], 0., 1.);
      if (xi->distance(inside) > reach)
        return {};
      return std::make_pair(*xi,
                            x.distance(CellMap<dim>(corners).place(inside)));
    }
  } // namespace



  template <int dim>
  std::vector<typename CpdiBasis<dim>::PlaceInDomain>
  CpdiBasis<dim>::nearest_domains(
    const std::vector<typename CarriedPlaces<dim>::Place> &places) const
  {
    std::vector<PlaceInDomain> nearest(places.size());
    std::vector<Point<dim>>    x;
    for (const auto &place : places)
      x.push_back(place.x);
    const auto tree = pack_rtree_of_indices(x);
    for (const auto &in_cell : this->points.cells())
      {
        // Domains reach into the cells around.
        const double     h   = in_cell.cell->diameter();
        BoundingBox<dim> box = in_cell.cell->bounding_box();
        box.extend(h);
        std::vector<unsigned int> near;
        tree.query(boost::geometry::index::intersects(box),
                   std::back_inserter(near));
        for (unsigned int p = in_cell.first; p < in_cell.last && !near.empty();
             ++p)
          {
            const CellVertices<dim> corners = this->domain_corners(p);
            const CellInverse<dim>  inverse(corners);
            const Point<dim>        middle = this->points.position(p);
            double                  extent = 0;
            for (const Point<dim> &corner : corners)
              extent = std::max(extent, corner.distance(middle));
            for (const unsigned int k : near)
              if (x[k].distance(middle) > (1 + 2 * reach) * extent)
                continue;
              else if (auto found =
                         place_in_domain<dim>(inverse, corners, x[k]))
                {
                  if (found->second < round_off_of_places * h)
                    found->second = 0.;
                  const PlaceInDomain here = {found->second,
                                              this->points.id(p),
                                              p,
                                              found->first};
                  nearest[k]               = std::min(nearest[k], here);
                }
          }
      }
    return nearest;
  }



  template <int dim>
  PlaceFunctions<dim>
  CpdiBasis<dim>::functions_at(
    const std::vector<typename CarriedPlaces<dim>::Place> &places) const
  {
    if (gradients_of_mesh)
      return this->functions_of_cells(places);
    const std::vector<PlaceInDomain> here = nearest_domains(places);
    // The one domain of all ranks.
    std::vector<double>       distances;
    std::vector<unsigned int> ids(places.size(), numbers::invalid_unsigned_int);
    for (const auto &domain : here)
      distances.push_back(domain.distance);
    const MPI_Comm communicator = this->space.communicator();
    Utilities::MPI::min(distances, communicator, distances);
    for (unsigned int k = 0; k < places.size(); ++k)
      if (here[k].distance == distances[k])
        ids[k] = here[k].id;
    Utilities::MPI::min(ids, communicator, ids);

    PlaceFunctions<dim> functions;
    for (unsigned int k = 0; k < places.size(); ++k)
      if (ids[k] == numbers::invalid_unsigned_int)
        this->add_functions_of_cell(places[k], k, functions);
      else if (here[k].distance == distances[k] && here[k].id == ids[k])
        {
          const Point<dim>       &xi   = here[k].xi;
          const CellVertices<dim> X    = this->domain_corners(here[k].point);
          const Tensor<2, dim> inverse = invert(CellMap<dim>(X).jacobian(xi));
          for (unsigned int c = 0; c < n_corners; ++c)
            {
              const unsigned int i = here[k].point * n_corners + c;
              const double       M =
                GeometryInfo<dim>::d_linear_shape_function(xi, c);
              const Tensor<1, dim> grad_M =
                GeometryInfo<dim>::d_linear_shape_function_gradient(xi, c) *
                inverse;
              const auto [N, grad_N] =
                functions.add(k, corner_cells[i], n_corners);
              for (unsigned int a = 0; a < n_corners; ++a)
                {
                  N[a]      = M * corner_values[i * n_corners + a];
                  grad_N[a] = corner_values[i * n_corners + a] * grad_M;
                }
            }
        }
    return functions;
  }



#define INSTANTIATE(dim)                                            \
  template std::vector<typename CpdiBasis<dim>::PlaceInDomain>      \
  CpdiBasis<dim>::nearest_domains(                                  \
    const std::vector<typename CarriedPlaces<dim>::Place> &) const; \
  template PlaceFunctions<dim> CpdiBasis<dim>::functions_at(        \
    const std::vector<typename CarriedPlaces<dim>::Place> &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
