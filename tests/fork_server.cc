// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Preloaded into the program (LD_PRELOAD): instead of running its main(), the
// process stands before it with all libraries loaded, and copies itself for
// each run that fork_client.cc asks for. Starting anew takes a quarter of a
// second, nearly all of it to look up symbols in 200 libraries; tests start
// thousands of processes.
//
// Its socket is named by MORAINE_FORK_SOCKET. Says "ready" in a line of
// standard output, and ends with its input.

#include <dlfcn.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace
{
  using Main        = int (*)(int, char **, char **);
  Main program_main = nullptr;

  // False at the end of the input.
  bool
  read_bytes(const int from, char *to, std::size_t n)
  {
    while (n > 0)
      {
        const ssize_t n_read = read(from, to, n);
        if (n_read <= 0)
          return false;
        to += n_read;
        n -= n_read;
      }
    return true;
  }

  // The size of the request; its standard streams become those of this process.
  std::uint32_t
  receive_streams(const int client)
  {
    std::uint32_t         n = 0;
    iovec                 bytes{&n, sizeof(n)};
    alignas(cmsghdr) char control[CMSG_SPACE(3 * sizeof(int))];
    msghdr                message{};
    message.msg_iov        = &bytes;
    message.msg_iovlen     = 1;
    message.msg_control    = control;
    message.msg_controllen = sizeof(control);
    if (recvmsg(client, &message, 0) != sizeof(n) || !CMSG_FIRSTHDR(&message))
      _exit(127);
    int streams[3];
    std::memcpy(streams, CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof(streams));
    for (int i = 0; i < 3; ++i)
      {
        dup2(streams[i], i);
        close(streams[i]);
      }
    return n;
  }

  // In the copy: become the program.
  [[noreturn]] void
  run(const std::vector<char *> &words)
  {
    const int n_arguments = std::atoi(words[1]);
    if (chdir(words[0]) != 0)
      _exit(127);
    std::vector<char *> arguments(words.begin() + 2,
                                  words.begin() + 2 + n_arguments);
    arguments.push_back(nullptr);
    clearenv();
    for (auto word = words.begin() + 2 + n_arguments; word != words.end();
         ++word)
      putenv(*word);
    // Not by return: arguments and environment are in the caller's request.
    std::exit(program_main(n_arguments, arguments.data(), environ));
  }

  // The copy runs until it ends or its client does.
  void
  keep(const int client, const pid_t copy)
  {
    const auto tell = [client](const std::int32_t number) {
      return send(client, &number, sizeof(number), MSG_NOSIGNAL) ==
             sizeof(number);
    };
    const int end      = static_cast<int>(syscall(SYS_pidfd_open, copy, 0));
    pollfd    either[] = {{end, POLLIN, 0}, {client, POLLIN, 0}};
    bool      is_asked = end >= 0 && tell(copy);
    while (is_asked && either[0].revents == 0)
      {
        poll(either, 2, -1);
        is_asked = either[1].revents == 0;
      }
    if (either[0].revents == 0)
      kill(copy, SIGKILL);
    int status = 0;
    waitpid(copy, &status, 0);
    tell(status);
  }

  [[noreturn]] void
  answer(const int client)
  {
    std::string request(receive_streams(client), '\0');
    if (!read_bytes(client, request.data(), request.size()))
      _exit(127);
    std::vector<char *> words;
    for (std::size_t at = 0; at < request.size();
         at             = request.find('\0', at) + 1)
      words.push_back(request.data() + at);
    std::signal(SIGCHLD, SIG_DFL);
    const pid_t copy = fork();
    if (copy == 0)
      {
        close(client);
        run(words);
      }
    if (copy > 0)
      keep(client, copy);
    _exit(0);
  }

  int
  serve(int, char **, char **)
  {
    sockaddr_un address{};
    address.sun_family   = AF_UNIX;
    const char *name     = std::getenv("MORAINE_FORK_SOCKET");
    const int   n        = std::snprintf(address.sun_path + 1,
                                sizeof(address.sun_path) - 1,
                                "%s",
                                name ? name : "");
    const int   listener = socket(AF_UNIX, SOCK_STREAM, 0);
    if (bind(listener,
             reinterpret_cast<sockaddr *>(&address),
             offsetof(sockaddr_un, sun_path) + 1 + n) != 0 ||
        listen(listener, 64) != 0)
      return 1;
    std::signal(SIGCHLD, SIG_IGN); // keepers leave nothing behind
    std::puts("ready");
    std::fflush(stdout);
    pollfd either[] = {{listener, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
    while (poll(either, 2, -1) > 0 && either[1].revents == 0)
      {
        const int client = accept(listener, nullptr, nullptr);
        if (client >= 0 && fork() == 0)
          {
            close(listener);
            answer(client);
          }
        close(client);
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
