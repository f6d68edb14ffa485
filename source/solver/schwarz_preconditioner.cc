// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/solver/schwarz_preconditioner.h>

#include <algorithm>

namespace moraine
{
  using namespace dealii;

  namespace
  {
    /** Layers of the matrix's graph around a subdomain. Fewer cost less each
     * and let the number of iterations grow as Poisson's ratio goes to 0.5. */
    constexpr unsigned int
    layers_around(const unsigned int dim)
    {
      return dim == 2 ? 5 : 4;
    }



    LA::Vector
    vector_of(const LA::SparseMatrix &matrix)
    {
      return LA::Vector(matrix.locally_owned_range_indices(),
                        matrix.get_mpi_communicator());
    }
  } // namespace



  SchwarzPreconditioner::SchwarzPreconditioner(
    const LA::SparseMatrix        &matrix,
    const std::vector<LA::Vector> &modes,
    const unsigned int             dim,
    const unsigned int             block)
    : rows(matrix, layers_around(dim))
    , subdomains(rows, dim, block, matrix.get_mpi_communicator())
    , coarse_space(rows, subdomains, modes, vector_of(matrix))
    , target(rows.n_rows())
  {
    for (unsigned int s = 0; s < subdomains.n_subdomains(); ++s)
      {
        const auto unknowns = subdomains.with_neighbours(s, layers_around(dim));
        overlapping.push_back({unknowns, rows.factorise(unknowns)});
      }
  }



  void
  SchwarzPreconditioner::vmult(LA::Vector &dst, const LA::Vector &src) const
  {
    coarse_space.vmult(dst, src);
    rows.import(source, src);
    std::fill(target.begin(), target.end(), 0.);
    std::vector<double> b, x;
    for (const Overlapping &subdomain : overlapping)
      if (!subdomain.factors.is_singular())
        {
          b.resize(subdomain.unknowns.size());
          for (unsigned int k = 0; k < b.size(); ++k)
            b[k] = source[subdomain.unknowns[k]];
          subdomain.factors.solve(x, b);
          for (unsigned int k = 0; k < b.size(); ++k)
            target[subdomain.unknowns[k]] += x[k];
        }
    dst += rows.sum(target);
  }
} // namespace moraine
