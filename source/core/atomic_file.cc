// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/atomic_file.h>
#include <moraine/core/exceptions.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace moraine
{
  AtomicFile::AtomicFile(const std::string &path)
    : path(path)
    , temporary(path + ".part")
  {
    errno = 0;
    file.open(temporary, std::ios::binary);
    if (!file)
      fail();
  }



  AtomicFile::~AtomicFile()
  {
    if (!committed)
      {
        file.close();
        std::remove(temporary.c_str());
      }
  }



  std::ostream &
  AtomicFile::stream()
  {
    return file;
  }



  void
  AtomicFile::commit(const std::function<void(const std::string &)> &verify)
  {
    if (file) // else it says why a write failed
      errno = 0;
    file.close(); // flushes, and fails if an earlier write did
    if (!file)
      fail();
    if (verify)
      verify(temporary);
    if (std::rename(temporary.c_str(), path.c_str()) != 0)
      fail();
    committed = true;
  }



  void
  AtomicFile::fail() const
  {
    const int reason = errno;
    throw InputError(path + ": cannot be written" +
                     (reason != 0 ? std::string(": ") + std::strerror(reason) :
                                    std::string(" (is the disk full?)")));
  }
} // namespace moraine
