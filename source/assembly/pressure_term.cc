// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/pressure_term.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** @f$1 + \beta_1 (\mathrm{tr} H\, 1 - H^T) + \beta_2\, \mathrm{cof} H@f$:
     * the cofactor of 1 + H, or its mean along the way there. */
    struct Cofactor
    {
      double linear, quadratic;
    };

    constexpr Cofactor at_the_end{1., 1.}, along_the_step{0.5, 1. / 3};



    Tensor<1, 2>
    times_cofactor(const Cofactor     &is,
                   const Tensor<2, 2> &H,
                   const Tensor<1, 2> &n)
    {
      return n + is.linear * (trace(H) * n - transpose(H) * n);
    }



    Tensor<1, 3>
    times_cofactor(const Cofactor     &is,
                   const Tensor<2, 3> &H,
                   const Tensor<1, 3> &n)
    {
      const Tensor<2, 3> T = transpose(H);
      const Tensor<1, 3> columns[3]{T[0], T[1], T[2]};
      Tensor<1, 3>       of_H; // cof(H) n
      for (unsigned int j = 0; j < 3; ++j)
        of_H +=
          n[j] * cross_product_3d(columns[(j + 1) % 3], columns[(j + 2) % 3]);
      return n + is.linear * (trace(H) * n - T * n) + is.quadratic * of_H;
    }



    /** Its derivative by the increment of a node with gradient @p g. */
    Tensor<2, 2>
    derivative(const Cofactor &is,
               const Tensor<2, 2> &,
               const Tensor<1, 2> &n,
               const Tensor<1, 2> &g)
    {
      return is.linear * (outer_product(n, g) - outer_product(g, n));
    }



    Tensor<2, 3>
    derivative(const Cofactor     &is,
               const Tensor<2, 3> &H,
               const Tensor<1, 3> &n,
               const Tensor<1, 3> &g)
    {
      const Tensor<1, 3> t = cross_product_3d(n, g);
      const Tensor<1, 3> v = is.linear * t + is.quadratic * (H * t);
      Tensor<2, 3>       D; // D w = w x v
      D[0][1] = v[2];
      D[1][0] = -v[2];
      D[1][2] = v[0];
      D[2][1] = -v[0];
      D[2][0] = v[1];
      D[0][2] = -v[1];
      return D;
    }



    template <int dim>
    std::vector<unsigned int>
    nodes_of_cells(const GridSpace<dim>            &space,
                   const std::vector<unsigned int> &cells)
    {
      std::vector<unsigned int> nodes;
      for (const unsigned int cell : cells)
        nodes.insert(nodes.end(),
                     space.cell_nodes(cell),
                     space.cell_nodes(cell) + space.nodes_per_cell());
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      return nodes;
    }
  } // namespace



  template <int dim>
  bool
  PressureTerm<dim>::begin_step(const StepContext<dim> &context)
  {
    CarriedLoadTerm<dim>::begin_step(context);
    find_groups(context.state.grid(),
                this->functions_of_forces(context),
                this->load.functions());
    return false;
  }



  template <int dim>
  void
  PressureTerm<dim>::find_groups(const GridSpace<dim>      &space,
                                 const PlaceFunctions<dim> &forces,
                                 const PlaceFunctions<dim> &motion)
  {
    const unsigned int        n = space.nodes_per_cell();
    std::vector<unsigned int> cells, cells_of_group, nodes;
    groups.clear();
    // Both have the same places, and cells of motion are among those of forces.
    unsigned int m = 0;
    for (unsigned int begin = 0, end = 0; begin < forces.places.size();
         begin = end)
      {
        const unsigned int k = forces.places[begin];
        cells.clear();
        for (end = begin; end < forces.places.size() && forces.places[end] == k;
             ++end)
          cells.push_back(forces.cells[end]);
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        if (groups.empty() || cells != cells_of_group)
          {
            cells_of_group = cells;
            nodes          = nodes_of_cells(space, cells);
            groups.push_back({nodes, {}, {}, {}});
          }
        Group            &group = groups.back();
        const std::size_t first = group.N.size();
        group.places.push_back(k);
        group.N.resize(first + nodes.size());
        group.grad_N.resize(first + nodes.size());
        const auto at = [&](const unsigned int cell, const unsigned int a) {
          return first + (std::lower_bound(nodes.begin(),
                                           nodes.end(),
                                           space.cell_nodes(cell)[a]) -
                          nodes.begin());
        };
        for (unsigned int i = begin; i < end; ++i)
          for (unsigned int a = 0; a < n; ++a)
            group.N[at(forces.cells[i], a)] += forces.N[n * i + a];
        for (; m < motion.places.size() && motion.places[m] == k; ++m)
          for (unsigned int a = 0; a < n; ++a)
            group.grad_N[at(motion.cells[m], a)] += motion.grad_N[n * m + a];
      }
  }



  template <int dim>
  void
  PressureTerm<dim>::add_place(const StepContext<dim> &context,
                               const Tensor<1, dim>   &n,
                               const double           *N,
                               const Tensor<1, dim>   *grad_N,
                               const bool              tangent,
                               LocalSystem<dim>       &local) const
  {
    const Cofactor &is =
      context.share_of_step() < 1 ? along_the_step : at_the_end;
    const unsigned int n_nodes = local.nodal_increments.size();
    Tensor<2, dim>     H;
    for (unsigned int a = 0; a < n_nodes; ++a)
      H += outer_product(local.nodal_increments[a], grad_N[a]);
    const Tensor<1, dim> f = times_cofactor(is, H, n);
    local.add_force(N, f);
    if (!tangent)
      return;
    for (unsigned int b = 0; b < n_nodes; ++b)
      {
        const Tensor<2, dim> D = derivative(is, H, n, grad_N[b]);
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              local.matrix(dim * a + i, dim * b + j) -= N[a] * D[i][j];
      }
  }



  template <int dim>
  void
  PressureTerm<dim>::add(const StepContext<dim> &context,
                         const bool              tangent,
                         GlobalSystem<dim>      &system) const
  {
    const bool       in_the_middle = context.share_of_step() < 1;
    LocalSystem<dim> local;
    for (const Group &group : groups)
      {
        const unsigned int n = group.nodes.size();
        local.reinit(context.state, group.nodes.data(), n, tangent);
        for (unsigned int k = 0; k < group.places.size(); ++k)
          {
            const auto &place = this->load.places()[group.places[k]];
            double      p     = this->load.pressure_at(place, context.t_end);
            if (in_the_middle)
              p = 0.5 * (p + this->load.pressure_at(place, context.t_start));
            add_place(context,
                      -p * place.weight * place.normal,
                      &group.N[n * k],
                      &group.grad_N[n * k],
                      tangent,
                      local);
          }
        system.add(local, tangent);
      }
  }



  template class PressureTerm<2>;
  template class PressureTerm<3>;
} // namespace moraine
