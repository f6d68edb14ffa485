// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Moraine authors

// What mpirun starts for each rank in place of the program: asks the server of
// fork_server.cc, whose socket MORAINE_FORK_SOCKET names, for a copy that
// has this process's environment, folder and standard streams, hands signals on
// to it, and ends as it ends.
//
// The request is the number of bytes that follow, in four bytes, which carry
// the standard streams too (SCM_RIGHTS), and words that end with '\0': the
// folder, the number of arguments, the arguments, the environment. The server
// says 0 first, then the number of the process and its status, in four bytes
// each. Where the connection ends, the server ends the copy.

#include <sys/socket.h>
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

extern char **environ;

namespace
{
  volatile std::sig_atomic_t copy    = 0;
  volatile std::sig_atomic_t pending = 0;

  [[noreturn]] void
  fail(const char *what)
  {
    std::fprintf(stderr, "fork_client: %s\n", what);
    std::exit(127);
  }

  extern "C" void
  hand_on(const int signal)
  {
    if (copy == 0)
      pending = signal;
    else
      kill(copy, signal == SIGUSR2 ? SIGKILL : signal);
  }

  void
  catch_signals()
  {
    struct sigaction action = {};
    action.sa_handler       = hand_on;
    action.sa_flags         = SA_RESTART;
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2})
      sigaction(signal, &action, nullptr);
  }

  int
  connect_to(const char *name)
  {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const int  n       = std::snprintf(address.sun_path + 1,
                                sizeof(address.sun_path) - 1,
                                "%s",
                                name);
    const int  s       = socket(AF_UNIX, SOCK_STREAM, 0);
    const auto size    = offsetof(sockaddr_un, sun_path) + 1 + n;
    if (s < 0 || connect(s, reinterpret_cast<sockaddr *>(&address), size) != 0)
      fail("no server");
    return s;
  }

  void
  send_streams(const int s, std::uint32_t n)
  {
    iovec                 bytes{&n, sizeof(n)};
    alignas(cmsghdr) char control[CMSG_SPACE(3 * sizeof(int))] = {};
    msghdr                message{};
    message.msg_iov        = &bytes;
    message.msg_iovlen     = 1;
    message.msg_control    = control;
    message.msg_controllen = sizeof(control);
    cmsghdr  *header       = CMSG_FIRSTHDR(&message);
    const int streams[]    = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
    header->cmsg_level     = SOL_SOCKET;
    header->cmsg_type      = SCM_RIGHTS;
    header->cmsg_len       = CMSG_LEN(sizeof(streams));
    std::memcpy(CMSG_DATA(header), streams, sizeof(streams));
    if (sendmsg(s, &message, MSG_NOSIGNAL) != sizeof(n))
      fail("the server takes no request");
  }

  int
  read_number(const int s)
  {
    std::int32_t number = 0;
    std::size_t  n      = 0;
    while (n < sizeof(number))
      {
        const ssize_t n_read =
          read(s, reinterpret_cast<char *>(&number) + n, sizeof(number) - n);
        if (n_read <= 0)
          fail("the server has left");
        n += n_read;
      }
    return number;
  }
} // namespace

int
main(int argc, char **argv)
{
  catch_signals();
  const char *name = std::getenv("MORAINE_FORK_SOCKET");
  if (name == nullptr)
    fail("MORAINE_FORK_SOCKET is not set");
  const int s = connect_to(name);
  read_number(s);
  char       *folder = getcwd(nullptr, 0);
  std::string words  = folder + std::string(1, '\0');
  words += std::to_string(argc - 1) + '\0';
  for (int i = 1; i < argc; ++i)
    words += argv[i] + std::string(1, '\0');
  for (char **variable = environ; *variable; ++variable)
    words += *variable + std::string(1, '\0');
  send_streams(s, words.size());
  for (std::size_t sent = 0; sent < words.size();)
    {
      const ssize_t n =
        send(s, words.data() + sent, words.size() - sent, MSG_NOSIGNAL);
      if (n < 0)
        fail("the server takes no request");
      sent += n;
    }
  copy = read_number(s);
  if (pending != 0)
    kill(copy, pending);
  const int status = read_number(s);
  if (!WIFSIGNALED(status))
    return WEXITSTATUS(status);
  std::signal(WTERMSIG(status), SIG_DFL);
  std::raise(WTERMSIG(status));
  return 128 + WTERMSIG(status);
}
