// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#ifndef moraine_core_atomic_file_h
#define moraine_core_atomic_file_h

#include <fstream>
#include <functional>
#include <string>

namespace moraine
{
  /**
   * A file that appears complete or not at all: written beside its place under
   * a temporary name, and renamed by commit(). What was there before stays
   * until then. One rank writes; the class knows nothing of the others.
   */
  class AtomicFile
  {
  public:
    /** @throw InputError if the file cannot be opened. */
    explicit AtomicFile(const std::string &path);

    /** Removes the temporary file if commit() was not reached. */
    ~AtomicFile();

    AtomicFile(const AtomicFile &) = delete;

    /** Where to write. */
    std::ostream &
    stream();

    /**
     * Flush, close and rename. Before that, @p verify may look at the closed
     * file, whose name it is given, and throw.
     * @throw InputError naming the file if any write failed (disk full).
     */
    void
    commit(const std::function<void(const std::string &)> &verify = {});

  private:
    [[noreturn]] void
    fail() const;

    std::string   path;
    std::string   temporary;
    std::ofstream file;
    bool          committed = false;
  };
} // namespace moraine

#endif
