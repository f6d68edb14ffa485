// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_small_scene_h
#define moraine_tests_small_scene_h

#include <moraine/basis/basis.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/mesh/background_mesh.h>
#include <moraine/mesh/grid_space.h>
#include <moraine/points/bodies.h>
#include <moraine/points/seeding.h>
#include <moraine/geometry/shapes.h>
#include <moraine/state/motion.h>
#include <moraine/state/trial_points.h>

#include <memory>

namespace moraine
{
  /** A mesh of n^dim unit cells from the origin. */
  template <int dim>
  MeshParameters<dim>
  unit_cells(const unsigned int n)
  {
    MeshParameters<dim> parameters;
    for (unsigned int d = 0; d < dim; ++d)
      parameters.upper_corner[d] = n;
    parameters.cell_size = 1;
    return parameters;
  }



  /**
   * A mesh of 4^dim unit cells with a box body of n^dim points per full cell,
   * from 0.3 to 3.4 in every direction, for tests.
   */
  template <int dim>
  struct SmallScene
  {
    static PointFields
    fields(const bool                                          gimp,
           const StrainMeasure                                 measure,
           const std::vector<std::shared_ptr<const Material>> &materials)
    {
      PointFields layout;
      if (gimp)
        GimpBasis<dim>::request_fields(layout);
      StateFields<dim>(layout, measure, materials);
      Motion<dim>::request_fields(VelocityTransfer(), layout);
      return layout;
    }

    explicit SmallScene(
      const bool          gimp    = false,
      const unsigned int  n       = 2,
      const StrainMeasure measure = StrainMeasure::small,
      const std::vector<std::shared_ptr<const Material>> &materials = {})
      : mesh(unit_cells<dim>(4), MPI_COMM_WORLD)
      , space(mesh, 1)
      , points(mesh, fields(gimp, measure, materials))
    {
      dealii::Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = 0.3;
          upper[d] = 3.4;
        }
      const auto            box = make_box<dim>(lower, upper);
      const CellSeeder<dim> seeder(n, PointLayout::equal);
      seed_bodies({{"box", box}}, seeder, points);
      if (gimp)
        basis = std::make_unique<GimpBasis<dim>>(space, points, seeder);
      else
        basis = std::make_unique<CellBasis<dim, 1>>(space, points);
      basis->initialise_points(points);
    }

    BackgroundMesh<dim>         mesh;
    GridSpace<dim>              space;
    PointSet<dim>               points;
    std::unique_ptr<Basis<dim>> basis;
  };
} // namespace moraine

#endif
