// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Nodes of cut cells that follow filled ones.

#include <moraine/mesh/active_search.h>
#include <moraine/state/aggregates.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  template <int dim>
  std::vector<unsigned char>
  cells_of_points(const PointSet<dim> &points, const BackgroundMesh<dim> &mesh)
  {
    std::vector<unsigned char> active(mesh.triangulation().n_active_cells(), 0);
    for (const auto &in_cell : points.cells())
      active[in_cell.cell->active_cell_index()] = 1;
    return active;
  }



  /** The scene with its ties. */
  template <int dim>
  struct TiedScene : SmallScene<dim>
  {
    explicit TiedScene(const double fill)
      : SmallScene<dim>(false, 2)
      , aggregates({fill})
    {
      const auto active = cells_of_points(this->points, this->mesh);
      this->space.set_active_cells(active);
      changed = tie(active);
    }

    bool
    tie(const std::vector<unsigned char>          &active,
        const typename Aggregates<dim>::AskOfCell &holds_mean_in = {})
    {
      return aggregates.tie_nodes(
        this->space,
        this->points,
        [this](const unsigned int p) { return this->points.volume(p); },
        active,
        holds_mean_in);
    }

    /** Which part of the cell with this lower corner the body fills. */
    static double
    fill(const Point<dim> &corner)
    {
      const double of_row[] = {0.7, 1., 1., 0.4};
      double       part     = 1;
      for (unsigned int d = 0; d < dim; ++d)
        part *= of_row[static_cast<unsigned int>(std::lround(corner[d]))];
      return part;
    }

    Aggregates<dim> aggregates;
    bool            changed;
  };



  template <int dim>
  void
  tied_are_the_nodes_without_a_filled_cell()
  {
    TiedScene<dim>         scene(0.5);
    const auto            &space = scene.space;
    std::set<unsigned int> tied;
    for (const auto &tie : scene.aggregates.ties())
      tied.insert(tie.node);
    unsigned int n_tied = 0;
    for (unsigned int node = 0; node < space.n_nodes(); ++node)
      {
        bool is_filled = false;
        for (const auto &cell :
             scene.mesh.triangulation().active_cell_iterators())
          for (const unsigned int v : cell->vertex_indices())
            is_filled =
              is_filled ||
              (cell->vertex(v).distance(space.node_position(node)) < 1e-9 &&
               TiedScene<dim>::fill(cell->vertex(0)) > 0.5);
        EXPECT_EQ(tied.count(node), is_filled ? 0u : 1u)
          << space.node_position(node);
        n_tied += !is_filled;
      }
    EXPECT_GT(Utilities::MPI::sum(n_tied, MPI_COMM_WORLD), 0u);
    EXPECT_TRUE(scene.aggregates.nodes_without_root().empty());
    EXPECT_FALSE(Utilities::MPI::max(
      int(scene.tie(cells_of_points(scene.points, scene.mesh))),
      MPI_COMM_WORLD));
  }

  TEST(Aggregates, TiedAreTheNodesWithoutAFilledCell)
  {
    tied_are_the_nodes_without_a_filled_cell<2>();
    tied_are_the_nodes_without_a_filled_cell<3>();
  }



  TEST(Aggregates, HalfOfACellInWhichMeansAreHeldHasToBeFilled)
  {
    // 0.4 of the last column of cells, 0.7 of the first, is filled.
    const auto ties_with = [](const double                    fill,
                              const Aggregates<2>::AskOfCell &holds_mean_in) {
      TiedScene<2> scene(fill);
      scene.tie(cells_of_points(scene.points, scene.mesh), holds_mean_in);
      return scene.aggregates.ties();
    };
    const auto on_the_right = [](const auto &cell) {
      return cell->center()[0] > 3 && cell->center()[1] < 3;
    };
    const auto n = [](const std::vector<Aggregates<2>::Tie> &ties) {
      return Utilities::MPI::sum<unsigned int>(ties.size(), MPI_COMM_WORLD);
    };
    EXPECT_EQ(n(ties_with(0.1, {})), 0u);
    EXPECT_GT(n(ties_with(0.1, on_the_right)), 2u);
    EXPECT_EQ(n(ties_with(0., on_the_right)), 0u);
    EXPECT_EQ(ties_with(0.8, on_the_right), ties_with(0.8, {}));
  }



  template <int dim>
  void
  roots_are_the_nearest_and_continue_linear_functions()
  {
    TiedScene<dim> scene(0.5);
    const auto    &space = scene.space;
    for (const auto &tie : scene.aggregates.ties())
      {
        const Point<dim>               x = space.node_position(tie.node);
        std::map<unsigned int, double> gaps; // of filled cells
        for (const auto &cell :
             scene.mesh.triangulation().active_cell_iterators())
          {
            if (TiedScene<dim>::fill(cell->vertex(0)) < 0.5)
              continue;
            Tensor<1, dim> gap;
            for (unsigned int d = 0; d < dim; ++d)
              gap[d] = std::max(
                {cell->vertex(0)[d] - x[d], x[d] - cell->vertex(0)[d] - 1, 0.});
            gaps[cell->active_cell_index()] = gap.norm();
          }
        double nearest = 1e9;
        for (const auto &[cell, gap] : gaps)
          nearest = std::min(nearest, gap);
        std::vector<unsigned int> roots;
        for (const auto &[cell, gap] : gaps)
          if (gap < nearest + 1e-9)
            roots.push_back(cell);
        EXPECT_EQ(tie.roots, roots) << x;

        double     sum = 0;
        Point<dim> mean;
        for (unsigned int a = 0; a < tie.weights.size(); ++a)
          {
            sum += tie.weights[a];
            mean += tie.weights[a] * space.node_position(tie.nodes[a]);
          }
        EXPECT_NEAR(sum, 1., 1e-13);
        EXPECT_LT(mean.distance(x), 1e-12);
      }
  }

  TEST(Aggregates, RootsAreTheNearestAndContinueLinearFunctions)
  {
    roots_are_the_nearest_and_continue_linear_functions<2>();
    roots_are_the_nearest_and_continue_linear_functions<3>();
  }



  /** A number from -1 to 1 for a place, which looks random. */
  double
  any_number(const double x, const double y, const double z)
  {
    const double much = std::sin(12.9898 * x + 78.233 * y + 37.719 * z) * 43758;
    return 2 * (much - std::floor(much)) - 1;
  }



  /** Move nodes any way, by @p much at most in each direction. */
  template <int dim>
  void
  distort(GridSpace<dim> &space, const double much, const unsigned int number)
  {
    std::vector<Tensor<1, dim>> moves(space.n_nodes());
    for (unsigned int node = 0; node < moves.size(); ++node)
      {
        const Point<dim> x = space.node_position(node) - space.node_move(node);
        for (unsigned int d = 0; d < dim; ++d)
          moves[node][d] =
            much * any_number(x[0] + 3 * d, x[1] + number, x[dim - 1]);
      }
    space.move_nodes(moves);
  }



  /** What sums of weights miss of 1, and of the place they belong to. */
  template <int dim>
  std::pair<double, double>
  misses(const GridSpace<dim>            &space,
         const std::vector<unsigned int> &nodes,
         const std::vector<double>       &weights,
         const Point<dim>                &x)
  {
    double         sum = -1;
    Tensor<1, dim> gap = -x;
    for (unsigned int a = 0; a < nodes.size(); ++a)
      {
        sum += weights[a];
        gap += weights[a] * space.node_position(nodes[a]);
      }
    return {std::abs(sum), gap.norm()};
  }



  template <int dim>
  void
  functions_continue_linear_ones_from_any_cell(const unsigned int degree,
                                               const double       much)
  {
    BackgroundMesh<dim> mesh(unit_cells<dim>(2), MPI_COMM_WORLD);
    GridSpace<dim>      space(mesh, degree);
    const unsigned int  n_cells = mesh.triangulation().n_active_cells();
    space.set_active_cells(std::vector<unsigned char>(n_cells, 1));
    const unsigned int          n = space.nodes_per_cell();
    std::vector<double>         N(n);
    std::vector<Tensor<1, dim>> grad_N(n);
    unsigned int                n_beyond_folds = 0;
    double                      most           = 0;
    for (unsigned int number = 0; number < 1000; ++number)
      {
        distort(space, much, number);
        const unsigned int              cell = number % n_cells;
        const std::vector<unsigned int> nodes(space.cell_nodes(cell),
                                              space.cell_nodes(cell) + n);
        Point<dim>                      x; // up to three cells away
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = 1 + 4 * any_number(number, d, degree);
        continue_shapes(space, cell, x, N.data());
        const auto [sum, gap] = misses(space, nodes, N, x);
        ASSERT_LT(sum, 1e-10) << x;
        ASSERT_LT(gap, 1e-8) << x;
        double total = 0;
        for (const double value : N)
          total += std::abs(value);
        most = std::max(most, total);
        evaluate_shapes(space, cell, x, N.data(), grad_N.data());
        n_beyond_folds += std::isnan(N[0]);
      }
    EXPECT_GT(n_beyond_folds, 10u);
    // Those of a box twenty cells away: some of these cells are narrow.
    EXPECT_LT(most, std::pow(degree == 1 ? 40 : 1600, dim));
  }

  TEST(Aggregates, FunctionsContinueLinearOnesFromAnyCell)
  {
    functions_continue_linear_ones_from_any_cell<2>(1, 0.2);
    functions_continue_linear_ones_from_any_cell<2>(2, 0.07);
    functions_continue_linear_ones_from_any_cell<3>(1, 0.2);
    functions_continue_linear_ones_from_any_cell<3>(2, 0.07);
  }



  template <int dim>
  void
  ties_hold_linear_functions_in_distorted_cells()
  {
    TiedScene<dim> scene(0.5);
    const auto     active = cells_of_points(scene.points, scene.mesh);
    unsigned int   n_ties = 0;
    for (unsigned int number = 0; number < 100; ++number)
      {
        distort(scene.space, 0.25, number);
        scene.tie(active);
        for (const auto &tie : scene.aggregates.ties())
          {
            const auto [sum, gap] = misses(scene.space,
                                           tie.nodes,
                                           tie.weights,
                                           scene.space.node_position(tie.node));
            ASSERT_LT(sum, 1e-10);
            ASSERT_LT(gap, 1e-8);
            ++n_ties;
          }
      }
    EXPECT_GT(Utilities::MPI::sum(n_ties, MPI_COMM_WORLD), 100u);
  }

  TEST(Aggregates, TiesHoldLinearFunctionsInDistortedCells)
  {
    ties_hold_linear_functions_in_distorted_cells<2>();
    ties_hold_linear_functions_in_distorted_cells<3>();
  }



  TEST(Aggregates, NothingIsTiedWhereCellsAreFilledEnough)
  {
    TiedScene<2> scene(0.15); // the least is 0.16
    EXPECT_TRUE(scene.aggregates.ties().empty());
    EXPECT_TRUE(scene.aggregates.nodes_without_root().empty());
    EXPECT_FALSE(scene.changed);
  }



  /** Ties of boxes in cells of size 1, nodes without root. */
  std::pair<unsigned int, unsigned int>
  ties_of(const std::vector<std::pair<Point<2>, Point<2>>> &boxes,
          const std::vector<double>                        &fill = {0.5, 0.5})
  {
    BackgroundMesh<2>    mesh(unit_cells<2>(4), MPI_COMM_WORLD);
    GridSpace<2>         space(mesh, 1);
    PointSet<2>          points(mesh, PointFields());
    std::vector<Body<2>> bodies;
    for (const auto &[lower, upper] : boxes)
      bodies.push_back(
        {std::to_string(bodies.size()), make_box<2>(lower, upper)});
    seed_bodies(bodies, CellSeeder<2>(2, PointLayout::equal), points);
    const auto active = cells_of_points(points, mesh);
    space.set_active_cells(active);
    Aggregates<2> aggregates(fill);
    aggregates.tie_nodes(
      space,
      points,
      [&](const unsigned int p) { return points.volume(p); },
      active);
    unsigned int n_ties = 0;
    for (const auto &tie : aggregates.ties())
      n_ties += space.locally_owned().is_element(space.node_dof(tie.node));
    const unsigned int n_rootless = aggregates.nodes_without_root().size();
    return {Utilities::MPI::sum(n_ties, MPI_COMM_WORLD),
            Utilities::MPI::sum(n_rootless, MPI_COMM_WORLD)};
  }

  TEST(Aggregates, NothingIsTiedAcrossAGap)
  {
    // Over an empty row of cells a strip that fills a third of its row.
    EXPECT_EQ(ties_of({{{0., 0.}, {4., 1.}}, {{0., 2.}, {4., 2.3}}}),
              std::make_pair(0u, 0u));
  }

  TEST(Aggregates, AThinPartHasAThresholdOfItsOwn)
  {
    // A strip fills 0.4 of a row, so that 0.2 * 0.5 * 0.4 are enough.
    EXPECT_EQ(ties_of({{{0., 0.95}, {4., 1.4}}}), std::make_pair(0u, 0u));
    EXPECT_EQ(ties_of({{{0., 0.97}, {4., 1.4}}}), std::make_pair(5u, 0u));
    // What is one and a half cells thick is bulk.
    EXPECT_EQ(ties_of({{{0., 0.85}, {4., 2.}}}), std::make_pair(0u, 0u));
    EXPECT_EQ(ties_of({{{0., 0.85}, {4., 2.5}}}), std::make_pair(5u, 0u));
  }

  TEST(Aggregates, BodiesHaveThresholdsOfTheirOwn)
  {
    // Two bodies one on the other fill rows by 0.15, 0.2 + 0.8, 1 and 0.3.
    const std::vector<std::pair<Point<2>, Point<2>>> boxes{
      {{0., 0.85}, {4., 1.2}}, {{0., 1.2}, {4., 3.3}}};
    EXPECT_EQ(ties_of(boxes), std::make_pair(10u, 0u));
    EXPECT_EQ(ties_of(boxes, {0.1, 0.5}), std::make_pair(5u, 0u));
    EXPECT_EQ(ties_of(boxes, {0.1, 0.}), std::make_pair(0u, 0u));
    // Of the bodies in a cell the least one counts.
    const std::vector<std::pair<Point<2>, Point<2>>> both{
      {{0., 0.85}, {4., 3.1}}, {{0., 3.1}, {4., 3.3}}};
    EXPECT_EQ(ties_of(both, {0.1, 0.5}), std::make_pair(0u, 0u));
  }



  template <int dim>
  void
  momentum_stays_and_linear_velocities_do()
  {
    TiedScene<dim>              scene(0.5);
    const auto                 &space = scene.space;
    std::vector<Tensor<1, dim>> masses(space.n_nodes()), v(space.n_nodes()),
      linear(space.n_nodes());
    const auto momentum = [&](const std::vector<Tensor<1, dim>> &of) {
      Tensor<1, dim> sum;
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        if (space.locally_owned().is_element(space.node_dof(node)))
          sum += masses[node][0] * of[node];
      return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    };
    // One corner is so light that weights behind a root outweigh it.
    for (const double lightest : {1., 1e-6})
      {
        for (unsigned int node = 0; node < space.n_nodes(); ++node)
          {
            const Point<dim> x = space.node_position(node);
            masses[node][0]    = x[0] + x[1] < 2.5 ? lightest : 1 + 0.1 * x[0];
            for (unsigned int d = 0; d < dim; ++d)
              {
                v[node][d]      = std::sin(3 * x[0] + (d + 1) * x[1]);
                linear[node][d] = 2 + x[d] - 3 * x[1];
              }
          }
        const Tensor<1, dim> before = momentum(v);
        const auto           exact  = linear;
        scene.aggregates.hand_over(space, masses, v);
        scene.aggregates.hand_over(space, masses, linear);
        EXPECT_LT((momentum(v) - before).norm(), 1e-12);
        for (unsigned int node = 0; node < space.n_nodes(); ++node)
          EXPECT_LT((linear[node] - exact[node]).norm(), 1e-12);
        for (const auto &tie : scene.aggregates.ties())
          {
            Tensor<1, dim> value = -v[tie.node];
            for (unsigned int a = 0; a < tie.weights.size(); ++a)
              value += tie.weights[a] * v[tie.nodes[a]];
            EXPECT_LT(value.norm(), 1e-12);
          }
      }
  }

  TEST(Aggregates, MomentumStaysAndLinearVelocitiesDo)
  {
    momentum_stays_and_linear_velocities_do<2>();
    momentum_stays_and_linear_velocities_do<3>();
  }



  /** Where a few cells of a mesh are filled, in groups that reach far. */
  template <int dim>
  void
  roots_of_all_ties_are_known(const unsigned int every)
  {
    BackgroundMesh<dim> mesh(unit_cells<dim>(dim == 2 ? 16 : 8),
                             MPI_COMM_WORLD);
    GridSpace<dim>      space(mesh, 1);
    PointSet<dim>       points(mesh, PointFields());
    Point<dim>          upper;
    for (unsigned int d = 0; d < dim; ++d)
      upper[d] = dim == 2 ? 16 : 8;
    seed_bodies<dim>({{"all", make_box<dim>(Point<dim>(), upper)}},
                     CellSeeder<dim>(1, PointLayout::equal),
                     points);
    const auto active = cells_of_points(points, mesh);
    space.set_active_cells(active);
    Aggregates<dim> aggregates({0.5}, true);
    const auto      tie = [&] {
      return aggregates.tie_nodes(
        space,
        points,
        [&](const unsigned int p) {
          const double at = points.position(p)[0] + 7 * points.position(p)[1] +
                            13 * points.position(p)[dim - 1];
          return std::lround(at * at) % every == 0 ? 1. : 0.01;
        },
        active);
    };
    tie();
    unsigned int n_ties = aggregates.ties().size();
    for (const auto &tie : aggregates.ties())
      {
        for (const unsigned int root : tie.roots)
          EXPECT_TRUE(space.knows(root));
        Tensor<1, dim> x;
        for (unsigned int a = 0; a < tie.weights.size(); ++a)
          x += tie.weights[a] * space.node_position(tie.nodes[a]);
        EXPECT_LT((x - space.node_position(tie.node)).norm(), 1e-12);
      }
    EXPECT_GT(Utilities::MPI::sum(n_ties, MPI_COMM_WORLD), 0u);
    // Nor are more cells asked for from step to step.
    const unsigned int n_nodes = space.n_nodes();
    EXPECT_FALSE(space.set_active_cells(active));
    EXPECT_FALSE(tie());
    EXPECT_EQ(space.n_nodes(), n_nodes);
  }

  TEST(Aggregates, RootsOfAllTiesAreKnown)
  {
    for (unsigned int every = 5; every < 30; every += 5)
      {
        roots_of_all_ties_are_known<2>(every);
        roots_of_all_ties_are_known<3>(every);
      }
  }
} // namespace
