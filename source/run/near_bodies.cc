// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/run/near_bodies.h>

#include <moraine/core/words.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  std::vector<std::vector<Tensor<1, dim>>>
  touched_nodes(const Model<dim> &model)
  {
    const unsigned int                       n = model.space->n_nodes();
    std::vector<std::vector<Tensor<1, dim>>> touched(
      model.bodies.size(), std::vector<Tensor<1, dim>>(n));
    StencilBlock<dim> block;
    for (unsigned int g = 0; g < model.basis->n_batches(); ++g)
      {
        model.basis->evaluate(g, block);
        for (unsigned int p = 0; p < block.n_points; ++p)
          {
            std::vector<Tensor<1, dim>> &of_body =
              touched[model.points->body(block.points[p])];
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              if (block.N(p)[a] > 0)
                of_body[block.nodes[a]][0] = 1;
          }
      }
    for (std::vector<Tensor<1, dim>> &of_body : touched)
      model.space->sum_over_ranks(of_body);
    return touched;
  }



  namespace
  {
    /** Of a cell: a gap that is meant. */
    constexpr double least_gap = 0.05;



    /**
     * For bodies a and b, at [a n + b]: how far points of a at nodes that b
     * touches are from b, at least, less how far they are from the rim of a,
     * both as drawn; infinite if they share no node.
     */
    template <int dim>
    std::vector<double>
    gaps_between(const Model<dim> &model)
    {
      const unsigned int  n       = model.bodies.size();
      const double        h       = model.mesh->cell_size();
      const auto          touched = touched_nodes(model);
      std::vector<double> gaps(n * n, std::numeric_limits<double>::infinity());
      StencilBlock<dim>   block;
      for (unsigned int g = 0; g < model.basis->n_batches(); ++g)
        {
          model.basis->evaluate(g, block);
          for (unsigned int b = 0; b < n; ++b)
            {
              if (std::none_of(block.nodes,
                               block.nodes + block.n_nodes,
                               [&](const unsigned int node) {
                                 return touched[b][node][0] > 0;
                               }))
                continue;
              for (unsigned int k = 0; k < block.n_points; ++k)
                {
                  const unsigned int p = block.points[k];
                  const unsigned int a = model.points->body(p);
                  const Point<dim>  &x = model.points->position(p);
                  const double away = -model.bodies[b].shape->distance(x, h) -
                                      model.bodies[a].shape->distance(x, h);
                  double &gap = gaps[a * n + b];
                  gap         = std::min(gap, away);
                }
            }
        }
      Utilities::MPI::min(gaps, model.space->communicator(), gaps);
      return gaps;
    }



    /** How far points of each body have moved, at most: shapes are as they were
     * drawn. Collective. */
    template <int dim>
    std::vector<double>
    largest_displacements(const Model<dim> &model)
    {
      std::vector<double>  largest(model.bodies.size(), 0.);
      const PointSet<dim> &points = *model.points;
      const auto           u      = points.displacement_field();
      const double         before = points.forgotten_displacement();
      for (unsigned int p = 0; p < points.n_local(); ++p)
        {
          double &of_body = largest[points.body(p)];
          of_body = std::max(of_body, before + u(points.values(p)).norm());
        }
      Utilities::MPI::max(largest, model.space->communicator(), largest);
      return largest;
    }
  } // namespace



  template <int dim>
  void
  tell_of_near_bodies(const Model<dim>               &model,
                      const std::vector<std::string> &known,
                      std::vector<std::string>       &notes)
  {
    const unsigned int n = model.bodies.size();
    if (n < 2 || std::any_of(model.bodies.begin(),
                             model.bodies.end(),
                             [](const auto &body) { return !body.shape; }))
      return;
    const std::vector<double> gaps  = gaps_between(model);
    const std::vector<double> moved = largest_displacements(model);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = a + 1; b < n; ++b)
        {
          const double gap = std::max(gaps[a * n + b], gaps[b * n + a]);
          if (!std::isfinite(gap) ||
              gap < least_gap * model.mesh->cell_size() + moved[a] + moved[b] ||
              (contains(known, model.body_names[a]) &&
               contains(known, model.body_names[b])))
            continue;
          std::ostringstream text;
          text << model.body_names[a] << " and " << model.body_names[b] << ": "
               << std::setprecision(3) << gap
               << " apart, but they touch the same nodes and stick together; "
                  "cells smaller than half of that part them";
          notes.push_back(text.str());
        }
  }



  template std::vector<std::vector<Tensor<1, 2>>>
  touched_nodes(const Model<2> &);
  template std::vector<std::vector<Tensor<1, 3>>>
  touched_nodes(const Model<3> &);
  template void
  tell_of_near_bodies(const Model<2> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
  template void
  tell_of_near_bodies(const Model<3> &,
                      const std::vector<std::string> &,
                      std::vector<std::string> &);
} // namespace moraine
