// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_output_vtu_file_h
#define moraine_output_vtu_file_h

#include <moraine/core/units.h>

#include <deal.II/base/data_out_base.h>

#include <mpi.h>

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace moraine
{
  /** Where the file of a step goes, and what it says of it. */
  struct VtuTarget
  {
    std::string  path;
    double       time;
    unsigned int step;
    Units        units = {}; ///< names of those of the fields
  };

  /**
   * Patches with named fields on their way into a VTU file. deal.II writes;
   * this class only holds what it asks for, a piece of the file at a time: in
   * memory, patches take ten times what they take in the file.
   */
  template <int patch_dim, int dim>
  class VtuFile : public dealii::DataOutInterface<patch_dim, dim>
  {
  public:
    using Patch = dealii::DataOutBase::Patch<patch_dim, dim>;

    explicit VtuFile(const VtuTarget &target)
      : target(target)
    {}

    /** Declare a field of one number; its row is the next one. */
    void
    add_scalar(const std::string &name, const std::string &unit);

    /** Declare a field of dim numbers, drawn as a vector. */
    void
    add_vector(const std::string &name, const std::string &unit);

    /** Declare a field of nine numbers, drawn as a 3x3 tensor in 2D and 3D. */
    void
    add_tensor(const std::string &name, const std::string &unit);

    /** Rows declared so far. */
    unsigned int
    n_rows() const
    {
      return names.size();
    }

    /**
     * Write one file for all ranks and agree on the result. Collective.
     * @p make_patch gives the patches of this rank, from 0 to @p n_patches,
     * each once and in this order; they get their indices here.
     *
     * @throws InputError naming the file.
     */
    void
    write(const MPI_Comm                                 &communicator,
          const unsigned int                              n_patches,
          const std::function<Patch(const unsigned int)> &make_patch);

  protected:
    const std::vector<Patch> &
    get_patches() const override;

    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

  private:
    /** The next piece of a file: XML of the patches in memory. */
    std::string
    piece(const dealii::DataOutBase::VtkFlags &flags) const;

    void
    add_range(
      const std::string &name,
      const std::string &unit,
      const unsigned int n_components,
      const dealii::DataComponentInterpretation::DataComponentInterpretation
        interpretation);

    const VtuTarget                    target;
    std::vector<Patch>                 patches;
    std::vector<std::string>           names;
    std::map<std::string, std::string> units;
    std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>
      ranges;
  };
} // namespace moraine

#endif
