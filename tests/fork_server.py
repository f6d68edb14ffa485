# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Starts the program on one process: as a copy of one that stands ready, its
libraries loaded, if MORAINE_FORK_SERVER names the library of fork_server.cc, as
ctest says; else anew."""

import atexit
import os
import select
import signal
import struct
import subprocess


class _Copy:
    """A run that the server began, with what is used of subprocess.Popen."""

    def __init__(self, server):
        self.server = server
        self.pid = self._number()

    def wait(self, timeout=None):
        if not select.select([self.server.stdout], [], [], timeout)[0]:
            raise subprocess.TimeoutExpired(self.server.args, timeout)
        self.returncode = self._number()
        return self.returncode

    def kill(self):
        try:
            os.kill(self.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass  # it has just ended

    def _number(self):
        line = self.server.stdout.readline()
        if not line:
            raise RuntimeError("the fork server has ended")
        return int(line)


class Starter:
    """One run at a time: each must be waited for before the next."""

    def __init__(self, program):
        self.program = str(program)
        self.library = os.environ.get("MORAINE_FORK_SERVER")
        self.server = None

    def start(self, arguments, folder, out, err):
        """Run with these arguments in a folder; standard output and standard error
        go to files."""
        words = [self.program, *map(str, arguments)]
        if not self.library:
            with open(out, "w") as to_out, open(err, "w") as to_err:
                return subprocess.Popen(words, cwd=folder, stdout=to_out,
                                        stderr=to_err, stdin=subprocess.DEVNULL)
        if not self.server:
            self.server = subprocess.Popen(
                [self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                bufsize=0, env={**os.environ, "LD_PRELOAD": self.library})
            atexit.register(self._end)
        request = b"".join(os.fsencode(word) + b"\0"
                           for word in [folder, out, err, *words])
        self.server.stdin.write(struct.pack("=I", len(request)) + request)
        return _Copy(self.server)

    def _end(self):
        self.server.stdin.close()
        self.server.wait()
