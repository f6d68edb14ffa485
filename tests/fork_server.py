# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Starts the program: as copies of one that stands ready, its libraries loaded, if
MORAINE_FORK_SERVER and MORAINE_FORK_CLIENT name what comes of fork_server.cc and
fork_client.cc, as ctest says; else anew."""

import os
import signal
import socket
import subprocess


class _Copy(subprocess.Popen):
    """What stands in for a run hands on every signal but SIGKILL, for which
    SIGUSR2 stands."""

    def kill(self):
        self.send_signal(signal.SIGUSR2)


class Starter:
    def __init__(self, program):
        self.program = str(program)
        self.library = os.environ.get("MORAINE_FORK_SERVER")
        self.lease = None

    def command(self, arguments, ranks=1, mpirun=("mpirun", "-q")):
        """What to start, with environment()."""
        client = [os.environ["MORAINE_FORK_CLIENT"]] if self.library else []
        launcher = [*mpirun, "-n", str(ranks)] if ranks > 1 else []
        return [*launcher, *client, self.program, *map(str, arguments)]

    def environment(self):
        if not self.library:
            return None
        if not self.lease:
            self._connect()
        return {**os.environ, "MORAINE_FORK_SOCKET": self.name}

    def _connect(self):
        """All tests of this program share a server, which stays while someone is
        connected."""
        files = [os.stat(file) for file in (self.program, self.library)]
        self.name = "moraine-" + "-".join(
            f"{file.st_ino}-{file.st_mtime_ns}" for file in files)
        for _ in range(10):
            self.lease = socket.socket(socket.AF_UNIX)
            try:
                self.lease.connect("\0" + self.name)
                if self.lease.recv(1):
                    return
            except OSError:
                pass  # there is none, or it is about to end
            self.lease.close()
            self._start_server()
        raise RuntimeError("the fork server does not start")

    def _start_server(self):
        """Returns when it is ready or, as another has the name, has ended. It
        outlives this process, of which it keeps nothing open."""
        server = subprocess.Popen(
            [self.program], cwd="/", stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            start_new_session=True,
            # Symbols are looked up once, not by each copy.
            env={**os.environ, "LD_PRELOAD": self.library, "LD_BIND_NOW": "1",
                 "MORAINE_FORK_SOCKET": self.name})
        server.stdout.readline()
        server.stdout.close()

    def start(self, arguments, folder, out, err):
        """Run with these arguments in a folder, on one process; standard output and
        standard error go to files."""
        with open(out, "w") as to_out, open(err, "w") as to_err:
            begin = _Copy if self.library else subprocess.Popen
            return begin(self.command(arguments), cwd=folder, stdout=to_out,
                         stderr=to_err, stdin=subprocess.DEVNULL,
                         env=self.environment())
