// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/state/cell_means.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** What points keep of their own strain where cells have a mean of all of
     * it: enough that the hourglass modes of cells are stiff. */
    constexpr double own_share_of_strain = 0.2;
  } // namespace



  template <int dim>
  unsigned int
  CellMeans<dim>::number_of(const unsigned int cell)
  {
    if (numbers_of[cell] == numbers::invalid_unsigned_int)
      {
        numbers_of[cell] = cells.size();
        cells.push_back(cell);
        volumes.push_back(0.);
        gradients.resize(gradients.size() + n_corners);
      }
    return numbers_of[cell];
  }



  template <int dim>
  void
  CellMeans<dim>::update(const GridSpace<dim> &space,
                         const Basis<dim>     &basis,
                         const Volume         &volume,
                         const RootsOfCells   &roots)
  {
    cells.clear();
    volumes.clear();
    gradients.clear();
    numbers_of.assign(space.mesh().triangulation().n_active_cells(),
                      numbers::invalid_unsigned_int);
    batches = {};
    StencilBlock<dim> block;
    CellParts<dim>    parts;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        basis.evaluate(g, block);
        basis.evaluate_parts(g, block, parts);
        append_batch(block.n_points, parts);
        const unsigned int m = parts.cells.size();
        for (unsigned int c = 0; c < m; ++c)
          {
            const unsigned int k = number_of(parts.cells[c]);
            for (unsigned int p = 0; p < block.n_points; ++p)
              {
                const double v = volume(block, p);
                volumes[k] += v * parts.shares[p * m + c];
                for (unsigned int a = 0; a < n_corners; ++a)
                  gradients[k * n_corners + a] +=
                    v * parts.gradients[(p * m + c) * n_corners + a];
              }
          }
      }
    find_groups(space, roots);
    averages_gradients =
      for_shear &&
      !Utilities::MPI::logical_or(!groups.empty(), space.communicator());
    sum_over_ranks(space);
    for (unsigned int k = 0; k < cells.size(); ++k)
      for (unsigned int a = 0; a < n_corners; ++a)
        if (volumes[k] > 0)
          gradients[k * n_corners + a] /= volumes[k];
    take_groups(space, basis);
  }



  template <int dim>
  void
  CellMeans<dim>::find_groups(const GridSpace<dim> &space,
                              const RootsOfCells   &roots)
  {
    groups.clear();
    members.clear();
    groups_of.clear();
    std::map<unsigned int, std::vector<Member>> groups_by_root;
    for (const auto &[cell, roots_of_cell] : roots)
      for (const unsigned int root : roots_of_cell)
        groups_by_root.try_emplace(root, 1, Member{root, 1.})
          .first->second.push_back({cell, 1. / roots_of_cell.size()});
    if (groups_by_root.empty())
      return;

    std::set<unsigned int> here; // roots
    const auto             add_roots_of = [&](const unsigned int cell) {
      if (const auto found = roots.find(cell); found != roots.end())
        here.insert(found->second.begin(), found->second.end());
      else
        here.insert(cell);
    };
    for (const unsigned int cell : cells)
      add_roots_of(cell);
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && space.is_active(cell))
        add_roots_of(cell->active_cell_index());
    for (const auto &[root, of_group] : groups_by_root)
      if (here.count(root) > 0)
        {
          const unsigned int first = members.size();
          for (const Member &member : of_group)
            {
              groups_of[member.cell].push_back(groups.size());
              number_of(member.cell);
              members.push_back(member);
            }
          groups.push_back(
            {first, static_cast<unsigned int>(members.size()), 0.});
        }
  }



  template <int dim>
  void
  CellMeans<dim>::sum_over_ranks(const GridSpace<dim> &space)
  {
    constexpr unsigned int n            = 1 + dim * n_corners;
    const auto             communicator = space.communicator();
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;

    using Cells  = std::vector<unsigned int>;
    using Values = std::vector<double>;
    std::map<unsigned int, std::pair<Cells, Values>> messages;
    const auto append = [&](std::pair<Cells, Values> &message,
                            const unsigned int        cell) {
      const unsigned int k = numbers_of[cell];
      message.first.push_back(cell);
      message.second.push_back(volumes[k]);
      for (unsigned int a = 0; a < n_corners; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          message.second.push_back(gradients[k * n_corners + a][d]);
    };

    // Owners add; then all who have a part get the sum.
    for (const auto &cell :
         space.mesh().triangulation().active_cell_iterators())
      if (!cell->is_locally_owned() && numbers_of[cell->active_cell_index()] !=
                                         numbers::invalid_unsigned_int)
        append(messages[cell->subdomain_id()], cell->active_cell_index());
    const auto received = Utilities::MPI::some_to_some(communicator, messages);
    const auto take     = [&](const auto &of_ranks, const double share_of_own) {
      for (const auto &[rank, message] : of_ranks)
        for (unsigned int i = 0; i < message.first.size(); ++i)
          {
            const unsigned int k      = number_of(message.first[i]);
            const double      *values = &message.second[n * i];
            volumes[k]                = share_of_own * volumes[k] + *values++;
            for (unsigned int a = 0; a < n_corners; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  double &entry = gradients[k * n_corners + a][d];
                  entry         = share_of_own * entry + *values++;
                }
          }
    };
    take(received, 1.);
    messages.clear();
    for (const auto &[rank, message] : received)
      for (const unsigned int cell : message.first)
        append(messages[rank], cell);
    take(Utilities::MPI::some_to_some(communicator, messages), 0.);
  }



  template <int dim>
  void
  CellMeans<dim>::append_batch(const unsigned int    n_points,
                               const CellParts<dim> &parts)
  {
    const unsigned int m = parts.cells.size();
    batches.list.push_back({n_points,
                            static_cast<unsigned int>(batches.cells.size()),
                            m,
                            batches.shares.size(),
                            0,
                            0});
    batches.cells.insert(batches.cells.end(),
                         parts.cells.begin(),
                         parts.cells.end());
    batches.corners.insert(batches.corners.end(),
                           parts.places.begin(),
                           parts.places.end());
    if (m > 1)
      batches.shares.insert(batches.shares.end(),
                            parts.shares.begin(),
                            parts.shares.end());
  }



  template <int dim>
  void
  CellMeans<dim>::Batches::parts_of(const Batch &g, CellParts<dim> &parts) const
  {
    const auto copy = [](const auto       &from,
                         const std::size_t first,
                         const std::size_t n,
                         auto             &to) {
      to.assign(from.begin() + first, from.begin() + first + n);
    };
    copy(cells, g.first_cell, g.n_cells, parts.cells);
    copy(corners,
         g.first_cell * n_corners,
         g.n_cells * n_corners,
         parts.places);
    copy(shares,
         g.first_share,
         g.n_cells > 1 ? g.n_points * g.n_cells : 0,
         parts.shares);
  }



  template <int dim>
  void
  CellMeans<dim>::take_groups(const GridSpace<dim> &space,
                              const Basis<dim>     &basis)
  {
    if (groups.empty())
      return;
    for (Group &group : groups)
      for (unsigned int i = group.first; i < group.end; ++i)
        group.volume += members[i].share * volumes[numbers_of[members[i].cell]];
    const Batches             before = std::move(batches);
    CellParts<dim>            parts;
    std::vector<unsigned int> nodes;
    batches = {};
    for (unsigned int g = 0; g < before.list.size(); ++g)
      {
        const Batch &batch = before.list[g];
        before.parts_of(batch, parts);
        if (std::none_of(parts.cells.begin(),
                         parts.cells.end(),
                         [this](const auto cell) { return is_grouped(cell); }))
          {
            append_batch(batch.n_points, parts);
            continue;
          }
        const auto own = basis.batch_nodes(g);
        nodes.assign(own.begin(), own.end());
        group_parts(space, batch.n_points, nodes, parts);
        append_batch(batch.n_points, parts);
        if (nodes.size() > own.size())
          {
            batches.list.back().first_node = batches.nodes.size();
            batches.list.back().n_nodes    = nodes.size();
            batches.nodes.insert(batches.nodes.end(),
                                 nodes.begin(),
                                 nodes.end());
          }
      }
  }



  template <int dim>
  void
  CellMeans<dim>::group_parts(const GridSpace<dim>      &space,
                              const unsigned int         n_points,
                              std::vector<unsigned int> &nodes,
                              CellParts<dim>            &parts) const
  {
    CellParts<dim> own;
    std::swap(own, parts);
    std::vector<Part>  in_place;
    const unsigned int n_own = own.cells.size();
    for (unsigned int c = 0; c < n_own; ++c)
      {
        of_cell(own.cells[c], in_place);
        for (const Part &part : in_place)
          if (std::find(parts.cells.begin(), parts.cells.end(), part.cell) ==
              parts.cells.end())
            parts.cells.push_back(part.cell);
      }
    const unsigned int n = parts.cells.size();
    parts.shares.assign(n_points * n, 0.);
    for (unsigned int c = 0; c < n_own; ++c)
      {
        of_cell(own.cells[c], in_place);
        for (const Part &part : in_place)
          {
            const unsigned int k =
              std::find(parts.cells.begin(), parts.cells.end(), part.cell) -
              parts.cells.begin();
            for (unsigned int p = 0; p < n_points; ++p)
              parts.shares[p * n + k] +=
                part.weight * (n_own > 1 ? own.shares[p * n_own + c] : 1.);
          }
      }
    for (const unsigned int cell : parts.cells)
      for (unsigned int a = 0; a < n_corners; ++a)
        {
          const unsigned int node = space.cell_nodes(cell)[a];
          const auto found        = std::find(nodes.begin(), nodes.end(), node);
          parts.places.push_back(found - nodes.begin());
          if (found == nodes.end())
            nodes.push_back(node);
        }
  }



  template <int dim>
  void
  CellMeans<dim>::attach(const unsigned int batch,
                         StencilBlock<dim> &block) const
  {
    const Batch        &g     = batches.list[batch];
    CellMeanBlock<dim> &means = block.means;
    if (g.n_nodes > 0)
      block.append_nodes(g.n_nodes, &batches.nodes[g.first_node]);
    means.n_cells = g.n_cells;
    means.places  = &batches.corners[g.first_cell * n_corners];
    means.shares  = g.n_cells > 1 ? &batches.shares[g.first_share] : nullptr;
    means.gradients.resize(g.n_cells * n_corners);
    for (unsigned int c = 0; c < g.n_cells; ++c)
      std::copy_n(
        &gradients[numbers_of[batches.cells[g.first_cell + c]] * n_corners],
        n_corners,
        &means.gradients[c * n_corners]);
    if (averages_gradients)
      block.average_gradients(own_share_of_strain);
  }



  template <int dim>
  ArrayView<const unsigned int>
  CellMeans<dim>::nodes_of_batch(const unsigned int                  batch,
                                 const ArrayView<const unsigned int> own) const
  {
    const Batch &g = batches.list[batch];
    return g.n_nodes > 0 ?
             ArrayView<const unsigned int>(&batches.nodes[g.first_node],
                                           g.n_nodes) :
             own;
  }



  template <int dim>
  void
  CellMeans<dim>::of_cell(const unsigned int cell,
                          std::vector<Part> &parts) const
  {
    parts.clear();
    const auto add = [&](const Member      &member,
                         const unsigned int group,
                         const double       by_volume) {
      const unsigned int k = numbers_of[member.cell];
      parts.push_back({member.cell,
                       group,
                       member.share,
                       member.share * volumes[k] * by_volume,
                       &gradients[k * n_corners]});
    };
    if (const auto own = groups_of.find(cell); own != groups_of.end())
      {
        const unsigned int n = own->second.size();
        for (unsigned int g = 0; g < n; ++g)
          {
            const Group &group = groups[own->second[g]];
            // Members without volume, too: they may get some in a step that
            // couples no other nodes.
            if (group.volume > 0)
              for (unsigned int i = group.first; i < group.end; ++i)
                add(members[i], g, 1. / (n * group.volume));
          }
      }
    else if (const unsigned int k = numbers_of[cell];
             k != numbers::invalid_unsigned_int && volumes[k] > 0)
      add({cell, 1.}, 0, 1. / volumes[k]);
  }



  template class CellMeans<2>;
  template class CellMeans<3>;
} // namespace moraine
