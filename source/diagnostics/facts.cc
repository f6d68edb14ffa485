// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/diagnostics/facts.h>

#include <moraine/core/ranges.h>
#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  bool
  Facts<dim>::holds(const std::string &name) const
  {
    return contains(now.stage->boundaries, name) &&
           !contains(now.stage->absorbing, name);
  }



  template <int dim>
  bool
  Facts<dim>::begins_to_hold(const std::string &name) const
  {
    return holds(name) &&
           !(now.before && contains(now.before->boundaries, name));
  }



  template <int dim>
  bool
  Facts<dim>::is_new(const std::string &body) const
  {
    return contains(now.stage->bodies, body) &&
           !(now.before && contains(now.before->bodies, body));
  }



  template <int dim>
  bool
  Facts<dim>::are_drawn() const
  {
    return all_of(of.bodies,
                  [](const auto &body) { return body.shape != nullptr; });
  }



  template <int dim>
  bool
  Facts<dim>::in_a_body(const Point<dim> &x) const
  {
    for (unsigned int b = 0; b < of.bodies.size(); ++b)
      if (of.present[b] && of.bodies[b].shape->contains(x))
        return true;
    return false;
  }



  template <int dim>
  double
  Facts<dim>::largest_modulus() const
  {
    double largest = 0;
    for (const auto &material : of.materials)
      {
        const LameConstants C = material->elastic_stiffness();
        largest               = std::max(largest, C.lambda + 2 * C.mu);
      }
    return largest;
  }



  template <int dim>
  const std::vector<std::vector<double>> &
  Facts<dim>::filled_parts()
  {
    if (!fills.empty())
      return fills;
    const auto         &tria = of.mesh.triangulation();
    const unsigned int  n    = tria.n_active_cells();
    std::vector<double> volumes(n * of.bodies.size(), 0.);
    for (const auto &in_cell : of.points.cells())
      for (unsigned int p = in_cell.first; p < in_cell.last; ++p)
        volumes[of.points.body(p) * n + in_cell.cell->active_cell_index()] +=
          of.points.volume(p);
    Utilities::MPI::sum(volumes, communicator(), volumes);
    for (unsigned int b = 0; b < of.bodies.size(); ++b)
      {
        fills.emplace_back(volumes.begin() + b * n,
                           volumes.begin() + (b + 1) * n);
        for (const auto &cell : tria.active_cell_iterators())
          fills[b][cell->active_cell_index()] /= volume_of_cell(cell);
      }
    return fills;
  }



  template <int dim>
  const std::vector<std::vector<bool>> &
  Facts<dim>::touched_nodes()
  {
    if (!nodes.empty())
      return nodes;
    const unsigned int                       n = of.space.n_nodes();
    std::vector<std::vector<Tensor<1, dim>>> touched(
      of.bodies.size(), std::vector<Tensor<1, dim>>(n));
    StencilBlock<dim> block;
    for (unsigned int g = 0; g < of.basis.n_batches(); ++g)
      {
        of.basis.evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            auto &of_body = touched[of.points.body(block.points[p])];
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              if (block.N(p)[a] > 0)
                of_body[block.nodes[a]][0] = 1;
          }
      }
    for (auto &of_body : touched)
      {
        of.space.sum_over_ranks(of_body);
        nodes.emplace_back();
        for (const Tensor<1, dim> &node : of_body)
          nodes.back().push_back(node[0] > 0);
      }
    return nodes;
  }



  template <int dim>
  std::vector<GridCondition<dim>>
  acting_conditions(const std::vector<GridCondition<dim>> &conditions,
                    const StageParameters                 &stage)
  {
    std::vector<GridCondition<dim>> acting;
    for (const auto &condition : conditions)
      if (contains(stage.grid_conditions, condition.name) &&
          !contains(stage.absorbing, condition.name))
        acting.push_back(condition);
    return acting;
  }



  template <int dim>
  bool
  absorbs_in(const StageParameters        &stage,
             const Scene<dim>             &scene,
             const AbsorbingBoundary<dim> &boundary)
  {
    const std::string &name = boundary.name();
    return contains(boundary.is_on_side() ? stage.grid_conditions :
                                            stage.boundaries,
                    name) &&
           (contains(stage.absorbing, name) || !scene.absorbs_later(name));
  }



#define INSTANTIATE(dim)                                            \
  template class Facts<dim>;                                        \
  template decltype(acting_conditions<dim>) acting_conditions<dim>; \
  template decltype(absorbs_in<dim>)        absorbs_in<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
