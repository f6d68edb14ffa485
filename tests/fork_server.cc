// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// Preloaded into the program (LD_PRELOAD): instead of running its main(), the
// process stands before it with all libraries loaded, and copies itself for
// each run that fork_client.cc asks for. Starting anew takes a quarter of a
// second, nearly all of it to look up symbols in 200 libraries; tests start
// thousands of processes.
//
// Its socket is named by MORAINE_FORK_SOCKET. Says "ready" in a line of
// standard output, and ends when nobody has been connected for half a minute.

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <set>
#include <string>
#include <vector>

namespace
{
  using Main        = int (*)(int, char **, char **);
  Main program_main = nullptr;

  // Copies write names of plugins of Open MPI into one end; what the server
  // reads at the other it loads for those that come.
  int  plugin_names[2];
  bool is_copy = false;

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

  // Run the program, but do not destroy its static objects, which takes a third
  // of the time of a short run, page by page.
  [[noreturn]] void
  run(std::vector<char *> arguments)
  {
    const int n = static_cast<int>(arguments.size());
    arguments.push_back(nullptr);
    const int status = program_main(n, arguments.data(), environ);
    std::cout.flush();
    std::clog.flush();
    std::fflush(nullptr);
    _exit(status);
  }

  // In a copy that a client has asked for.
  [[noreturn]] void
  answer(const int client)
  {
    std::string request(receive_streams(client), '\0');
    if (!read_bytes(client, request.data(), request.size()))
      _exit(127);
    close(client);
    std::vector<char *> words;
    for (std::size_t at = 0; at < request.size();
         at             = request.find('\0', at) + 1)
      words.push_back(request.data() + at);
    if (chdir(words[0]) != 0)
      _exit(127);
    const auto variables = words.begin() + 2 + std::atoi(words[1]);
    clearenv();
    std::for_each(variables, words.end(), putenv);
    run({words.begin() + 2, variables});
  }

  // Who is connected, and the copy that runs until it ends or its client does.
  struct Client
  {
    int   socket;
    pid_t copy = 0;
    int   end  = -1; // readable when the copy has ended
  };

  bool
  tell(const Client &client, const std::int32_t number)
  {
    return send(client.socket, &number, sizeof(number), MSG_NOSIGNAL) ==
           sizeof(number);
  }

  // False if the client has left or no copy can be made.
  bool
  begin_copy(Client &client, const std::vector<Client> &all)
  {
    char byte;
    if (client.copy > 0 || recv(client.socket, &byte, 1, MSG_PEEK) != 1)
      return false;
    client.copy = fork();
    if (client.copy == 0)
      {
        is_copy = true;
        close(plugin_names[0]);
        for (const Client &other : all)
          if (other.socket != client.socket)
            close(other.socket);
        answer(client.socket);
      }
    if (client.copy > 0)
      client.end = static_cast<int>(syscall(SYS_pidfd_open, client.copy, 0));
    return client.end >= 0 && tell(client, client.copy);
  }

  void
  leave(const Client &client)
  {
    if (client.copy > 0)
      {
        kill(client.copy, SIGKILL); // nothing to a copy that has ended
        int status = 0;
        waitpid(client.copy, &status, 0);
        tell(client, status);
        close(client.end);
      }
    close(client.socket);
  }

  void
  load_plugins()
  {
    static std::set<std::string> loaded;
    static std::string           unread;
    char                         bytes[4096];
    const ssize_t n = read(plugin_names[0], bytes, sizeof(bytes));
    unread.append(bytes, std::max<ssize_t>(n, 0));
    for (std::size_t end; (end = unread.find('\n')) != std::string::npos;
         unread.erase(0, end + 1))
      if (loaded.insert(unread.substr(0, end)).second)
        dlopen(unread.substr(0, end).c_str(), RTLD_NOW);
  }

  // Wait for something to do and do it. False if nobody has been there for
  // long.
  bool
  attend(const int listener, std::vector<Client> &clients)
  {
    std::vector<pollfd> events{{listener, POLLIN, 0},
                               {plugin_names[0], POLLIN, 0}};
    for (const Client &client : clients)
      {
        // Of a client that has its copy, only that it leaves.
        const short speaks = client.copy > 0 ? 0 : POLLIN;
        events.push_back({client.socket, speaks, 0});
        events.push_back({client.end, POLLIN, 0}); // a negative one is left out
      }
    if (poll(events.data(), events.size(), 30000) == 0)
      return !clients.empty();
    std::vector<Client> remaining;
    for (std::size_t i = 0; i < clients.size(); ++i)
      {
        const bool has_spoken = events[2 + 2 * i].revents != 0,
                   has_ended  = events[3 + 2 * i].revents != 0;
        if (has_ended || (has_spoken && !begin_copy(clients[i], clients)))
          leave(clients[i]);
        else
          remaining.push_back(clients[i]);
      }
    clients = remaining;
    if (events[1].revents != 0)
      load_plugins();
    if (events[0].revents != 0)
      {
        const Client client{accept(listener, nullptr, nullptr)};
        if (client.socket >= 0 && tell(client, 0))
          clients.push_back(client);
      }
    return true;
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
        listen(listener, 64) != 0 || pipe2(plugin_names, O_CLOEXEC) != 0)
      return 1;
    std::puts("ready");
    std::fflush(stdout);
    std::vector<Client> clients;
    while (attend(listener, clients))
      ;
    return 0;
  }
} // namespace

// A plugin is loaded.
extern "C" void *
dlopen(const char *name, const int flags)
{
  static const auto open_library =
    reinterpret_cast<decltype(&dlopen)>(dlsym(RTLD_NEXT, "dlopen"));
  void *const library = open_library(name, flags);
  if (library && name && is_copy)
    {
      const std::string line = std::string(name) + '\n';
      if (write(plugin_names[1], line.data(), line.size()) < 0)
        std::perror("fork_server");
    }
  return library;
}

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
