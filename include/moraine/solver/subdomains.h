// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_solver_subdomains_h
#define moraine_solver_subdomains_h

#include <moraine/solver/overlapping_rows.h>

#include <mpi.h>

#include <vector>

namespace moraine
{
  /**
   * The unknowns of each rank divided into subdomains of about the same size
   * with short interfaces, by METIS.
   */
  class Subdomains
  {
  public:
    /**
     * The unknowns of a node, the @p block that follow each other, stay
     * together. @p dim, 2 or 3, gives the size. Collective.
     */
    Subdomains(const OverlappingRows &rows,
               const unsigned int     dim,
               const unsigned int     block,
               const MPI_Comm        &communicator);

    /** Of this rank. */
    unsigned int
    n_subdomains() const
    {
      return own.size();
    }

    /** The unknowns of a subdomain of this rank, as rows, in their order. */
    const std::vector<unsigned int> &
    unknowns(const unsigned int subdomain) const
    {
      return own[subdomain];
    }

    /** These, and @p layers of neighbours around them. */
    std::vector<unsigned int>
    with_neighbours(const unsigned int subdomain,
                    const unsigned int layers) const;

    /** The number over all ranks of the subdomain that a row belongs to. */
    unsigned int
    label(const unsigned int row) const
    {
      return labels[row];
    }

  private:
    const OverlappingRows                 &rows;
    std::vector<std::vector<unsigned int>> own;
    std::vector<unsigned int>              labels;
  };
} // namespace moraine

#endif
