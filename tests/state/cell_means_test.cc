// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Means over cells that count together.

#include <moraine/state/cell_means.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "../small_scene.h"

namespace
{
  using namespace dealii;
  using namespace moraine;

  /** A cut cell and the filled one beside it, by active_cell_index(). */
  struct PairOfCells
  {
    unsigned int cut;
    unsigned int root;
    bool         is_here; ///< this rank owns the root
  };

  PairOfCells
  make_pair_of_cells(SmallScene<2> &scene)
  {
    PairOfCells                pair{};
    std::vector<unsigned char> active(
      scene.mesh.triangulation().n_active_cells(), 0);
    scene.basis->mark_cells(active);
    for (const auto &cell : scene.mesh.triangulation().active_cell_iterators())
      if (cell->center().distance(Point<2>(0.5, 1.5)) < 1e-9)
        pair.cut = cell->active_cell_index();
      else if (cell->center().distance(Point<2>(1.5, 1.5)) < 1e-9)
        {
          pair.root    = cell->active_cell_index();
          pair.is_here = cell->is_locally_owned();
        }
    active[pair.cut] = active[pair.root] = 1;
    scene.space.set_active_cells(active);
    scene.basis->batch_points();
    return pair;
  }



  // What a step adds to the volume of a cell couples no further nodes.
  TEST(CellMeansOfGroups, HaveTheNodesOfAllCellsWhateverFillsThem)
  {
    SmallScene<2>                            scene;
    const PairOfCells                        pair = make_pair_of_cells(scene);
    const RootsOfCells                       roots{{pair.cut, {pair.root}}};
    std::vector<typename CellMeans<2>::Part> parts;
    for (const double filled : {1., 0.})
      {
        CellMeans<2> means(false);
        means.update(
          scene.space,
          *scene.basis,
          [&](const StencilBlock<2> &block, const unsigned int i) {
            const unsigned int p = block.points[i];
            return scene.points.volume(p) *
                   (scene.points.cell_of(p)->active_cell_index() == pair.cut ?
                      filled :
                      1.);
          },
          roots);
        if (!pair.is_here)
          continue;
        means.of_cell(pair.root, parts);
        ASSERT_EQ(parts.size(), 2u);
        EXPECT_NEAR(parts[0].weight + parts[1].weight, 1., 1e-14);
        for (const auto &part : parts)
          if (part.cell == pair.cut)
            {
              EXPECT_NEAR(part.weight,
                          0.7 * filled / (1 + 0.7 * filled),
                          1e-14);
            }
        unsigned int n_batches = 0;
        for (unsigned int g = 0; g < scene.basis->n_batches(); ++g)
          {
            const auto own = scene.basis->batch_nodes(g);
            if (!std::is_permutation(own.begin(),
                                     own.end(),
                                     scene.space.cell_nodes(pair.root)))
              continue;
            ++n_batches;
            EXPECT_EQ(means.nodes_of_batch(g, own).size(), 6u);
          }
        EXPECT_EQ(n_batches, 1u);
      }
  }
} // namespace
