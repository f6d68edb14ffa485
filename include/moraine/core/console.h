// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_console_h
#define moraine_core_console_h

#include <mpi.h>

#include <memory>
#include <ostream>
#include <string>

namespace moraine
{
  /**
   * What a run says: rank 0 writes to the terminal and, once its directory is
   * known, to log.txt; what was said before then is in the log too. The other
   * ranks say nothing.
   */
  class Console
  {
  public:
    explicit Console(const MPI_Comm communicator);

    /** Use @p out instead of std::cout; never a terminal. */
    Console(const MPI_Comm communicator, std::ostream &out);

    ~Console();

    Console(const Console &) = delete;

    /**
     * Write everything into @p path too, from the beginning on.
     * @throw InputError on rank 0 if the file cannot be opened.
     */
    void
    open_log(const std::string &path);

    /**
     * Go on with the log in @p path after its first @p size bytes. What was
     * said before is not in it.
     * @throw InputError on rank 0 if the file cannot be opened.
     */
    void
    continue_log(const std::string &path, const std::size_t size);

    /** Bytes in the log so far; 0 on ranks without it. */
    std::size_t
    log_size();

    /**
     * Close the log.
     * @throw InputError on rank 0 if a write to it failed (disk full).
     */
    void
    close_log();

    /** Where to write; does nothing on ranks other than 0. */
    std::ostream &
    stream();

    template <typename T>
    std::ostream &
    operator<<(const T &value)
    {
      return stream() << value;
    }

    /** From now on write to the log only, or to the screen again. */
    void
    set_quiet(const bool quiet);

    /**
     * One line that the next call or output replaces, shown only on a terminal.
     */
    void
    progress(const std::string &line);

  private:
    class Tee;

    std::unique_ptr<Tee>          tee;
    std::unique_ptr<std::ostream> out;
    std::string                   log_path;
    bool                          terminal = false;
  };
} // namespace moraine

#endif
