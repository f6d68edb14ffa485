// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

#include <moraine/core/console.h>
#include <moraine/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <streambuf>

#include <unistd.h>

namespace moraine
{
  /** Passes characters to the terminal and to the log, or keeps them for it. */
  class Console::Tee : public std::streambuf
  {
  public:
    explicit Tee(std::ostream &screen)
      : screen(screen)
    {}

    void
    show_progress(const std::string &line)
    {
      screen << "\r\033[K" << line << std::flush;
      progress_shown = true;
    }

    void
    clear_progress()
    {
      if (progress_shown)
        screen << "\r\033[K";
      progress_shown = false;
    }

    std::ostream &screen;
    std::ofstream log;
    std::string   before_log;
    bool          keep  = true;
    bool          quiet = false;

  protected:
    std::streamsize
    xsputn(const char *text, const std::streamsize n) override
    {
      if (!quiet)
        {
          clear_progress();
          screen.write(text, n);
        }
      if (log.is_open())
        log.write(text, n);
      else if (keep)
        before_log.append(text, n);
      return n;
    }

    int_type
    overflow(const int_type c) override
    {
      if (c == traits_type::eof())
        return 0;
      const char character = traits_type::to_char_type(c);
      xsputn(&character, 1);
      return c;
    }

    int
    sync() override
    {
      screen.flush();
      if (log.is_open())
        log.flush();
      return 0;
    }

  private:
    bool progress_shown = false;
  };



  Console::Console(const MPI_Comm communicator)
    : Console(communicator, std::cout)
  {
    // mpirun gives the program a terminal for stdout even if it has none
    // itself, but not for stderr.
    terminal = tee != nullptr && isatty(STDOUT_FILENO) == 1 &&
               isatty(STDERR_FILENO) == 1;
  }



  Console::Console(const MPI_Comm communicator, std::ostream &screen)
  {
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      tee = std::make_unique<Tee>(screen);
    // A stream without buffer drops what it is given.
    out = std::make_unique<std::ostream>(tee.get());
  }



  Console::~Console()
  {
    if (tee)
      tee->clear_progress();
    out->flush();
  }



  void
  Console::open_log(const std::string &path)
  {
    if (!tee)
      return;
    log_path = path;
    errno    = 0;
    tee->log.open(path);
    if (!tee->log)
      throw InputError(path + ": cannot be written: " + std::strerror(errno));
    tee->log << tee->before_log << std::flush;
    tee->before_log.clear();
    tee->keep = false;
  }



  void
  Console::continue_log(const std::string &path, const std::size_t size)
  {
    if (!tee)
      return;
    namespace fs = std::filesystem;
    log_path     = path;
    std::error_code error;
    if (fs::file_size(path, error) > size && !error)
      fs::resize_file(path, size, error);
    errno = 0;
    tee->log.open(path, std::ios::app);
    if (!tee->log)
      throw InputError(path + ": cannot be written: " + std::strerror(errno));
    tee->before_log.clear();
    tee->keep = false;
  }



  std::size_t
  Console::log_size()
  {
    if (!tee || !tee->log.is_open())
      return 0;
    tee->log.flush();
    return static_cast<std::size_t>(tee->log.tellp());
  }



  void
  Console::close_log()
  {
    if (!tee || !tee->log.is_open())
      return;
    tee->log.close();
    if (!tee->log)
      throw InputError(log_path + ": cannot be written (is the disk full?)");
  }



  std::ostream &
  Console::stream()
  {
    return *out;
  }



  void
  Console::set_quiet(const bool quiet)
  {
    if (tee)
      tee->quiet = quiet;
  }



  void
  Console::progress(const std::string &line)
  {
    if (terminal && !tee->quiet)
      tee->show_progress(line);
  }
} // namespace moraine
