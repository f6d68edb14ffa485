// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_archive_h
#define moraine_core_archive_h

#include <mpi.h>

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace moraine
{
  /**
   * Named data sets in memory: arrays of numbers, of integers, and texts. Names
   * are paths, "points/stress"; what stands before the last '/' is the group.
   *
   * A data set is the same on all ranks, unless its group is *distributed*:
   * then each rank holds rows of its own, and the data set "id" of the group
   * tells them apart. A row is n_components consecutive values.
   *
   * write_file() makes an HDF5 file of it, in which rows are ordered by their
   * ids, so that the file does not depend on the number of ranks. Every data
   * set has its unit and a checksum there, by which damage is found.
   */
  class Archive
  {
  public:
    struct DataSet
    {
      std::variant<std::vector<double>, std::vector<unsigned int>, std::string>
                   values;
      unsigned int n_components = 1;
      std::string  unit; ///< for who reads the file; "": none
    };

    /** Write a data set. A name can be written once. */
    void
    write(const std::string  &name,
          std::vector<double> values,
          const unsigned int  n_components = 1,
          const std::string  &unit         = "");

    void
    write(const std::string        &name,
          std::vector<unsigned int> values,
          const unsigned int        n_components = 1);

    void
    write(const std::string &name,
          const double       value,
          const std::string &unit = "");

    void
    write(const std::string &name, const unsigned int value);

    void
    write_text(const std::string &name, const std::string &text);

    /** Lines of a text, of which none has a line break. */
    void
    write_lines(const std::string &name, const std::vector<std::string> &lines);

    /** The same as from another archive. */
    void
    add(const std::string &name, DataSet set);

    /**
     * Let each rank hold rows of its own in @p group. @p ids, with
     * @p n_components each, differ for all rows of all ranks.
     */
    void
    distribute(const std::string        &group,
               std::vector<unsigned int> ids,
               const unsigned int        n_components = 1);

    /**
     * Read a data set.
     * @throws InputError naming the data set if it is missing or of another
     * kind or number of components.
     */
    const std::vector<double> &
    numbers(const std::string &name, const unsigned int n_components = 1) const;

    const std::vector<unsigned int> &
    integers(const std::string &name,
             const unsigned int n_components = 1) const;

    double
    number(const std::string &name) const;

    unsigned int
    integer(const std::string &name) const;

    const std::string &
    text(const std::string &name) const;

    std::vector<std::string>
    lines(const std::string &name) const;

    bool
    contains(const std::string &name) const
    {
      return sets.count(name) > 0;
    }

    /** All data sets by name. */
    const std::map<std::string, DataSet> &
    data_sets() const
    {
      return sets;
    }

    /** Whether the data set @p name is in a distributed group. */
    bool
    is_distributed(const std::string &name) const;

    /** Whether all values of this rank are the same, bit by bit. */
    bool
    operator==(const Archive &other) const;

    bool
    operator!=(const Archive &other) const
    {
      return !(*this == other);
    }

    /**
     * The archive with the rows of all ranks, ordered by their ids, on rank 0;
     * empty on the others. Collective.
     */
    Archive
    gathered(const MPI_Comm &communicator) const;

    /**
     * Hand over the data sets of gathered() one by one, in the order of their
     * names, so that no more than one of them is there twice; on all ranks,
     * those of others than rank 0 are empty. Collective.
     */
    void
    gather_each(const MPI_Comm &communicator,
                const std::function<void(const std::string &name, DataSet set)>
                  &take) const;

    /**
     * The reverse of gathered(): rank 0's data on all ranks, the rows of
     * distributed groups in equal shares. Collective.
     */
    Archive
    scattered(const MPI_Comm &communicator) const;

  private:
    template <class T>
    const T &
    find(const std::string &name, const unsigned int n_components) const;

    std::map<std::string, DataSet> sets;
  };

  /**
   * Write an HDF5 file that appears complete or not at all: it is on the disk
   * and was read back before it takes its name. Collective.
   * @throws InputError on every rank if it cannot be written.
   */
  void
  write_file(const Archive     &archive,
             const std::string &path,
             const MPI_Comm    &communicator);

  /**
   * Read what write_file() wrote, on any number of ranks. Collective.
   * @throws InputError on every rank if there is no such file, if it is none of
   * write_file(), or damaged.
   */
  Archive
  read_file(const std::string &path, const MPI_Comm &communicator);

  /** The same for the data sets of one @p group alone, and on this rank alone.
   */
  Archive
  read_group(const std::string &path, const std::string &group);
} // namespace moraine

#endif
