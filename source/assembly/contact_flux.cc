// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/assembly/contact_flux.h>

namespace moraine
{
  using namespace dealii;

  template <int dim>
  CellFluxes<dim>
  fluxes_in_cells(const StepContext<dim>          &context,
                  const std::vector<unsigned int> &cells)
  {
    const PointSet<dim> &points = context.state.material_points();
    const Basis<dim>    &basis  = context.state.point_basis();
    CellFluxes<dim>      fluxes;
    for (const unsigned int cell : cells)
      fluxes[cell];
    std::vector<Tensor<1, dim>> mean; // by which volume changes
    StencilBlock<dim>           block;
    for (unsigned int g = 0; g < basis.n_batches(); ++g)
      {
        const unsigned int cell =
          points.cell_of(basis.first_point_of(g))->active_cell_index();
        const auto found = fluxes.find(cell);
        if (found == fluxes.end())
          continue;
        CellFlux<dim> &flux = found->second;
        context.state.evaluate(g, block);
        mean.resize(block.n_nodes);
        for (unsigned int i = 0; i < block.n_points; ++i)
          {
            const unsigned int p = block.points[i];
            const double       volume =
              block.share(i) * context.state.integration_volume(p);
            const auto sigma = points.stress_field()(points.values(p));
            flux.volume += volume;
            for (unsigned int d = 0; d < dim; ++d)
              for (unsigned int e = d; e < dim; ++e)
                flux.stress[d][e] += volume * sigma[d][e];
            const Tensor<1, dim> *grad_N = block.grad_N(i);
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              mean[a] = block.means.n_cells > 0 ? Tensor<1, dim>() : grad_N[a];
            constexpr unsigned int n = CellMeanBlock<dim>::n_corners;
            for (unsigned int c = 0; c < block.means.n_cells; ++c)
              for (unsigned int a = 0; a < n; ++a)
                mean[block.means.places[c * n + a]] +=
                  block.means.share(i, c) * block.means.gradients[c * n + a];
            for (unsigned int a = 0; a < block.n_nodes; ++a)
              flux.gradients[block.nodes[a]].add({grad_N[a], mean[a]}, volume);
          }
      }
    return fluxes;
  }



#define INSTANTIATE(dim) \
  template decltype(fluxes_in_cells<dim>) fluxes_in_cells<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace moraine
