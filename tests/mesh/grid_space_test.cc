// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/mesh/grid_space.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <set>

using namespace moraine;
using dealii::Point;
using dealii::Tensor;
namespace mpi = dealii::Utilities::MPI;

namespace
{
  /** 4^dim cells of size 0.5 with a corner at (1, 1[, 1]). */
  template <int dim>
  MeshParameters<dim>
  box()
  {
    MeshParameters<dim> parameters;
    for (unsigned int d = 0; d < dim; ++d)
      {
        parameters.lower_corner[d] = 1;
        parameters.upper_corner[d] = 3;
      }
    parameters.cell_size = 0.5;
    return parameters;
  }

  /** Flags of this rank's cells whose centre has x below @p limit. */
  template <int dim>
  std::vector<unsigned char>
  cells_left_of(const BackgroundMesh<dim> &mesh, const double limit)
  {
    std::vector<unsigned char> flags(mesh.triangulation().n_active_cells(), 0);
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[0] < limit)
        flags[cell->active_cell_index()] = 1;
    return flags;
  }

  template <int dim_, int degree_>
  struct Kind
  {
    static constexpr int dim    = dim_;
    static constexpr int degree = degree_;
  };

  template <class K>
  class GridSpaceOf : public testing::Test
  {
  public:
    static constexpr int dim = K::dim;

    GridSpaceOf()
      : mesh(box<dim>(), MPI_COMM_WORLD)
      , space(mesh, K::degree)
    {}

    BackgroundMesh<dim> mesh;
    GridSpace<dim>      space;
  };
  using Kinds = testing::Types<Kind<2, 1>, Kind<2, 2>, Kind<3, 1>, Kind<3, 2>>;
  TYPED_TEST_SUITE(GridSpaceOf, Kinds);



  TYPED_TEST(GridSpaceOf, ActiveCellsAloneOwnUnknowns)
  {
    constexpr int dim = TestFixture::dim;
    auto         &s   = this->space;
    EXPECT_TRUE(s.set_active_cells(cells_left_of(this->mesh, 1.9)));
    // Two of four columns of cells.
    const unsigned int across = 2 * s.degree() + 1, along = 4 * s.degree() + 1;
    EXPECT_EQ(s.n_dofs(),
              dim * across * dealii::Utilities::pow(along, dim - 1));
    EXPECT_EQ(s.n_active_cells(), 2 * dealii::Utilities::pow(4u, dim - 1));
    for (unsigned int node = 0; node < s.n_nodes(); ++node)
      EXPECT_LT(s.node_position(node)[0], 2 + 1e-12);
    EXPECT_EQ(mpi::sum(s.locally_owned().n_elements(), MPI_COMM_WORLD),
              s.n_dofs());

    EXPECT_FALSE(s.set_active_cells(cells_left_of(this->mesh, 1.9)));
    EXPECT_TRUE(s.set_active_cells(cells_left_of(this->mesh, 2.4)));
    EXPECT_EQ(s.n_active_cells(), 3 * dealii::Utilities::pow(4u, dim - 1));
  }



  TYPED_TEST(GridSpaceOf, NodesOfACellStandInLexicographicOrder)
  {
    constexpr int dim = TestFixture::dim;
    auto         &s   = this->space;
    s.set_active_cells(cells_left_of(this->mesh, 9.));
    for (const auto &cell : this->mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        for (unsigned int a = 0; a < s.nodes_per_cell(); ++a)
          {
            Point<dim>   x = cell->vertex(0);
            unsigned int n = a;
            for (unsigned int d = 0; d < dim; ++d, n /= s.degree() + 1)
              x[d] += 0.5 * (n % (s.degree() + 1)) / s.degree();
            EXPECT_LT(x.distance(s.node_position(s.cell_nodes(cell)[a])),
                      1e-14);
          }
  }



  TYPED_TEST(GridSpaceOf, SumsOfNodesAreTheTransposeOfValuesAtNodes)
  {
    constexpr int dim = TestFixture::dim;
    auto         &s   = this->space;
    s.set_active_cells(cells_left_of(this->mesh, 2.4));

    // A vector from the places of nodes, and back.
    LA::Vector u = s.vector();
    for (unsigned int node = 0; node < s.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        if (s.locally_owned().is_element(s.node_dof(node) + c))
          u(s.node_dof(node) + c) = std::sin(s.node_position(node)[c] + c);
    u.compress(dealii::VectorOperation::insert);
    std::vector<Tensor<1, dim>> values;
    s.node_values(u, values);
    ASSERT_EQ(values.size(), s.n_nodes());
    for (unsigned int node = 0; node < s.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        EXPECT_EQ(values[node][c], std::sin(s.node_position(node)[c] + c));

    // u . sum(f) over unknowns is the sum over ranks of u . f over nodes.
    std::vector<Tensor<1, dim>> forces(s.n_nodes());
    double                      expected = 0;
    for (unsigned int node = 0; node < s.n_nodes(); ++node)
      {
        forces[node][0] = 1 + mpi::this_mpi_process(MPI_COMM_WORLD) + node % 3;
        forces[node][dim - 1] -= 0.5 * node;
        expected += values[node] * forces[node];
      }
    LA::Vector sum = s.vector();
    s.sum_node_values(forces, sum);
    EXPECT_NEAR(u * sum,
                mpi::sum(expected, MPI_COMM_WORLD),
                1e-10 * sum.l2_norm() * u.l2_norm());
  }



  TYPED_TEST(GridSpaceOf, EveryUnknownHasOneNodeAndOnePlaceOnAllRanks)
  {
    constexpr int dim = TestFixture::dim;
    auto         &s   = this->space;
    s.set_active_cells(cells_left_of(this->mesh, 2.4));
    std::set<dealii::types::global_dof_index> seen;
    std::vector<double>                       places(s.n_dofs(), -1e300);
    for (unsigned int node = 0; node < s.n_nodes(); ++node)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto dof = s.node_dof(node) + c;
          EXPECT_TRUE(seen.insert(dof).second);
          EXPECT_TRUE(s.locally_relevant().is_element(dof));
          places[dof] = s.node_position(node)[c];
        }
    std::vector<double> largest(places.size());
    mpi::max(places, MPI_COMM_WORLD, largest);
    for (const auto dof : s.locally_relevant())
      if (seen.count(dof) > 0)
        {
          EXPECT_NEAR(places[dof], largest[dof], 1e-14);
        }
    for (const double x : largest)
      EXPECT_GT(x, 0);
  }
} // namespace
