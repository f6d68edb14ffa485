// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/basis/body_parts.h>
#include <moraine/basis/cell_patch.h>
#include <moraine/basis/cpdi1_basis.h>
#include <moraine/basis/domain_tools.h>
#include <moraine/basis/gimp_basis.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "domain_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  template <int dim>
  CellVertices<dim>
  test_quad()
  {
    // Corners of the lower side of a hexahedron in 3D, moved a bit above.
    const double      x[4][2] = {{0, 0}, {1.1, .1}, {-.2, .9}, {1.3, 1.2}};
    CellVertices<dim> quad;
    for (unsigned int c = 0; c < quad.size(); ++c)
      for (unsigned int d = 0; d < dim; ++d)
        quad[c][d] = d < 2 ? x[c % 4][d] + 0.1 * (c / 4) * (c - 3.5) :
                             (c / 4) * (1 + 0.1 * c);
    return quad;
  }



  TEST(Domains, WeightsOfAQuadrilateral)
  {
    double       w[4];
    Tensor<1, 2> g[4];
    // Half the cross product of the diagonals.
    EXPECT_NEAR(DomainTools::average_weights<2>(test_quad<2>(), w, g),
                0.5 * (1.3 * 0.8 + 1.3 * 1.2),
                1e-14);
    const double expected[4]    = {.2314, .2429, .2571, .2686};
    const double gradient[4][2] = {{-.3077, -.5},
                                   {.4615, -.5},
                                   {-.4615, .5},
                                   {.3077, .5}};
    for (unsigned int c = 0; c < 4; ++c)
      {
        EXPECT_NEAR(w[c], expected[c], 5e-5);
        EXPECT_NEAR(g[c][0], gradient[c][0], 5e-5);
        EXPECT_NEAR(g[c][1], gradient[c][1], 5e-5);
      }
  }



  TEST(Domains, GradientWeightsAreDerivativesOfTheVolume)
  {
    double           w[8], unused_w[8];
    Tensor<1, 3>     g[8], unused_g[8];
    auto             hexahedron = test_quad<3>();
    const double     volume = DomainTools::average_weights<3>(hexahedron, w, g);
    constexpr double step   = 1e-2; // the volume is linear in each coordinate
    for (unsigned int c = 0; c < 8; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        {
          auto moved = hexahedron;
          moved[c][d] += step;
          const double larger =
            DomainTools::average_weights<3>(moved, unused_w, unused_g);
          EXPECT_NEAR(g[c][d], (larger - volume) / step / volume, 1e-12);
        }
  }



  /** Distort the domains of a scene, each in its own way. */
  template <int dim>
  void
  disturb(DomainScene<dim> &scene, const double size)
  {
    const bool         cpdi1 = scene.options.method == Method::cpdi1;
    const unsigned int n     = cpdi1 ? dim : 1 << dim;
    for (unsigned int v = 0; v < n; ++v)
      {
        const unsigned int offset = scene.offset(
          (cpdi1 ? "half_edge_" : "corner_") + std::to_string(v + 1));
        for (unsigned int p = 0; p < scene.points.n_local(); ++p)
          for (unsigned int d = 0; d < dim; ++d)
            scene.points.values(p)[offset + d] +=
              size * scene.noise(scene.points.id(p), v * dim + d);
      }
    scene.prepare();
  }



  /**
   * Sum N = 1, sum grad N = 0, sum N x_a = centroid, sum x_a (x) grad N = 1.
   */
  template <int dim>
  void
  check_completeness(const DomainScene<dim> &scene)
  {
    std::vector<unsigned int> seen(scene.points.n_local(), 0);
    StencilBlock<dim>         block;
    for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
      {
        scene.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            ++seen[block.points[p]];
            double         sum = 0;
            Tensor<1, dim> sum_gradient, place;
            Tensor<2, dim> gradient_of_place;
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              {
                const Tensor<1, dim> x =
                  scene.space.node_position(block.nodes[a]);
                sum += block.N(p)[a];
                sum_gradient += block.grad_N(p)[a];
                place += block.N(p)[a] * x;
                gradient_of_place += outer_product(x, block.grad_N(p)[a]);
              }
            double         w[1 << dim];
            Tensor<1, dim> weight_g[1 << dim], centroid;
            const auto corners = scene.basis->domain_corners(block.points[p]);
            DomainTools::average_weights<dim>(corners, w, weight_g);
            for (unsigned int c = 0; c < corners.size(); ++c)
              centroid += w[c] * corners[c];
            EXPECT_NEAR(sum, 1., 1e-13);
            EXPECT_NEAR(sum_gradient.norm(), 0., 1e-12);
            EXPECT_NEAR((place - centroid).norm(), 0., 1e-12);
            EXPECT_NEAR((gradient_of_place -
                         Tensor<2, dim>(unit_symmetric_tensor<dim>()))
                          .norm(),
                        0.,
                        1e-11);
          }
      }
    for (const unsigned int count : seen)
      EXPECT_EQ(count, 1u);
  }



  template <int dim>
  void
  check_all_meshes()
  {
    for (const Method method : {Method::cpdi1, Method::cpdi2})
      for (const bool distorted : {false, true})
        for (const double lower : {0., 0.3})
          {
            DomainSceneOptions options;
            options.method    = method;
            options.distorted = distorted;
            options.lower     = lower;
            // With lower = 0 corners reach over the edge of the mesh.
            DomainScene<dim> scene(options);
            check_completeness(scene);
            disturb(scene, 0.08);
            check_completeness(scene);
          }
  }



  TEST(Domains, CpdiIsComplete2D)
  {
    check_all_meshes<2>();
  }



  TEST(Domains, CpdiIsComplete3D)
  {
    check_all_meshes<3>();
  }



  /** N and grad N of every local point by id and place of the node. */
  template <int dim>
  std::map<std::pair<unsigned int, std::array<int, dim>>,
           std::pair<double, Tensor<1, dim>>>
  stencils(const DomainScene<dim> &scene)
  {
    std::map<std::pair<unsigned int, std::array<int, dim>>,
             std::pair<double, Tensor<1, dim>>>
                      all;
    StencilBlock<dim> block;
    for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
      {
        scene.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            {
              std::array<int, dim> place;
              for (unsigned int d = 0; d < dim; ++d)
                place[d] = std::lround(
                  1e6 * scene.space.node_position(block.nodes[a])[d]);
              if (std::abs(block.N(p)[a]) > 1e-14 ||
                  block.grad_N(p)[a].norm() > 1e-13)
                all[{scene.points.id(block.points[p]), place}] = {
                  block.N(p)[a], block.grad_N(p)[a]};
            }
      }
    return all;
  }



  template <int dim>
  void
  expect_same_stencils(const DomainScene<dim> &a, const DomainScene<dim> &b)
  {
    const auto of_a = stencils(a), of_b = stencils(b);
    ASSERT_EQ(of_a.size(), of_b.size());
    ASSERT_GT(of_a.size(), 0u);
    for (const auto &[key, value] : of_a)
      {
        ASSERT_TRUE(of_b.count(key));
        EXPECT_NEAR(value.first, of_b.at(key).first, 1e-13);
        EXPECT_NEAR((value.second - of_b.at(key).second).norm(), 0., 1e-12);
      }
  }



  template <int dim>
  void
  check_parallelograms(const bool distorted)
  {
    DomainSceneOptions options;
    options.lower     = 0.3;
    options.distorted = distorted;
    options.method    = Method::cpdi1;
    DomainScene<dim> cpdi1(options);
    disturb(cpdi1, 0.08);
    options.method = Method::cpdi2;
    DomainScene<dim> cpdi2(options);
    ASSERT_EQ(cpdi1.points.n_local(), cpdi2.points.n_local());
    for (unsigned int p = 0; p < cpdi2.points.n_local(); ++p)
      {
        ASSERT_EQ(cpdi1.points.id(p), cpdi2.points.id(p));
        const auto corners = cpdi1.basis->domain_corners(p);
        for (unsigned int c = 0; c < corners.size(); ++c)
          std::copy_n(corners[c].begin_raw(),
                      dim,
                      cpdi2.points.values(p) +
                        cpdi2.offset("corner_" + std::to_string(c + 1)));
      }
    cpdi2.prepare();
    expect_same_stencils(cpdi1, cpdi2);
  }



  TEST(Domains, Cpdi1IsCpdi2OfParallelepipeds)
  {
    check_parallelograms<2>(false);
    check_parallelograms<2>(true);
    check_parallelograms<3>(false);
    check_parallelograms<3>(true);
  }



  template <int dim>
  void
  check_points_within_a_cell()
  {
    DomainSceneOptions options;
    options.method = Method::mpm;
    const DomainScene<dim> mpm(options);
    for (const Method method : {Method::gimp, Method::cpdi1, Method::cpdi2})
      {
        options.method = method;
        expect_same_stencils(mpm, DomainScene<dim>(options));
      }
  }



  TEST(Domains, DomainsWithinACellAreTheirCentres)
  {
    check_points_within_a_cell<2>();
    check_points_within_a_cell<3>();
  }



  template <int dim>
  void
  check_general_search()
  {
    for (const Method method : {Method::cpdi1, Method::cpdi2})
      {
        DomainSceneOptions options;
        options.method = method;
        DomainScene<dim> box(options);
        options.box = false;
        DomainScene<dim> general(options);
        expect_same_stencils(box, general);
        disturb(box, 0.2);
        disturb(general, 0.2);
        expect_same_stencils(box, general);
      }
  }



  TEST(Domains, TheSearchInAnyMeshIsTheOneInABox)
  {
    check_general_search<2>();
    check_general_search<3>();
  }



  template <int dim>
  void
  check_patch(const bool is_box)
  {
    DomainSceneOptions options;
    options.method = Method::mpm;
    options.box    = is_box;
    const DomainScene<dim>    scene(options);
    const CellNeighbours<dim> neighbours(scene.mesh);
    CellPatch<dim>            patch(neighbours);
    const auto                middle = [](const double x) {
      Point<dim> place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = d == 0 ? x : 0.5;
      return place;
    };
    const auto end   = scene.mesh.triangulation().end();
    const auto first = neighbours.cell_around(neighbours.cell(0), middle(0.5));
    const auto next  = neighbours.cell_around(first, middle(1.5));
    unsigned int cell;
    double       N[1 << dim];
    EXPECT_TRUE(neighbours.cell_around(first, middle(3.5)) != end);
    EXPECT_TRUE(neighbours.cell_around(first, middle(-0.5)) == end);

    // A place on a face is on the side of the point.
    patch.reinit(first);
    EXPECT_TRUE(patch.locate(middle(0.9), middle(1), cell, N));
    EXPECT_EQ(cell, first->active_cell_index());
    patch.reinit(next);
    EXPECT_TRUE(patch.locate(middle(1.1), middle(1), cell, N));
    EXPECT_EQ(cell, next->active_cell_index());
    // Two cells further is too far.
    EXPECT_TRUE(patch.locate(middle(1.1), middle(2.9), cell, N));
    EXPECT_FALSE(patch.locate(middle(1.1), middle(3.1), cell, N));
    // Outside the mesh the nearest cell is continued.
    EXPECT_TRUE(patch.locate(middle(1.1), middle(-0.25), cell, N));
    EXPECT_EQ(cell, first->active_cell_index());
    EXPECT_NEAR(N[0], 1.25 / (1 << (dim - 1)), 1e-14);
    EXPECT_NEAR(N[1], -0.25 / (1 << (dim - 1)), 1e-14);
    // Outside, and along the edge of the mesh too far.
    Point<dim> outside = middle(3.1);
    outside[1]         = -0.25;
    EXPECT_FALSE(patch.locate(middle(1.1), outside, cell, N));
  }



  TEST(Domains, CornersFindTheirCells)
  {
    for (const bool is_box : {true, false})
      {
        check_patch<2>(is_box);
        check_patch<3>(is_box);
      }
  }



  /** A displacement that vanishes at the faces of the mesh. */
  template <int dim>
  Tensor<1, dim>
  smooth_move(const Point<dim> &x, const unsigned int step)
  {
    double bubble = 1;
    for (unsigned int d = 0; d < dim; ++d)
      bubble *= std::sin(numbers::PI / 4 * x[d]);
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = 0.12 * bubble * std::cos(x[(d + 1) % dim] + step + 2 * d);
    return u;
  }



  template <int dim>
  void
  check_conforming(const bool distorted)
  {
    DomainSceneOptions options;
    options.distorted = distorted;
    if (!distorted)
      {
        options.lower = 0.5; // whole sub-cells
        options.upper = 3.5;
      }
    DomainScene<dim> scene(options);
    // Where corners were at first, by point.
    std::map<unsigned int, std::vector<Point<dim>>> first;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const auto corners = scene.basis->domain_corners(p);
        first[scene.points.id(p)].assign(corners.begin(), corners.end());
      }
    std::map<unsigned int, std::vector<Point<dim>>> all_first;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(MPI_COMM_WORLD, first))
      all_first.insert(of_rank.begin(), of_rank.end());

    for (unsigned int step = 0; step < 5; ++step)
      {
        const auto nodal = scene.nodal(
          [&](const Point<dim> &x) { return smooth_move<dim>(x, step); });
        EXPECT_EQ(scene.basis->failure_of(nodal), "");
        scene.accept(nodal);
      }

    std::map<unsigned int, std::vector<Point<dim>>> last;
    double                                          volume = 0;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const auto corners = scene.basis->domain_corners(p);
        last[scene.points.id(p)].assign(corners.begin(), corners.end());
        volume += scene.points.volume(p);
      }
    std::map<std::array<long, dim>, Point<dim>> place_of;
    unsigned int                                shared   = 0;
    double                                      furthest = 0;
    for (const auto &of_rank : Utilities::MPI::all_gather(MPI_COMM_WORLD, last))
      for (const auto &[id, corners] : of_rank)
        for (unsigned int c = 0; c < corners.size(); ++c)
          {
            std::array<long, dim> key;
            for (unsigned int d = 0; d < dim; ++d)
              key[d] = std::lround(1e9 * all_first.at(id)[c][d]);
            furthest =
              std::max(furthest, corners[c].distance(all_first.at(id)[c]));
            const auto [other, is_new] = place_of.insert({key, corners[c]});
            if (is_new)
              continue;
            ++shared;
            EXPECT_LT(corners[c].distance(other->second), 1e-13);
          }
    EXPECT_GE(shared, 95u);
    EXPECT_GT(furthest, 0.15);
    // Domains that fill the mesh go on to fill it.
    if (distorted)
      {
        const double whole = Utilities::MPI::sum(volume, MPI_COMM_WORLD);
        EXPECT_NEAR(whole, std::pow(4., dim), 1e-11);
      }
  }



  TEST(Domains, Cpdi2StaysConforming)
  {
    check_conforming<2>(false);
    check_conforming<2>(true);
    check_conforming<3>(false);
    check_conforming<3>(true);
  }



  TEST(Domains, Cpdi2TakesTheVolumesOfSubCells)
  {
    // Gauss points of skewed cells: weight times Jacobian is not the volume.
    DomainSceneOptions options;
    options.distorted = true;
    options.layout    = PointLayout::gauss;
    options.method    = Method::mpm;
    const DomainScene<2> gauss(options);
    options.method = Method::cpdi2;
    const DomainScene<2> scene(options);
    double               difference = 0, sum = 0;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        difference += std::abs(gauss.points.volume(p) - scene.points.volume(p));
        sum += scene.points.volume(p);
        EXPECT_EQ(scene.points.values(p)[scene.offset("initial_volume")],
                  scene.points.volume(p));
      }
    EXPECT_GT(Utilities::MPI::sum(difference, MPI_COMM_WORLD), 0.01);
    EXPECT_NEAR(Utilities::MPI::sum(sum, MPI_COMM_WORLD), 16., 1e-12);
  }



  template <int dim>
  void
  check_domains_of_cut_points(const bool distorted)
  {
    for (const Method method : {Method::cpdi1, Method::cpdi2})
      {
        DomainSceneOptions options;
        options.method    = method;
        options.lower     = 0.3;
        options.upper     = 3.4;
        options.distorted = distorted;
        const DomainScene<dim> scene(options);
        double                 sum = 0, of_domains = 0;
        for (unsigned int p = 0; p < scene.points.n_local(); ++p)
          {
            double         w[1 << dim];
            Tensor<1, dim> g[1 << dim];
            const double   of_domain =
              DomainTools::average_weights<dim>(scene.basis->domain_corners(p),
                                                w,
                                                g);
            EXPECT_LT(of_domain,
                      scene.points.volume(p) *
                        (distorted && dim == 3 ? 1.05 : 1 + 1e-12));
            sum += scene.points.volume(p);
            of_domains += of_domain;
          }
        const double whole = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
        EXPECT_NEAR(whole, std::pow(3.1, dim), 1e-11);
        EXPECT_GT(Utilities::MPI::sum(of_domains, MPI_COMM_WORLD), 0.9 * whole);
      }
  }



  TEST(Domains, CutDomainsAreNotLargerThanTheirPoints)
  {
    for (const bool distorted : {false, true})
      {
        check_domains_of_cut_points<2>(distorted);
        check_domains_of_cut_points<3>(distorted);
      }
  }



  /** sum_p v_p grad S_ap of the nodes, over all ranks. */
  template <int dim>
  std::vector<Tensor<1, dim>>
  gradient_sums(const DomainSceneOptions &options)
  {
    const DomainScene<dim>      scene(options);
    std::vector<Tensor<1, dim>> sums(scene.space.n_nodes());
    StencilBlock<dim>           block;
    for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
      {
        scene.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          for (unsigned int a = 0; a < block.n_nodes; ++a)
            sums[block.nodes[a]] +=
              scene.points.volume(block.points[p]) * block.grad_N(p)[a];
      }
    auto vector = scene.space.vector();
    scene.space.sum_node_values(sums, vector);
    scene.space.node_values(vector, sums);
    return sums;
  }



  template <int dim>
  void
  check_gradients_of_turned_body()
  {
    for (const double turn : {0., 17., 40., 71.})
      for (const Method method : {Method::cpdi1, Method::cpdi2})
        for (const bool distorted : {false, true})
          {
            // Parallelograms do not fill cells that are none.
            if (distorted && (dim == 3 || method == Method::cpdi1))
              continue;
            DomainSceneOptions options;
            options.lower     = 1.12;
            options.upper     = 2.97;
            options.turn      = turn;
            options.distorted = distorted;
            options.method    = Method::mpm;
            const auto exact  = gradient_sums<dim>(options);
            options.method    = method;
            const auto sums   = gradient_sums<dim>(options);
            ASSERT_EQ(sums.size(), exact.size());
            for (unsigned int a = 0; a < sums.size(); ++a)
              EXPECT_LT((sums[a] - exact[a]).norm(), 1e-9);
          }
  }



  // Points at centroids integrate gradients over a straight-sided body; domains
  // within the cells do so too.
  TEST(Domains, DomainsOfCutCellsIntegrateGradients)
  {
    check_gradients_of_turned_body<2>();
    check_gradients_of_turned_body<3>();
  }



  TEST(Domains, ListedPointsHaveSquaresOrTheirOwnEdges)
  {
    for (const bool turned : {false, true})
      {
        BackgroundMesh<2> mesh(unit_cells<2>(4), MPI_COMM_WORLD);
        GridSpace<2>      space(mesh, 1);
        PointFields       fields;
        Cpdi1Basis<2>::request_fields(fields);
        PointSet<2>  points(mesh, fields);
        PointList<2> list;
        list.positions = {Point<2>(1.5, 1.5)};
        list.volumes   = {0.16};
        if (turned)
          list.half_edges = Tensor<2, 2>({{0.3, -0.1}, {0.1, 0.1}});
        const std::vector<Body<2>> bodies{{"listed", list}};
        const CellSeeder<2>        seeder(2, PointLayout::equal);
        seed_bodies(bodies, seeder, points);
        Cpdi1Basis<2> basis(space, points, seeder, bodies);
        basis.initialise_points(points);
        for (unsigned int p = 0; p < points.n_local(); ++p)
          {
            const auto     corners = basis.domain_corners(p);
            const Point<2> expected =
              turned ? Point<2>(1.7, 1.7) : Point<2>(1.7, 1.7);
            EXPECT_LT(corners[3].distance(expected), 1e-14);
            EXPECT_LT(corners[1].distance(turned ? Point<2>(1.9, 1.5) :
                                                   Point<2>(1.7, 1.3)),
                      1e-14);
          }
      }
  }



  template <int dim>
  Tensor<2, dim>
  tensor(const double xx, const double xy, const double yx, const double yy)
  {
    Tensor<2, dim> F = unit_symmetric_tensor<dim>();
    F[0][0]          = xx;
    F[0][1]          = xy;
    F[1][0]          = yx;
    F[1][1]          = yy;
    return F;
  }



  /** Edges of the domain of one point after a homogeneous deformation. */
  template <int dim>
  std::vector<Tensor<1, dim>>
  edges_after(const Method method, const Tensor<2, dim> &F)
  {
    DomainSceneOptions options;
    options.method = method;
    options.lower  = 1;
    options.upper  = 3;
    DomainScene<dim> scene(options);
    Tensor<1, dim>   centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = 2;
    // Points stay in the mesh, as the body lies around its middle.
    scene.accept(scene.nodal(
      [&](const Point<dim> &x) { return F * (x - centre) - (x - centre); }));
    std::vector<Tensor<1, dim>> edges;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const auto corners = scene.basis->domain_corners(p);
        for (unsigned int d = 0; d < dim; ++d)
          edges.push_back(corners[1u << d] - corners[0]);
      }
    return edges;
  }



  template <int dim>
  void
  expect_edges(const Method                  method,
               const Tensor<2, dim>         &F,
               const std::array<double, dim> expected)
  {
    const auto edges = edges_after<dim>(method, F);
    for (unsigned int i = 0; i < edges.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        EXPECT_NEAR(edges[i][d], d == i % dim ? expected[d] : 0., 1e-12);
  }



  TEST(Domains, BoxesOfGimpFollowAStretch)
  {
    // Edges are 1/2 at first.
    expect_edges<2>(Method::gimp, tensor<2>(1.6, 0, 0, 0.8), {{0.5, 0.5}});
    for (const Method method : {Method::gimp_stretch, Method::gimp_corners})
      {
        expect_edges<2>(method, tensor<2>(1.6, 0, 0, 0.8), {{0.8, 0.4}});
        expect_edges<3>(method, tensor<3>(1.6, 0, 0, 0.8), {{0.8, 0.4, 0.5}});
      }
  }



  TEST(Domains, BoxesOfGimpInShearAndRotation)
  {
    // Simple shear by 1: the stretch has 1.2 times the area, tracked corners
    // have the right one, with square boxes.
    expect_edges<2>(Method::gimp_stretch,
                    tensor<2>(1, 1, 0, 1),
                    {{0.5 * 2 / std::sqrt(5.), 0.5 * 3 / std::sqrt(5.)}});
    expect_edges<2>(Method::gimp_corners, tensor<2>(1, 1, 0, 1), {{0.5, 0.5}});
    // A turn by 90 degrees after a stretch leaves the box of U as it was.
    expect_edges<2>(Method::gimp_stretch,
                    tensor<2>(0, -0.8, 1.6, 0),
                    {{0.8, 0.4}});
    // One by 60 degrees halves tracked lengths; the volume is put right.
    const double c = 0.5, s = std::sqrt(0.75);
    expect_edges<2>(Method::gimp_corners, tensor<2>(c, -s, s, c), {{0.5, 0.5}});
  }



  TEST(Domains, FailureNamesAPoint)
  {
    DomainSceneOptions options;
    options.lower = 1;
    options.upper = 3;
    for (const Method method : {Method::gimp_corners, Method::cpdi2})
      {
        options.method = method;
        DomainScene<2> scene(options);
        const auto     still =
          scene.nodal([](const Point<2> &) { return Tensor<1, 2>(); });
        EXPECT_EQ(scene.basis->failure_of(still), "");
        // A turn by more than 90 degrees for GIMP, a reflection for CPDI2.
        const Tensor<2, 2> F = method == Method::cpdi2 ?
                                 tensor<2>(-1, 0, 0, 1) :
                                 tensor<2>(-0.6, -0.8, 0.8, -0.6);
        const std::string  failure =
          scene.basis->failure_of(scene.nodal([&](const Point<2> &x) {
            return F * (x - Point<2>(2, 2)) - (x - Point<2>(2, 2));
          }));
        if (scene.points.n_local() > 0)
          {
            EXPECT_EQ(failure.rfind("point " +
                                      std::to_string(scene.points.id(0)) +
                                      " at (",
                                    0),
                      0u)
              << failure;
            EXPECT_NE(failure.find("its"), std::string::npos);
          }
      }
  }



  template <int dim>
  void
  overlap_by_round_off()
  {
    // Boxes of length 1/2 that end at 3 get longer by 3e-9: more than the
    // relative 1e-8 by which places on faces keep to the point's side, less
    // than what makes the next cell active.
    DomainSceneOptions options;
    options.method = Method::gimp_corners;
    options.lower  = 1;
    options.upper  = 3;
    DomainScene<dim>   scene(options);
    const unsigned int active = scene.space.n_active_cells();
    scene.accept(scene.nodal([](const Point<dim> &x) { return 1e-9 * x; }));
    EXPECT_EQ(scene.space.n_active_cells(), active);
    EXPECT_EQ(scene.basis->failure_of(scene.nodal(
                [](const Point<dim> &) { return Tensor<1, dim>(); })),
              "");
    scene.accept(scene.nodal([](const Point<dim> &x) { return 0.25 * x; }));
    const unsigned int offset = scene.offset("half_length");
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        EXPECT_NEAR(scene.points.values(p)[offset + d], 0.3125, 1e-8);
  }

  TEST(Domains, CornersThatOverlapACellByRoundOff)
  {
    overlap_by_round_off<2>();
    overlap_by_round_off<3>();
  }



  TEST(Domains, BoxesOfGimpReachTheFacesOfSubCellsOfGaussPoints)
  {
    const CellSeeder<2>     seeder(4, PointLayout::gauss);
    const dealii::QGauss<1> line(4);
    const BackgroundMesh<2> mesh(unit_cells<2>(4), MPI_COMM_WORLD);
    const GridSpace<2>      space(mesh, 1);
    PointFields             layout;
    GimpBasis<2>::request_fields(layout);
    PointSet<2> points(mesh, layout);
    seed_bodies({{"box", make_box<2>(Point<2>(1, 1), Point<2>(3, 3))}},
                seeder,
                points);
    const GimpBasis<2> basis(space, points, seeder, {true});
    basis.initialise_points(points);
    const auto half_length =
      points.fields().find(FieldNames<2>::Vector{"half_length", "length"});
    for (unsigned int p = 0; p < points.n_local(); ++p)
      for (unsigned int d = 0; d < 2; ++d)
        {
          // The outer points come first and last; all are symmetric.
          const double x     = points.position(p)[d];
          const double place = std::min(x - std::floor(x), std::ceil(x) - x);
          const bool   outer = place < line.weight(0);
          EXPECT_NEAR(half_length(points.values(p))[d],
                      outer ? place : place - line.weight(0),
                      1e-12);
        }
  }



  template <int dim>
  void
  torn_body(const Method method)
  {
    DomainSceneOptions options;
    options.method = method;
    options.lower  = 0;
    options.upper  = 2;
    DomainScene<dim> scene(options);
    const auto       parts = [&scene]() {
      return parts_of_bodies(scene.space, scene.points, *scene.basis, 1)[0];
    };
    ASSERT_EQ(parts().size(), 1u);
    EXPECT_NEAR(parts()[0].volume, std::pow(2., dim), 1e-12);
    // What lies behind x = 1 goes away by 0.6, and cell 1 holds the body
    // together, then by 1.3, and cell 1 is empty.
    for (const double way : {0.6, 0.7})
      {
        for (unsigned int p = 0; p < scene.points.n_local(); ++p)
          {
            Point<dim> x = scene.points.position(p);
            if (x[0] > 1)
              x[0] += way;
            scene.points.set_position(p, x);
          }
        scene.points.find_cells();
        scene.prepare();
        if (way == 0.6)
          {
            EXPECT_EQ(parts().size(), 1u);
          }
      }
    const auto torn = parts();
    ASSERT_EQ(torn.size(), 2u);
    for (const auto &part : torn)
      {
        EXPECT_NEAR(part.volume, std::pow(2., dim - 1), 1e-12);
        EXPECT_NEAR(part.centre[1], 1., 1e-12);
        EXPECT_NEAR(std::abs(part.centre[0] - 1.65), 1.15, 1e-12);
      }
  }

  TEST(Domains, PartsOfABodyThatIsTorn)
  {
    torn_body<2>(Method::mpm);
    torn_body<2>(Method::gimp);
    torn_body<3>(Method::mpm);
    torn_body<3>(Method::gimp);
  }



  TEST(Domains, Cpdi1EdgesFollowTheDeformation)
  {
    const Tensor<2, 2> F     = tensor<2>(1.2, 0.7, -0.4, 0.9);
    const auto         edges = edges_after<2>(Method::cpdi1, F);
    for (unsigned int i = 0; i < edges.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        EXPECT_NEAR(edges[i][d], 0.5 * F[d][i % 2], 1e-12);
    const auto corners = edges_after<2>(Method::cpdi2, F);
    ASSERT_EQ(corners.size(), edges.size());
    for (unsigned int i = 0; i < edges.size(); ++i)
      EXPECT_NEAR((corners[i] -
                   F * Tensor<1, 2>({i % 2 ? 0. : 0.5, i % 2 ? 0.5 : 0.}))
                    .norm(),
                  0.,
                  1e-12);
  }



  TEST(Domains, SmallStrainKeepsShapes)
  {
    for (const Method method : {Method::gimp_stretch,
                                Method::gimp_corners,
                                Method::cpdi1,
                                Method::cpdi2})
      {
        DomainSceneOptions options;
        options.method        = method;
        options.lower         = 1;
        options.upper         = 3;
        options.finite_strain = false;
        DomainScene<2> scene(options);
        scene.accept(
          scene.nodal([&](const Point<2> &x) { return smooth_move<2>(x, 0); }));
        double moved = 0;
        for (unsigned int p = 0; p < scene.points.n_local(); ++p)
          {
            const auto     corners = scene.basis->domain_corners(p);
            const Point<2> x       = scene.points.position(p);
            EXPECT_LT(corners[0].distance(x + Point<2>(-0.25, -0.25)), 1e-14);
            EXPECT_LT(corners[3].distance(x + Point<2>(0.25, 0.25)), 1e-14);
            EXPECT_NEAR(scene.points.volume(p), 0.25, 1e-15);
            moved += std::abs(4 * x[0] - std::round(4 * x[0]));
          }
        EXPECT_GT(Utilities::MPI::sum(moved, MPI_COMM_WORLD), 0.1);
      }
  }



  /** Lengthen the domains of all points with an odd id in direction x. */
  template <int dim>
  void
  lengthen(DomainScene<dim> &scene, const double factor)
  {
    const Method       method = scene.options.method;
    const unsigned int offset =
      scene.offset(method == Method::cpdi1 ? "half_edge_1" :
                   method == Method::cpdi2 ? "corner_1" :
                                             "half_length");
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        double      *values = scene.points.values(p);
        const double x      = scene.points.position(p)[0];
        if (scene.points.id(p) % 2 == 1 && method == Method::cpdi2)
          for (unsigned int c = 0; c < (1u << dim); ++c)
            values[offset + dim * c] =
              x + factor * (values[offset + dim * c] - x);
        else if (scene.points.id(p) % 2 == 1)
          values[offset] *= factor;
        // marks the halves of a point, and stands for its velocity
        values[scene.points.displacement_offset()] = scene.points.id(p);
      }
  }



  /** Sums over all points of volume, volume * place, volume * displacement,
   * and of the domains' volumes where they are not boxes. */
  template <int dim>
  std::vector<double>
  sums(const DomainScene<dim> &scene)
  {
    std::vector<double> result(2 * dim + 3, 0.);
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const double  v = scene.points.volume(p);
        const double *u =
          scene.points.values(p) + scene.points.displacement_offset();
        result[0] += v;
        result[1] += scene.points.values(p)[scene.offset("initial_volume")];
        for (unsigned int d = 0; d < dim; ++d)
          {
            result[2 + d] += v * scene.points.position(p)[d];
            result[2 + dim + d] += v * u[d];
          }
        if (scene.options.method == Method::cpdi1 ||
            scene.options.method == Method::cpdi2)
          result[2 + 2 * dim] +=
            DomainTools::volume<dim>(scene.basis->domain_corners(p));
      }
    Utilities::MPI::sum(result, MPI_COMM_WORLD, result);
    return result;
  }



  template <int dim>
  void
  check_split(const Method method, const bool distorted)
  {
    DomainSceneOptions options;
    options.method    = method;
    options.distorted = distorted;
    options.lower     = 1;
    options.upper     = 3;
    options.split     = true;
    DomainScene<dim>   scene(options);
    const unsigned int n_before = scene.points.n_global();
    unsigned int       next     = 0;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      next = std::max(next, scene.points.id(p) + 1);
    next = Utilities::MPI::max(next, MPI_COMM_WORLD);

    EXPECT_FALSE(scene.basis->split_domains(scene.points));
    lengthen(scene, 3.); // to 1.5 cells, so two halves are enough
    const auto before = sums(scene);
    EXPECT_TRUE(scene.basis->split_domains(scene.points));
    scene.points.find_cells();
    scene.prepare();
    const auto after = sums(scene);
    for (unsigned int i = 0; i < after.size(); ++i)
      EXPECT_NEAR(after[i], before[i], 1e-13 * std::abs(before[i]));
    EXPECT_GT(scene.points.n_global(), n_before);
    if (!distorted)
      {
        EXPECT_EQ(scene.points.n_global(), n_before + n_before / 2);
      }
    EXPECT_FALSE(scene.basis->split_domains(scene.points));
    if (method == Method::cpdi1 || method == Method::cpdi2)
      check_completeness(scene);

    // Ids: the k-th of the split points gave the upper half id next + k.
    std::map<unsigned int, unsigned int> whole_of;
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      whole_of[scene.points.id(p)] =
        std::lround(scene.points.values(p)[scene.points.displacement_offset()]);
    std::map<unsigned int, unsigned int> all;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(MPI_COMM_WORLD, whole_of))
      for (const auto &[id, whole] : of_rank)
        EXPECT_TRUE(all.insert({id, whole}).second);
    EXPECT_EQ(all.size(), scene.points.n_global());
    EXPECT_EQ(all.rbegin()->first, next + all.size() - n_before - 1);
    unsigned int last_whole = 0;
    if (!distorted)
      for (const auto &[id, whole] : all)
        if (id >= next)
          {
            EXPECT_EQ(whole % 2, 1u);
            EXPECT_GE(whole, last_whole);
            last_whole = whole;
          }
  }



  TEST(Domains, SplitConserves)
  {
    check_split<2>(Method::gimp_corners, false);
    check_split<2>(Method::cpdi1, false);
    check_split<2>(Method::cpdi1, true);
    check_split<2>(Method::cpdi2, false);
    check_split<2>(Method::cpdi2, true);
    check_split<3>(Method::gimp_corners, false);
    check_split<3>(Method::cpdi1, false);
    check_split<3>(Method::cpdi1, true);
    check_split<3>(Method::cpdi2, false);
    check_split<3>(Method::cpdi2, true);
  }



  /** Halves of domains that went along with x -> A x + b are where that has
   * taken their material. */
  template <int dim>
  void
  check_displacement_of_halves(const Method method)
  {
    DomainSceneOptions options;
    options.method = method;
    options.lower  = 1;
    options.upper  = 3;
    options.split  = true;
    DomainScene<dim> scene(options);
    Tensor<2, dim>   A = unit_symmetric_tensor<dim>();
    A[0][0]            = 1.7;
    A[1][0]            = 0.1;
    A[0][1]            = 0.05;
    Point<dim> middle;
    for (unsigned int d = 0; d < dim; ++d)
      middle[d] = 2;
    const auto displacement = [&](const Point<dim> &X) {
      return A * (X - middle) - (X - middle);
    };
    const auto &u = scene.points.displacement_field();
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      u.store(displacement(scene.points.position(p)), scene.points.values(p));
    const unsigned int n_before = scene.points.n_global();
    scene.accept(scene.nodal(displacement));
    EXPECT_EQ(scene.points.n_global(), 2 * n_before);
    for (unsigned int p = 0; p < scene.points.n_local(); ++p)
      {
        const Tensor<1, dim> found = u(scene.points.values(p));
        const Point<dim>     X     = scene.points.position(p) - found;
        EXPECT_NEAR((found - displacement(X)).norm(), 0., 1e-13);
      }
  }



  TEST(Domains, HalvesHaveTheDisplacementOfTheirPlace)
  {
    check_displacement_of_halves<2>(Method::gimp_corners);
    check_displacement_of_halves<2>(Method::cpdi1);
    check_displacement_of_halves<2>(Method::cpdi2);
    check_displacement_of_halves<3>(Method::gimp_corners);
    check_displacement_of_halves<3>(Method::cpdi1);
    check_displacement_of_halves<3>(Method::cpdi2);
  }



  // One that is bent to an angle of almost 180 degrees is not what a stretch
  // makes of it, and one that reaches out of the mesh has no place for a half.
  TEST(Domains, WhatIsNotHalved)
  {
    DomainSceneOptions options;
    options.method = Method::cpdi2;
    options.split  = true;
    options.lower  = 1;
    options.upper  = 3;
    DomainScene<2>     bent(options);
    const unsigned int corner = bent.offset("corner_1");
    const auto         bend   = [&](const double to_diagonal) {
      for (unsigned int p = 0; p < bent.points.n_local(); ++p)
        {
          double      *x     = bent.points.values(p) + corner;
          const double old_x = x[0], old_y = x[1];
          x[6] = old_x + 0.8;
          x[2] = old_x + 0.5 - 0.1 * to_diagonal;
          x[3] = old_y + 0.25 * to_diagonal;
        }
    };
    bend(1.);
    EXPECT_FALSE(bent.basis->split_domains(bent.points));
    bend(0.);
    EXPECT_TRUE(bent.basis->split_domains(bent.points));

    options.lower = 0;
    options.upper = 4;
    for (const Method method : {Method::cpdi1, Method::cpdi2})
      {
        options.method = method;
        DomainScene<2> scene(options);
        lengthen(scene, 3.);
        const auto n_outside = [&] {
          unsigned int n = 0;
          for (unsigned int p = 0; p < scene.points.n_local(); ++p)
            for (const Point<2> &c : scene.basis->domain_corners(p))
              if (c[0] < -0.1 || c[0] > 4.1)
                {
                  ++n;
                  break;
                }
          return Utilities::MPI::sum(n, MPI_COMM_WORLD);
        };
        const unsigned int before = n_outside();
        EXPECT_GT(before, 0u);
        EXPECT_TRUE(scene.basis->split_domains(scene.points));
        EXPECT_EQ(n_outside(), before);
      }

    // Of four columns of long boxes all are, but the one beside the edge.
    options.method = Method::gimp_corners;
    DomainScene<2> boxes(options);
    lengthen(boxes, 3.);
    EXPECT_TRUE(boxes.basis->split_domains(boxes.points));
    EXPECT_NO_THROW(boxes.points.find_cells());
    EXPECT_EQ(boxes.points.n_global(), 64u + 3 * 8);
  }



  // Points of a grid or a file may stand for as much as a cell.
  TEST(Domains, OwnPointsAreHalvedIfTheyAreStretched)
  {
    for (const Method method : {Method::gimp_stretch,
                                Method::gimp_corners,
                                Method::cpdi1,
                                Method::cpdi2})
      {
        SCOPED_TRACE(static_cast<int>(method));
        DomainSceneOptions options;
        options.method     = method;
        options.split      = true;
        options.lower      = 1;
        options.upper      = 3;
        options.own_points = 2;
        DomainScene<2> scene(options);
        EXPECT_FALSE(scene.basis->split_domains(scene.points));
        lengthen(scene, 1.1);
        EXPECT_TRUE(scene.basis->split_domains(scene.points));
        EXPECT_EQ(scene.points.n_global(), 6u);
      }
  }



  // Probes and files tell points by their ids.
  TEST(Domains, HalvesTakeNoIdOfABodyThatIsAway)
  {
    const BackgroundMesh<2> mesh(unit_cells<2>(4), MPI_COMM_WORLD);
    PointSet<2>             points(mesh, PointFields());
    seed_bodies<2>({{"ground", make_box<2>(Point<2>(0, 0), Point<2>(4, 1))},
                    {"fill", make_box<2>(Point<2>(0, 2), Point<2>(4, 3))}},
                   CellSeeder<2>(2, PointLayout::equal),
                   points);
    const auto ids_of = [&](const unsigned int body) {
      std::vector<unsigned int> ids;
      for (unsigned int p = 0; p < points.n_local(); ++p)
        if (points.body(p) == body)
          ids.push_back(points.id(p));
      std::vector<unsigned int> all;
      for (const auto &of_rank :
           Utilities::MPI::all_gather(MPI_COMM_WORLD, ids))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      std::sort(all.begin(), all.end());
      return all;
    };
    const auto ids  = ids_of(1);
    const auto fill = points.records_of(1);
    points.exchange_bodies({true, false}, {});
    // In four, so that the halves would reach the ids of the fill.
    EXPECT_TRUE(DomainTools::split_points<2>(
      points,
      [&](const unsigned int p) { return points.volume(p) > 0.1 ? 0u : 2u; },
      [&](const unsigned int lower, const unsigned int, const unsigned int) {
        DomainTools::Halves<2> halves;
        halves.upper[0] = 0.5 * points.volume(lower);
        halves.lower    = -halves.upper;
        return halves;
      }));
    points.find_cells();
    points.exchange_bodies({true, false}, fill);
    EXPECT_EQ(ids_of(1), ids);
    auto all = ids_of(0);
    EXPECT_EQ(all.size(), 64u);
    all.insert(all.end(), ids.begin(), ids.end());
    std::sort(all.begin(), all.end());
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
  }



  TEST(Domains, LongBoxesOfGimpAreComplete)
  {
    // Half lengths up to a cell: four nodes in a direction.
    DomainSceneOptions options;
    options.method = Method::gimp;
    options.lower  = 1;
    options.upper  = 3;
    DomainScene<2> scene(options);
    lengthen(scene, 4.);
    scene.prepare();
    unsigned int    n_long = 0;
    StencilBlock<2> block;
    for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
      {
        scene.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            double       sum = 0;
            Tensor<1, 2> place, gradient;
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              {
                const Tensor<1, 2> x =
                  scene.space.node_position(block.nodes[a]);
                sum += block.N(p)[a];
                place += block.N(p)[a] * x;
                gradient += x[0] * block.grad_N(p)[a];
              }
            EXPECT_NEAR(sum, 1, 1e-14);
            EXPECT_NEAR(place[0],
                        scene.points.position(block.points[p])[0],
                        1e-13);
            EXPECT_NEAR(gradient[0], 1, 1e-13);
            EXPECT_NEAR(gradient[1], 0, 1e-13);
            n_long += block.n_nodes == 8;
          }
      }
    EXPECT_GE(Utilities::MPI::sum(n_long, MPI_COMM_WORLD), 8u);
  }



  TEST(Domains, TooLargeADomainIsNamed)
  {
    {
      DomainSceneOptions options;
      options.method = Method::gimp;
      options.lower  = 1;
      options.upper  = 3;
      DomainScene<2> scene(options);
      lengthen(scene, 8.);
      std::string message;
      try
        {
          scene.prepare();
        }
      catch (const ComputationError &error)
        {
          message = error.what();
        }
      EXPECT_EQ(message.rfind("point ", 0), 0u);
      EXPECT_NE(message.find(" at ("), std::string::npos);
      EXPECT_NE(message.find(" the limit of "), std::string::npos);
      EXPECT_NE(message.find("'Split domains = true'"), std::string::npos)
        << message;
    }
  }



  TEST(Domains, FarCornersAreFoundAndCounted)
  {
    for (const Method method : {Method::cpdi1, Method::cpdi2})
      {
        DomainSceneOptions options;
        options.method = method;
        options.lower  = 1;
        options.upper  = 3;
        DomainScene<2> scene(options);
        scene.prepare();
        EXPECT_EQ(scene.basis->n_far_domains(), 0u);
        unsigned int n_long = 0;
        if (method == Method::cpdi2)
          {
            const unsigned int corner = scene.offset("corner_2");
            for (unsigned int p = 0; p < scene.points.n_local(); ++p)
              if (scene.points.id(p) % 2 == 1)
                {
                  scene.points.values(p)[corner] += 2.5;
                  ++n_long;
                }
          }
        else
          {
            lengthen(scene, 8.);
            n_long = scene.points.n_local();
          }
        scene.prepare();
        EXPECT_LE(scene.basis->n_far_domains(), n_long);
        EXPECT_GT(Utilities::MPI::sum(scene.basis->n_far_domains(),
                                      MPI_COMM_WORLD),
                  0u);
        // Linear functions are reproduced, wherever the corners are.
        StencilBlock<2> block;
        for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
          {
            scene.basis->evaluate(g, block);
            for (unsigned int p = 0; p < block.n_points; ++p)
              {
                Tensor<2, 2> one;
                for (unsigned int a = 0; a < block.n_nodes; ++a)
                  one += outer_product(Tensor<1, 2>(scene.space.node_position(
                                         block.nodes[a])),
                                       block.grad_N(p)[a]);
                EXPECT_NEAR(
                  (one - Tensor<2, 2>(unit_symmetric_tensor<2>())).norm(),
                  0.,
                  1e-10);
              }
          }
      }
  }
} // namespace
