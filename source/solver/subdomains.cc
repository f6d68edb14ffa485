// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/subdomains.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Unknowns of a subdomain before it overlaps others. Larger ones take
     * longer to factorise, smaller ones are nearly all overlap. */
    constexpr unsigned int size_2d = 1000, size_3d = 3000;



    /** Which subdomain of this rank each node goes to. */
    std::vector<unsigned int>
    partition_nodes(const OverlappingRows &rows,
                    const unsigned int     dim,
                    const unsigned int     block)
    {
      const unsigned int        n_nodes = rows.n_owned() / block;
      DynamicSparsityPattern    graph(n_nodes, n_nodes);
      std::vector<unsigned int> neighbours, weights(n_nodes);
      for (unsigned int node = 0; node < n_nodes; ++node)
        {
          neighbours.assign(1, node);
          for (auto e = rows.begin(node * block);
               e < rows.begin((node + 1) * block);
               ++e)
            if (rows.column(e) < rows.n_owned())
              neighbours.push_back(rows.column(e) / block);
          std::sort(neighbours.begin(), neighbours.end());
          neighbours.erase(std::unique(neighbours.begin(), neighbours.end()),
                           neighbours.end());
          weights[node] = neighbours.size() > 1;
          for (const unsigned int neighbour : neighbours)
            {
              graph.add(node, neighbour);
              graph.add(neighbour, node);
            }
        }
      const unsigned int size = dim == 2 ? size_2d : size_3d;
      const unsigned int n_connected =
        std::count(weights.begin(), weights.end(), 1);
      const unsigned int n_subdomains =
        std::max(1u, (n_connected * block + size / 2) / size);
      std::vector<unsigned int> subdomain(n_nodes, 0);
      dealii::SparsityPattern   compressed;
      compressed.copy_from(graph);
      if (n_subdomains > 1)
        SparsityTools::partition(compressed, weights, n_subdomains, subdomain);
      return subdomain;
    }
  } // namespace



  Subdomains::Subdomains(const OverlappingRows &rows,
                         const unsigned int     dim,
                         const unsigned int     block,
                         const MPI_Comm        &communicator)
    : rows(rows)
  {
    const std::vector<unsigned int> subdomain =
      partition_nodes(rows, dim, block);
    for (unsigned int i = 0; i < rows.n_owned(); ++i)
      {
        const unsigned int s = subdomain[i / block];
        if (s >= own.size())
          own.resize(s + 1);
        own[s].push_back(i);
      }
    unsigned int first = 0;
    const auto   all = Utilities::MPI::all_gather(communicator, n_subdomains());
    for (unsigned int p = 0; p < Utilities::MPI::this_mpi_process(communicator);
         ++p)
      first += all[p];
    std::vector<double> numbers(rows.n_owned());
    for (unsigned int i = 0; i < rows.n_owned(); ++i)
      numbers[i] = first + subdomain[i / block];
    const std::vector<double> all_numbers = rows.import({numbers})[0];
    labels.assign(all_numbers.begin(), all_numbers.end());
  }



  std::vector<unsigned int>
  Subdomains::with_neighbours(const unsigned int subdomain,
                              const unsigned int layers) const
  {
    std::vector<unsigned int> all = own[subdomain];
    std::vector<bool>         is_in(rows.n_rows(), false);
    for (const unsigned int i : all)
      is_in[i] = true;
    unsigned int begin = 0;
    for (unsigned int layer = 0; layer < layers; ++layer)
      {
        const unsigned int end = all.size();
        for (; begin < end; ++begin)
          for (auto e = rows.begin(all[begin]); e < rows.begin(all[begin] + 1);
               ++e)
            if (!is_in[rows.column(e)])
              {
                is_in[rows.column(e)] = true;
                all.push_back(rows.column(e));
              }
      }
    return all;
  }
} // namespace moraine
