// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_boundary_carried_tractions_h
#define moraine_boundary_carried_tractions_h

#include <moraine/core/archive.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace moraine
{
  /** The state of a place of a surface, kept from step to step. */
  template <int dim>
  struct CarriedPlace
  {
    dealii::Tensor<1, dim> place; ///< in the surface's own frame
    /** Multiplier and accumulated violation; a roller's in that frame too. */
    dealii::Tensor<1, dim> multiplier = {};
    dealii::Tensor<1, dim> violation  = {};
    /** How the traction of the piece varies along it [stress/length]: a row for
     * each of its components, columns in the surface's own frame. */
    dealii::Tensor<2, dim> slope = {};
    double                 area  = 0; ///< of the surface that it stands for
    /** Outward, in the surface's own frame. */
    dealii::Tensor<1, dim> normal;
    double                 h = 0; ///< size of the cell it was in
    /** Cell and number of the point it was: names that ranks share. */
    std::array<unsigned int, 2> id;

    template <class BoostArchive>
    void
    serialize(BoostArchive &archive, const unsigned int)
    {
      archive &place &multiplier &violation &slope &area &normal &h &id;
    }
  };

  /** The state of the places of a surface on this rank: after the last accepted
   * step, and after the trial. */
  template <int dim>
  class CarriedTractions
  {
  public:
    using Places = std::vector<CarriedPlace<dim>>;

    /** Carry this once the step is accepted. */
    void
    prepare(Places &&places)
    {
      prepared = std::move(places);
    }

    void
    keep() noexcept
    {
      std::swap(carried, prepared);
    }

    void
    forget() noexcept
    {
      carried.clear();
    }

    void
    undo()
    {
      prepared.clear();
    }

    const Places &
    places() const
    {
      return carried;
    }

    /**
     * Hand over to new places what the nearest carried place of all ranks has,
     * if one is near and faces the same way: the next side of a corner and
     * places of another body are no place of it. Of @p means each gets the
     * area-weighted mean of the old places nearest to it, so that the total
     * force is kept. Collective.
     * @return of @p to; nothing if no rank carries anything.
     */
    Places
    handed_over(const Places   &to,
                const bool      means,
                const MPI_Comm &communicator) const;

    void
    write(Archive &archive, const std::string &group) const;

    void
    read(const Archive &archive, const std::string &group);

  private:
    Places carried;
    Places prepared;
  };
} // namespace moraine

#endif
