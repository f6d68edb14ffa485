// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Preloaded into the program (LD_PRELOAD): instead of running its main(), the
// process stands before it with all libraries loaded, and copies itself for
// each run that is asked for. Starting anew takes a quarter of a second, nearly
// all of it to look up symbols in 200 libraries; tests start a thousand times.
//
// A request on standard input is its number of bytes, in four bytes, then words
// that end with '\0': the folder to run in, files for standard output and for
// standard error, and the command line. Answers on standard output are the
// number of the process, in a line, and when it has ended, its exit code or
// minus the signal that ended it. The server ends with its input. See
// fork_server.py.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{
  using Main        = int (*)(int, char **, char **);
  Main program_main = nullptr;

  // False at the end of the input.
  bool
  read_bytes(char *to, std::size_t n)
  {
    while (n > 0)
      {
        const ssize_t n_read = read(STDIN_FILENO, to, n);
        if (n_read <= 0)
          return false;
        to += n_read;
        n -= n_read;
      }
    return true;
  }

  void
  redirect(const int descriptor, const char *file, const int flags)
  {
    const int opened = open(file, flags, 0666);
    if (opened < 0 || dup2(opened, descriptor) < 0)
      _exit(127);
    close(opened);
  }

  int
  serve(int, char **, char **environment)
  {
    std::uint32_t n = 0;
    while (read_bytes(reinterpret_cast<char *>(&n), sizeof(n)))
      {
        std::string request(n, '\0');
        if (!read_bytes(request.data(), n))
          break;
        std::vector<char *> words;
        for (std::size_t at = 0; at < n; at = request.find('\0', at) + 1)
          words.push_back(request.data() + at);
        const int n_arguments = static_cast<int>(words.size()) - 3;
        words.push_back(nullptr);

        const pid_t child = fork();
        if (child < 0)
          return 1;
        if (child == 0)
          {
            if (chdir(words[0]) != 0)
              _exit(127);
            redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
            redirect(STDOUT_FILENO, words[1], O_WRONLY | O_CREAT | O_TRUNC);
            redirect(STDERR_FILENO, words[2], O_WRONLY | O_CREAT | O_TRUNC);
            return program_main(n_arguments, words.data() + 3, environment);
          }
        dprintf(STDOUT_FILENO, "%d\n", static_cast<int>(child));
        int status = 0;
        if (waitpid(child, &status, 0) != child)
          return 1;
        dprintf(STDOUT_FILENO,
                "%d\n",
                WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status));
      }
    return 0;
  }
} // namespace

// Called in place of the function of the C library that calls main().
extern "C" int
__libc_start_main(Main   main,
                  int    argc,
                  char **argv,
                  void (*init)(),
                  void (*fini)(),
                  void (*rtld_fini)(),
                  void *stack_end)
{
  unsetenv("LD_PRELOAD");
  program_main     = main;
  const auto start = reinterpret_cast<decltype(&__libc_start_main)>(
    dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(serve, argc, argv, init, fini, rtld_fini, stack_end);
}
