// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/cpdi2_basis.h>

#include <deal.II/physics/elasticity/kinematics.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  void
  Cpdi2Basis<dim>::initialise_points(PointSet<dim> &points) const
  {
    const auto domains = this->initial_domains(points);
    const auto v_0     = points.fields().find(FieldNames<dim>::initial_volume);
    for (unsigned int p = 0; p < points.n_local(); ++p)
      {
        store_corners(points, p, domains[p].corners);
        if (!domains[p].is_cut)
          points.set_volume(p, DomainTools::volume<dim>(domains[p].corners));
        if (v_0.exists())
          v_0.store(points.volume(p), points.values(p));
      }
  }



  template <int dim>
  CellVertices<dim>
  Cpdi2Basis<dim>::domain_corners(const unsigned int p) const
  {
    CellVertices<dim> corners;
    for (unsigned int c = 0; c < n_corners; ++c)
      std::copy_n(this->points.values(p) + offsets[c],
                  dim,
                  corners[c].begin_raw());
    return corners;
  }



  template <int dim>
  CellVertices<dim>
  Cpdi2Basis<dim>::moved_corners(
    const unsigned int                 p,
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    CellVertices<dim> corners = domain_corners(p);
    for (unsigned int c = 0; c < n_corners; ++c)
      corners[c] += this->corner_increment(p, c, nodal_increments);
    return corners;
  }



  template <int dim>
  std::string
  Cpdi2Basis<dim>::failure_of(
    const std::vector<Tensor<1, dim>> &nodal_increments) const
  {
    if (!finite_strain)
      return "";
    // Averages over a domain with re-entrant corners still make sense, as long
    // as more of it is the right way round than not.
    for (unsigned int p = 0; p < this->points.n_local(); ++p)
      {
        const auto corners = moved_corners(p, nodal_increments);
        if (!(DomainTools::volume<dim>(corners) > 0))
          return DomainTools::name_of(this->points, p) +
                 ": its domain would turn inside out";
      }
    return "";
  }



  template <int dim>
  void
  Cpdi2Basis<dim>::move_domains(
    PointSet<dim>                     &points,
    const std::vector<Tensor<1, dim>> &nodal_increments,
    const std::vector<Tensor<2, dim>> &gradients) const
  {
    for (unsigned int p = 0; p < points.n_local(); ++p)
      if (finite_strain)
        {
          const auto           corners = moved_corners(p, nodal_increments);
          const Tensor<2, dim> dF =
            Physics::Elasticity::Kinematics::F(gradients[p]);
          // It has followed the gradient until here.
          points.set_volume(p,
                            points.volume(p) *
                              DomainTools::volume<dim>(corners) /
                              (determinant(dF) *
                               DomainTools::volume<dim>(domain_corners(p))));
          store_corners(points, p, corners);
        }
      else
        {
          Tensor<1, dim> shift;
          for (unsigned int c = 0; c < n_corners; ++c)
            shift += this->function_weight(p, c) *
                     this->corner_increment(p, c, nodal_increments);
          auto corners = domain_corners(p);
          for (Point<dim> &corner : corners)
            corner += shift;
          store_corners(points, p, corners);
        }
  }



  template <int dim>
  DomainTools::Halves<dim>
  Cpdi2Basis<dim>::halve(PointSet<dim>     &points,
                         const unsigned int lower,
                         const unsigned int upper,
                         const unsigned int d) const
  {
    const auto whole  = domain_corners(lower);
    const auto parts  = DomainTools::halves_of<dim>(whole, d);
    const auto before = DomainTools::region_of<dim>(whole),
               below  = DomainTools::region_of<dim>(parts[0]),
               above  = DomainTools::region_of<dim>(parts[1]);
    store_corners(points, lower, parts[0]);
    store_corners(points, upper, parts[1]);
    DomainTools::Halves<dim> halves;
    halves.lower       = below.centroid - before.centroid;
    halves.upper       = above.centroid - before.centroid;
    halves.upper_share = above.volume / (below.volume + above.volume);
    return halves;
  }



  template class Cpdi2Basis<2>;
  template class Cpdi2Basis<3>;
} // namespace moraine
