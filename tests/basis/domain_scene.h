// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_tests_domain_scene_h
#define moraine_tests_domain_scene_h

#include <moraine/basis/basis.h>
#include <moraine/basis/cpdi1_basis.h>
#include <moraine/basis/cpdi2_basis.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/geometry/shapes.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <memory>

#include "../small_scene.h"

namespace moraine
{
  enum class Method
  {
    mpm,
    gimp,
    gimp_stretch,
    gimp_corners,
    cpdi1,
    cpdi2
  };

  struct DomainSceneOptions
  {
    Method      method        = Method::cpdi2;
    bool        distorted     = false; ///< vertices inside are moved
    bool        box           = true;  ///< false: a mesh like any other
    bool        finite_strain = true;
    bool        split         = false;
    double      lower         = 0; ///< of the body
    double      upper         = 4;
    double      turn          = 0; ///< degrees, about its middle
    PointLayout layout        = PointLayout::equal;
    /** Of the body along each edge, in a grid of its own; 0: those of cells. */
    unsigned int own_points = 0;
  };

  /** A mesh of 4^dim cells from 0 to 4 with a body of 2^dim points per cell. */
  template <int dim>
  struct DomainScene
  {
    using Options = DomainSceneOptions;

    static PointFields
    fields(const Options &options)
    {
      PointFields layout;
      if (options.method == Method::gimp_stretch)
        GimpBasis<dim>::request_fields(layout, DomainUpdate::stretch);
      else if (options.method == Method::gimp ||
               options.method == Method::gimp_corners)
        GimpBasis<dim>::request_fields(layout);
      else if (options.method == Method::cpdi1)
        Cpdi1Basis<dim>::request_fields(layout);
      else if (options.method == Method::cpdi2)
        Cpdi2Basis<dim>::request_fields(layout);
      if (options.finite_strain)
        {
          layout.request(FieldNames<dim>::deformation_gradient);
          layout.request(FieldNames<dim>::initial_volume);
        }
      return layout;
    }

    /** A number in [-1, 1] that looks random and is the same on all ranks. */
    static double
    noise(const unsigned int i, const unsigned int j)
    {
      const double x = 1e4 * std::sin(12.9898 * i + 78.233 * j + 1);
      return 2 * (x - std::floor(x)) - 1;
    }

    static bool
    distort(BackgroundMesh<dim> &mesh, const Options &options)
    {
      if (options.distorted || !options.box)
        mesh.move_vertices([&](const dealii::Point<dim> &x) {
          dealii::Point<dim> y      = x;
          unsigned int       number = 0;
          for (unsigned int d = 0; d < dim; ++d)
            number = 7 * number + std::lround(x[d]);
          for (unsigned int d = 0; d < dim; ++d)
            if (options.distorted && x[d] > 0.5 && x[d] < 3.5)
              y[d] += 0.2 * noise(number, d);
          return y;
        });
      return true;
    }

    static PointList<dim>
    own_points(const Options &options)
    {
      const unsigned int n    = options.own_points;
      const double       edge = (options.upper - options.lower) / n;
      PointList<dim>     list;
      for (unsigned int i = 0; i < dealii::Utilities::fixed_power<dim>(n); ++i)
        {
          dealii::Point<dim> x;
          unsigned int       rest = i;
          for (unsigned int d = 0; d < dim; ++d, rest /= n)
            x[d] = options.lower + (rest % n + 0.5) * edge;
          list.positions.push_back(x);
          list.volumes.push_back(std::pow(edge, dim));
        }
      for (unsigned int d = 0; d < dim; ++d)
        list.half_edges[d][d] = 0.5 * edge;
      return list;
    }

    static std::vector<Body<dim>>
    make_bodies(const Options &options)
    {
      if (options.own_points > 0)
        return {{"grid", own_points(options)}};
      dealii::Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = options.lower;
          upper[d] = options.upper;
        }
      std::shared_ptr<const Shape<dim>> box = make_box<dim>(lower, upper);
      if (options.turn != 0)
        {
          dealii::Tensor<1, dim> axis;
          for (unsigned int d = 0; d < dim; ++d)
            axis[d] = d + 1;
          box = make_moved<dim>(box,
                                Placement<dim>(options.turn,
                                               lower + 0.5 * (upper - lower),
                                               axis,
                                               dealii::Tensor<1, dim>()));
        }
      return {{"box", box}};
    }

    std::unique_ptr<Basis<dim>>
    make_basis() const
    {
      switch (options.method)
        {
          case Method::mpm:
            return std::make_unique<CellBasis<dim, 1>>(space, points);
          case Method::cpdi1:
            return std::make_unique<Cpdi1Basis<dim>>(
              space, points, seeder, bodies, options.split);
          case Method::cpdi2:
            return std::make_unique<Cpdi2Basis<dim>>(
              space, points, seeder, bodies, options.split);
          default:
            return std::make_unique<GimpBasis<dim>>(
              space,
              points,
              seeder,
              std::vector<bool>(bodies.size(), options.own_points == 0),
              options.method == Method::gimp_stretch ? DomainUpdate::stretch :
              options.method == Method::gimp_corners ? DomainUpdate::corners :
                                                       DomainUpdate::frozen,
              options.split,
              "GIMP",
              std::vector<dealii::Tensor<2, dim>>{bodies[0].listed.half_edges});
        }
    }

    explicit DomainScene(const Options &options)
      : options(options)
      , mesh(unit_cells<dim>(4), MPI_COMM_WORLD)
      , is_distorted(distort(mesh, options))
      , space(mesh, 1)
      , points(mesh, fields(options))
      , bodies(make_bodies(options))
      , seeder(2, options.layout)
    {
      seed_bodies(bodies, seeder, points);
      if (options.finite_strain)
        for (unsigned int p = 0; p < points.n_local(); ++p)
          F().store(dealii::unit_symmetric_tensor<dim>(), points.values(p));
      basis = make_basis();
      basis->initialise_points(points);
      prepare();
    }

    /** What begins a step. */
    void
    prepare()
    {
      std::vector<unsigned char> active(mesh.triangulation().n_active_cells(),
                                        0);
      basis->mark_cells(active);
      space.set_active_cells(std::move(active));
      basis->batch_points();
    }

    /** Values at the nodes of a displacement given as a function. */
    template <class Function>
    std::vector<dealii::Tensor<1, dim>>
    nodal(const Function &function) const
    {
      std::vector<dealii::Tensor<1, dim>> values(space.n_nodes());
      for (unsigned int node = 0; node < values.size(); ++node)
        values[node] = function(space.node_position(node));
      return values;
    }

    /** What accepts a step. */
    void
    accept(const std::vector<dealii::Tensor<1, dim>> &nodal)
    {
      std::vector<dealii::Tensor<1, dim>> increments(points.n_local());
      std::vector<dealii::Tensor<2, dim>> gradients(points.n_local());
      StencilBlock<dim>                   block;
      for (unsigned int g = 0; g < basis->n_batches(); ++g)
        {
          basis->evaluate(g, block);
          for (unsigned int p = 0; p < block.n_points; ++p)
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              {
                const auto &u = nodal[block.nodes[a]];
                increments[block.points[p]] += block.N(p)[a] * u;
                gradients[block.points[p]] +=
                  outer_product(u, block.grad_N(p)[a]);
              }
        }
      if (options.finite_strain)
        update_state(gradients);
      basis->move_domains(points, nodal, gradients);
      for (unsigned int p = 0; p < points.n_local(); ++p)
        points.set_position(p, points.position(p) + increments[p]);
      basis->split_domains(points);
      points.find_cells();
      prepare();
    }

    unsigned int
    offset(const std::string &name) const
    {
      for (const auto &field : points.fields().fields())
        if (field.name == name)
          return field.offset;
      throw std::invalid_argument("no field " + name);
    }

    auto
    F() const
    {
      return points.fields().find(FieldNames<dim>::deformation_gradient);
    }

    const Options               options;
    BackgroundMesh<dim>         mesh;
    const bool                  is_distorted;
    GridSpace<dim>              space;
    PointSet<dim>               points;
    std::vector<Body<dim>>      bodies;
    CellSeeder<dim>             seeder;
    std::unique_ptr<Basis<dim>> basis;

  private:
    /** Deformation gradients and volumes. */
    void
    update_state(const std::vector<dealii::Tensor<2, dim>> &gradients)
    {
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          dealii::Tensor<2, dim> increment = gradients[p];
          for (unsigned int i = 0; i < dim; ++i)
            increment[i][i] += 1;
          F().store(increment * F()(points.values(p)), points.values(p));
          points.values(p)[offset("volume")] *= determinant(increment);
        }
    }
  };
} // namespace moraine

#endif
