// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/shared_cells_term.h>


#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools_cache.h>

#include <algorithm>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Eigenvalues below this part of the largest are directions that nothing
     * holds. */
    constexpr double negligible = 1e-10;

    /** Layers of cells around those that are shared: multipliers alternate from
     * cell to cell there, less the further. */
    constexpr unsigned int n_layers = 2;

    constexpr unsigned int no_patch = numbers::invalid_unsigned_int;

    /** By active_cell_index(), whether several boundaries hold places in a
     * cell, on any rank. Collective. */
    template <int dim>
    std::vector<unsigned int>
    shared_cells(const std::vector<const BoundaryTerm<dim> *> &boundaries,
                 const GridSpace<dim>                         &space)
    {
      std::vector<unsigned int> n_in_cells(
        space.mesh().triangulation().n_active_cells(), 0);
      for (const auto *boundary : boundaries)
        {
          unsigned int last = numbers::invalid_unsigned_int;
          for (const auto &place : boundary->held())
            {
              if (place.cell != last)
                ++n_in_cells[place.cell];
              last = place.cell;
            }
        }
      Utilities::MPI::max(n_in_cells, space.communicator(), n_in_cells);
      for (unsigned int &n : n_in_cells)
        n = n > 1;
      return n_in_cells;
    }



    /** Number of the patch of each cell: those that are shared and the cells
     * around them, as far as they hang together by vertices. */
    template <int dim>
    std::vector<unsigned int>
    number_patches(std::vector<unsigned int> in_patch,
                   const GridSpace<dim>     &space,
                   unsigned int             &n_patches)
    {
      const auto &tria = space.mesh().triangulation();
      for (unsigned int layer = 0; layer < n_layers; ++layer)
        {
          std::vector<bool> touched(tria.n_vertices(), false);
          for (const auto &cell : tria.active_cell_iterators())
            if (in_patch[cell->active_cell_index()])
              for (const unsigned int v : cell->vertex_indices())
                touched[cell->vertex_index(v)] = true;
          for (const auto &cell : tria.active_cell_iterators())
            for (const unsigned int v : cell->vertex_indices())
              if (touched[cell->vertex_index(v)])
                in_patch[cell->active_cell_index()] = 1;
        }

      const auto &cells_at_vertex =
        space.mesh().search_cache().get_vertex_to_cell_map();
      std::vector<unsigned int> patches(in_patch.size(), no_patch);
      n_patches = 0;
      for (const auto &first : tria.active_cell_iterators())
        {
          if (!in_patch[first->active_cell_index()] ||
              patches[first->active_cell_index()] != no_patch)
            continue;
          patches[first->active_cell_index()]             = n_patches;
          std::vector<std::decay_t<decltype(first)>> todo = {first};
          while (!todo.empty())
            {
              const auto cell = todo.back();
              todo.pop_back();
              for (const unsigned int v : cell->vertex_indices())
                for (const auto &near : cells_at_vertex[cell->vertex_index(v)])
                  {
                    const unsigned int c = near->active_cell_index();
                    if (in_patch[c] && patches[c] == no_patch)
                      {
                        patches[c] = n_patches;
                        todo.push_back(near);
                      }
                  }
            }
          ++n_patches;
        }
      return patches;
    }



    /** @f$\bar\sigma@f$, zero if there is no point. */
    template <int dim>
    SymmetricTensor<2, dim>
    mean_stress(const PointSet<dim> &points, const unsigned int cell)
    {
      const auto [first, last] = points.points_in(cell);
      SymmetricTensor<2, dim> sum;
      double                  volume = 0;
      for (unsigned int p = first; p < last; ++p)
        {
          const SymmetricTensor<2, 3> sigma =
            points.stress_field()(points.values(p));
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = d; e < dim; ++e)
              sum[d][e] += points.volume(p) * sigma[d][e];
          volume += points.volume(p);
        }
      return volume > 0 ? sum / volume : sum;
    }



    /** Of @p S a = @p b that nearest to zero. */
    template <int dim>
    Tensor<1, dim>
    least_solution(const SymmetricTensor<2, dim> &S, const Tensor<1, dim> &b)
    {
      const auto     pairs = eigenvectors(S);
      Tensor<1, dim> a;
      for (const auto &[value, direction] : pairs)
        if (value > negligible * pairs[0].first)
          a += (b * direction) / value * direction;
      return a;
    }
  } // namespace



  template <int dim>
  SharedCellsTerm<dim>::SharedCellsTerm(
    std::vector<const BoundaryTerm<dim> *> boundaries)
    : boundaries(std::move(boundaries))
  {}



  template <int dim>
  void
  SharedCellsTerm<dim>::report(const StepContext<dim>           &context,
                               std::vector<BoundaryReport<dim>> &reports) const
  {
    const GridSpace<dim>           &space  = context.state.grid();
    const PointSet<dim>            &points = context.state.material_points();
    const std::vector<unsigned int> shared = shared_cells(boundaries, space);
    if (std::find(shared.begin(), shared.end(), 1) == shared.end())
      return;
    unsigned int                    n_patches;
    const std::vector<unsigned int> patches =
      number_patches(shared, space, n_patches);

    struct Sums
    {
      SymmetricTensor<2, dim> S;
      Tensor<1, dim>          b;
    };
    std::vector<Sums> sums(n_patches);
    const auto        traction = [&](const auto &place) {
      return place.M * (mean_stress(points, place.cell) * place.normal);
    };
    for (const auto *boundary : boundaries)
      for (const auto &place : boundary->held())
        if (patches[place.cell] != no_patch)
          {
            Sums &of = sums[patches[place.cell]];
            of.S += place.area * place.M;
            of.b += place.force - place.area * traction(place);
          }
    std::vector<Tensor<1, dim>> a;
    for (const Sums &of : sums)
      a.push_back(
        least_solution(Utilities::MPI::sum(of.S, space.communicator()),
                       Utilities::MPI::sum(of.b, space.communicator())));

    std::vector<BoundaryReport<dim>> changes;
    for (const auto *boundary : boundaries)
      {
        BoundaryReport<dim> of{boundary->name(), {}, 0., 0., 0., 0.};
        for (const auto &place : boundary->held())
          if (patches[place.cell] != no_patch)
            {
              const Tensor<1, dim> force =
                place.area *
                (traction(place) + place.M * a[patches[place.cell]]);
              const Tensor<1, dim> change = force - place.force;
              of.reaction += change;
              of.force_magnitude += force.norm() - place.force.norm();
              of.moment += boundary->moment(place.x, change, context.t_end);
            }
        changes.push_back(of);
      }
    for (BoundaryReport<dim> &change : changes)
      {
        sum_over_ranks(change, space.communicator());
        const auto of =
          std::find_if(reports.begin(), reports.end(), [&](const auto &report) {
            return report.name == change.name;
          });
        of->reaction += change.reaction;
        of->force_magnitude += change.force_magnitude;
        of->moment += change.moment;
      }
  }



  template class SharedCellsTerm<2>;
  template class SharedCellsTerm<3>;
} // namespace moraine
