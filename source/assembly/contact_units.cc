// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// The nodes, functions and stiffness of the units of a contact.

#include <moraine/assembly/contact_term.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <utility>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Nodes of this rank by their first unknown, of those in units. */
    template <int dim>
    std::map<types::global_dof_index, unsigned int>
    nodes_of_units(const GridSpace<dim>                              &space,
                   const std::vector<std::vector<ContactEntry<dim>>> &of_ranks)
    {
      std::vector<types::global_dof_index> dofs;
      for (const auto &of_rank : of_ranks)
        for (const ContactEntry<dim> &entry : of_rank)
          dofs.push_back(entry.dof);
      std::sort(dofs.begin(), dofs.end());
      std::map<types::global_dof_index, unsigned int> nodes;
      for (unsigned int node = 0; node < space.n_nodes(); ++node)
        if (std::binary_search(dofs.begin(), dofs.end(), space.node_dof(node)))
          nodes.emplace(space.node_dof(node), node);
      return nodes;
    }



    /** Entries by unit and unknown. */
    template <int dim>
    class EntrySums
    {
    public:
      explicit EntrySums(const GridSpace<dim> &space)
        : space(space)
      {}

      ContactEntry<dim> &
      at(const unsigned int unit, const unsigned int node)
      {
        const auto         dof = space.node_dof(node);
        ContactEntry<dim> &sum = sums[{unit, dof}];
        sum.unit               = unit;
        sum.dof                = dof;
        return sum;
      }

      std::vector<ContactEntry<dim>>
      list() const
      {
        std::vector<ContactEntry<dim>> entries;
        for (const auto &[where, sum] : sums)
          entries.push_back(sum);
        return entries;
      }

    private:
      const GridSpace<dim> &space;
      std::map<std::pair<unsigned int, types::global_dof_index>,
               ContactEntry<dim>>
        sums;
    };
  } // namespace



  template <int dim>
  bool
  ContactTerm<dim>::owns(const ContactUnit<dim> &unit) const
  {
    const auto &places = boundary.places_of_rim().places();
    return std::any_of(unit.places.begin(),
                       unit.places.end(),
                       [&](const unsigned int k) {
                         return places[k].active_cell_index == unit.cell;
                       });
  }



  template <int dim>
  bool
  ContactTerm<dim>::is_in_its_cell(const GridSpace<dim> &space,
                                   const LocalUnit      &local) const
  {
    const ContactUnit<dim> &unit = boundary.units()[local.number];
    if (!owns(unit))
      return false;
    const unsigned int *nodes = space.cell_nodes(unit.cell);
    return std::all_of(
      local.nodes.begin(), local.nodes.end(), [&](const unsigned int node) {
        return std::find(nodes, nodes + space.nodes_per_cell(), node) !=
               nodes + space.nodes_per_cell();
      });
  }



  template <int dim>
  CellFluxes<dim>
  ContactTerm<dim>::find_fluxes(const StepContext<dim> &context) const
  {
    if (!boundary.enforcement().has_flux())
      return {};
    const auto               &places = boundary.places_of_rim().places();
    std::vector<unsigned int> cells;
    for (const ContactUnit<dim> &unit : boundary.units())
      for (const unsigned int k : unit.places)
        if (places[k].active_cell_index != GridSpace<dim>::no_cell)
          cells.push_back(places[k].active_cell_index);
    return fluxes_in_cells(context, cells);
  }



  template <int dim>
  void
  ContactTerm<dim>::start_from(const CellFluxes<dim>  &fluxes,
                               const StepContext<dim> &context)
  {
    const auto         &places = boundary.places_of_rim().places();
    const auto         &units  = boundary.units();
    std::vector<double> sums(dim * units.size(), 0.);
    for (unsigned int u = 0; u < units.size(); ++u)
      for (const unsigned int k : units[u].places)
        if (places[k].active_cell_index != GridSpace<dim>::no_cell)
          {
            const CellFlux<dim> &flux = fluxes.at(places[k].active_cell_index);
            const ContactPlace<dim> &carried = boundary.at_place(k);
            const Tensor<1, dim>     traction =
              flux.volume > 0 ? flux.stress * units[u].normal / flux.volume :
                                    carried.traction - carried.excess;
            for (unsigned int d = 0; d < dim; ++d)
              sums[dim * u + d] +=
                places[k].weight / units[u].area * traction[d];
          }
    Utilities::MPI::sum(sums, context.state.grid().communicator(), sums);
    std::vector<Tensor<1, dim>> tractions(units.size());
    for (unsigned int u = 0; u < units.size(); ++u)
      std::copy_n(&sums[dim * u], dim, tractions[u].begin_raw());
    boundary.set_fluxes(tractions);
  }



  template <int dim>
  std::vector<ContactEntry<dim>>
  ContactTerm<dim>::entries_of_this_rank(const StepContext<dim> &context,
                                         const CellFluxes<dim>  &fluxes) const
  {
    const GridSpace<dim> &space  = context.state.grid();
    const Basis<dim>     &basis  = context.state.point_basis();
    const auto           &places = boundary.places_of_rim().places();
    const auto           &units  = boundary.units();
    // A rim has many more places than are near the surface.
    std::vector<typename CarriedPlaces<dim>::Place> near;
    std::vector<unsigned int>                       unit_of;
    for (unsigned int u = 0; u < units.size(); ++u)
      for (const unsigned int k : units[u].places)
        {
          near.push_back(places[k]);
          unit_of.push_back(u);
        }
    const PlaceFunctions<dim> functions =
      context.state.mesh_after_step() == MeshAfterStep::reset ?
        basis.functions_at(near) :
        basis.functions_of_cells(near);
    const unsigned int n = space.nodes_per_cell();
    EntrySums<dim>     sums(space);
    for (unsigned int i = 0; i < functions.places.size(); ++i)
      {
        const unsigned int  k     = functions.places[i];
        const unsigned int *nodes = space.cell_nodes(functions.cells[i]);
        const auto          flux  = fluxes.find(near[k].active_cell_index);
        const bool          without_points =
          flux != fluxes.end() && flux->second.volume == 0.;
        for (unsigned int a = 0; a < n; ++a)
          if (functions.N[n * i + a] != 0. || without_points)
            {
              ContactEntry<dim> &sum = sums.at(unit_of[k], nodes[a]);
              sum.N += near[k].weight * functions.N[n * i + a];
              if (without_points)
                sum.gradients.add(near[k].weight * functions.grad_N[n * i + a]);
            }
      }
    for (unsigned int k = 0; k < near.size(); ++k)
      if (const auto flux = fluxes.find(near[k].active_cell_index);
          flux != fluxes.end())
        for (const auto &[node, gradients] : flux->second.gradients)
          sums.at(unit_of[k], node)
            .gradients.add(gradients, near[k].weight / flux->second.volume);
    return sums.list();
  }



  template <int dim>
  void
  ContactTerm<dim>::find_local_units(const StepContext<dim> &context,
                                     const CellFluxes<dim>  &fluxes)
  {
    const GridSpace<dim> &space        = context.state.grid();
    const MPI_Comm        communicator = space.communicator();
    const auto           &units        = boundary.units();
    // The rank of its first cell has a unit, or another that knows all nodes.
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const auto         of_ranks =
      Utilities::MPI::all_gather(communicator,
                                 entries_of_this_rank(context, fluxes));
    const auto                nodes = nodes_of_units(space, of_ranks);
    std::vector<unsigned int> claims(units.size(), 1 + rank);
    for (unsigned int u = 0; u < units.size(); ++u)
      if (owns(units[u]))
        claims[u] += n_ranks;
    for (const auto &of_rank : of_ranks)
      for (const ContactEntry<dim> &entry : of_rank)
        if (nodes.count(entry.dof) == 0)
          claims[entry.unit] = 0;
    const std::vector<unsigned int> mine(claims);
    Utilities::MPI::max(claims, communicator, claims);

    std::vector<std::map<unsigned int, ContactEntry<dim>>> of(units.size());
    for (unsigned int r = 0; r < n_ranks; ++r)
      for (const ContactEntry<dim> &entry : of_ranks[r])
        // Where none knows all, each has its part.
        if (claims[entry.unit] > 0 ? claims[entry.unit] == mine[entry.unit] :
                                     r == rank)
          {
            ContactEntry<dim> &sum = of[entry.unit][nodes.at(entry.dof)];
            sum.N += entry.N;
            sum.gradients.add(entry.gradients, 1.);
          }
    local_units.clear();
    touched.clear();
    for (unsigned int u = 0; u < units.size(); ++u)
      {
        if (of[u].empty())
          continue;
        LocalUnit unit{u, 0., {}, {}, 0., 0., {}, {}};
        for (const auto &[node, sum] : of[u])
          unit.area += sum.N;
        for (const auto &[node, sum] : of[u])
          {
            unit.nodes.push_back(node);
            unit.N.push_back(sum.N / unit.area);
            if (boundary.enforcement().has_flux())
              unit.gradients.push_back({sum.gradients.own / unit.area,
                                        sum.gradients.mean / unit.area});
          }
        local_units.push_back(unit);
      }
  }



  template <int dim>
  void
  ContactTerm<dim>::find_stiffness(const StepContext<dim> &context)
  {
    const auto         &units = boundary.units();
    std::vector<double> moduli(2 * units.size(), 0.);
    for (unsigned int u = 0; u < units.size(); ++u)
      if (owns(units[u]))
        {
          const LameConstants &C =
            context.cell_materials.elastic_stiffness(units[u].cell);
          moduli[2 * u]     = C.lambda;
          moduli[2 * u + 1] = C.mu;
        }
    Utilities::MPI::max(moduli, context.state.grid().communicator(), moduli);
    for (LocalUnit &unit : local_units)
      {
        const double lambda = moduli[2 * unit.number],
                     mu     = moduli[2 * unit.number + 1];
        const double c3 =
          boundary.enforcement().stiffness_factor / units[unit.number].h;
        // Cells with one change of volume cannot follow it at all places.
        unit.c_n =
          c3 * ((context.state.averages_volume() ? 0. : lambda) + 2 * mu);
        unit.c_t                = c3 * mu;
        const Tensor<1, dim> &n = units[unit.number].normal;
        for (const auto &[g, mean] : unit.gradients)
          unit.fluxes.push_back(
            outer_product(n, lambda * mean + 2. * mu / dim * (mean - g)) +
            mu * ((g * n) * Tensor<2, dim>(unit_symmetric_tensor<dim>()) +
                  outer_product(g, n)));
      }
  }



#define INSTANTIATE(dim)                                                     \
  template bool ContactTerm<dim>::owns(const ContactUnit<dim> &) const;      \
  template bool ContactTerm<dim>::is_in_its_cell(const GridSpace<dim> &,     \
                                                 const LocalUnit &) const;   \
  template CellFluxes<dim> ContactTerm<dim>::find_fluxes(                    \
    const StepContext<dim> &) const;                                         \
  template void ContactTerm<dim>::start_from(const CellFluxes<dim> &,        \
                                             const StepContext<dim> &);      \
  template void ContactTerm<dim>::find_local_units(const StepContext<dim> &, \
                                                   const CellFluxes<dim> &); \
  template void ContactTerm<dim>::find_stiffness(const StepContext<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
