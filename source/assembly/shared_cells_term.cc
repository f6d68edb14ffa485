// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/shared_cells_term.h>

#include <moraine/assembly/cell_stress.h>

#include <deal.II/base/mpi.h>

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

    /** By active_cell_index(), how many boundaries hold places in a cell.
     * Collective. */
    template <int dim>
    std::vector<unsigned int>
    count_in_cells(
      const std::vector<std::vector<typename BoundaryTerm<dim>::HoldingPoint>>
                           &held,
      const GridSpace<dim> &space)
    {
      std::vector<unsigned int> n_in_cells(
        space.mesh().triangulation().n_active_cells(), 0);
      for (const auto &places : held)
        {
          unsigned int last = numbers::invalid_unsigned_int;
          for (const auto &place : places)
            {
              if (place.cell != last)
                ++n_in_cells[place.cell];
              last = place.cell;
            }
        }
      Utilities::MPI::max(n_in_cells, space.communicator(), n_in_cells);
      return n_in_cells;
    }



    /**
     * Cells of patches, the same on all ranks. A patch is a shared cell, those
     * that touch it, and of the other cells that are held those of some layers
     * around which no second patch has reached as soon.
     */
    template <int dim>
    class Patches
    {
    public:
      Patches(const std::vector<unsigned int> &n_in_cells,
              const GridSpace<dim>            &space)
        : numbers(n_in_cells.size(), no_patch)
        , at_vertex(space.mesh().triangulation().n_vertices(), no_patch)
      {
        for (const auto &cell :
             space.mesh().triangulation().active_cell_iterators())
          if (n_in_cells[cell->active_cell_index()] > 0)
            cells.push_back(cell);
        for (const auto &cell : cells)
          if (n_in_cells[cell->active_cell_index()] > 1)
            take_shared(cell);
        for (unsigned int layer = 0; layer < n_layers; ++layer)
          grow();
      }

      unsigned int
      n() const
      {
        return n_patches;
      }

      /** By active_cell_index(); no_patch if there is none. */
      unsigned int
      operator[](const unsigned int cell) const
      {
        return numbers[cell];
      }

    private:
      using Cell = typename Triangulation<dim>::active_cell_iterator;

      /** More than one. */
      static constexpr unsigned int several = no_patch - 1;

      void
      take_shared(const Cell &cell)
      {
        unsigned int &number = numbers[cell->active_cell_index()];
        for (const unsigned int v : cell->vertex_indices())
          number = std::min(number, at_vertex[cell->vertex_index(v)]);
        if (number != no_patch)
          return;
        number = n_patches++;
        for (const unsigned int v : cell->vertex_indices())
          at_vertex[cell->vertex_index(v)] = number;
      }

      void
      grow()
      {
        const auto meet = [](unsigned int &at, const unsigned int other) {
          if (other != no_patch && other != at)
            at = at == no_patch ? other : several;
        };
        std::fill(at_vertex.begin(), at_vertex.end(), no_patch);
        for (const Cell &cell : cells)
          for (const unsigned int v : cell->vertex_indices())
            meet(at_vertex[cell->vertex_index(v)],
                 numbers[cell->active_cell_index()]);
        for (const Cell &cell : cells)
          {
            unsigned int &number = numbers[cell->active_cell_index()];
            if (number != no_patch)
              continue;
            for (const unsigned int v : cell->vertex_indices())
              meet(number, at_vertex[cell->vertex_index(v)]);
          }
        for (unsigned int &number : numbers)
          if (number == several)
            number = no_patch;
      }

      std::vector<Cell>         cells; ///< that are held
      std::vector<unsigned int> numbers;
      std::vector<unsigned int> at_vertex;
      unsigned int              n_patches = 0;
    };



    /** @f$M \bar\sigma n@f$ at a place; what holds it where points have left
     * its cell. */
    template <int dim>
    Tensor<1, dim>
    traction_of_stress(const PointSet<dim>                            &points,
                       const typename BoundaryTerm<dim>::HoldingPoint &place)
    {
      const auto sigma = stress_in_cell(points, place.cell);
      return sigma ? place.M * (*sigma * place.normal) :
                     place.force / place.area;
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
    std::vector<const BoundaryTerm<dim> *> boundaries,
    const GridConditionTerm<dim>          *grid_conditions)
    : boundaries(std::move(boundaries))
    , grid_conditions(grid_conditions)
  {}



  template <int dim>
  std::vector<BoundaryReport<dim>>
  SharedCellsTerm<dim>::leave_to_grid_conditions(
    const StepContext<dim> &context,
    std::vector<Held>      &held) const
  {
    std::vector<BoundaryReport<dim>> changes;
    if (!grid_conditions)
      return changes;
    const GridSpace<dim> &space = context.state.grid();
    const auto           &all   = grid_conditions->all();
    for (const auto &condition : all)
      changes.push_back({condition.name, {}, 0., 0., 0., 0.});
    constexpr unsigned int    none = numbers::invalid_unsigned_int;
    std::vector<unsigned int> condition_of(dim * space.n_nodes(), none);
    for (const auto &entry : grid_conditions->nodes().entries)
      condition_of[dim * entry.node + entry.component] = entry.condition;
    const auto is_prescribed = [&](const unsigned int node) {
      const auto first = condition_of.begin() + dim * node;
      return std::any_of(first, first + dim, [](const unsigned int c) {
        return c != none;
      });
    };
    for (unsigned int b = 0; b < held.size(); ++b)
      for (auto &place : held[b])
        {
          const unsigned int *nodes = space.cell_nodes(place.cell);
          const unsigned int  n     = space.nodes_per_cell();
          if (std::none_of(nodes, nodes + n, is_prescribed))
            continue;
          const double        *N = boundaries[b]->functions(place);
          const Tensor<1, dim> missing =
            place.area *
              traction_of_stress(context.state.material_points(), place) -
            place.force;
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              if (const unsigned int c = condition_of[dim * nodes[a] + d];
                  c != none)
                {
                  Tensor<1, dim> part;
                  part[d] = N[a] * missing[d];
                  place.force += part;
                  changes[c].reaction -= part;
                  changes[c].moment -=
                    moment_on_nodes(all[c], context, place.x, part);
                }
        }
    return changes;
  }



  template <int dim>
  void
  SharedCellsTerm<dim>::share_out(const StepContext<dim> &context,
                                  std::vector<Held>      &held) const
  {
    const GridSpace<dim>           &space  = context.state.grid();
    const PointSet<dim>            &points = context.state.material_points();
    const std::vector<unsigned int> n_in_cells =
      count_in_cells<dim>(held, space);
    if (std::none_of(n_in_cells.begin(), n_in_cells.end(), [](const auto n) {
          return n > 1;
        }))
      return;
    const Patches<dim> patches(n_in_cells, space);

    // The entries of S, then those of b.
    constexpr unsigned int n_of_S =
      SymmetricTensor<2, dim>::n_independent_components;
    std::vector<double> sums((n_of_S + dim) * patches.n(), 0.);
    for (const Held &places : held)
      for (const auto &place : places)
        if (patches[place.cell] != no_patch)
          {
            double *of = &sums[(n_of_S + dim) * patches[place.cell]];
            for (unsigned int i = 0; i < n_of_S; ++i)
              of[i] += place.area * place.M.access_raw_entry(i);
            const Tensor<1, dim> b =
              place.force - place.area * traction_of_stress(points, place);
            for (unsigned int d = 0; d < dim; ++d)
              of[n_of_S + d] += b[d];
          }
    Utilities::MPI::sum(sums, space.communicator(), sums);
    std::vector<Tensor<1, dim>> a;
    for (auto of = sums.begin(); of != sums.end(); of += n_of_S + dim)
      {
        SymmetricTensor<2, dim> S;
        Tensor<1, dim>          b;
        for (unsigned int i = 0; i < n_of_S; ++i)
          S.access_raw_entry(i) = of[i];
        for (unsigned int d = 0; d < dim; ++d)
          b[d] = of[n_of_S + d];
        a.push_back(least_solution(S, b));
      }
    for (Held &places : held)
      for (auto &place : places)
        if (patches[place.cell] != no_patch)
          place.force = place.area * (traction_of_stress(points, place) +
                                      place.M * a[patches[place.cell]]);
  }



  template <int dim>
  void
  SharedCellsTerm<dim>::report(const StepContext<dim>           &context,
                               std::vector<BoundaryReport<dim>> &reports) const
  {
    std::vector<Held> held;
    for (const auto *boundary : boundaries)
      held.push_back(boundary->held());
    std::vector<BoundaryReport<dim>> changes =
      leave_to_grid_conditions(context, held);
    share_out(context, held);
    for (unsigned int b = 0; b < boundaries.size(); ++b)
      {
        const BoundaryTerm<dim> &boundary = *boundaries[b];
        BoundaryReport<dim>      of{boundary.name(), {}, 0., 0., 0., 0.};
        const GridSpace<dim>    &space = context.state.grid();
        of.force_magnitude = boundary.force_magnitude(space, held[b]) -
                             boundary.force_magnitude(space, boundary.held());
        for (unsigned int q = 0; q < held[b].size(); ++q)
          {
            const auto          &before = boundary.held()[q];
            const Tensor<1, dim> change = held[b][q].force - before.force;
            of.reaction += change;
            of.moment += boundary.moment(context, before.x, change);
          }
        changes.push_back(of);
      }
    for (BoundaryReport<dim> &change : changes)
      {
        sum_over_ranks(change, context.state.grid().communicator());
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
