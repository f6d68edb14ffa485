# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Starts the program: as copies of one that stands ready, its libraries loaded, if
MORAINE_FORK_SERVER and MORAINE_FORK_CLIENT name what comes of fork_server.cc and
fork_client.cc, as ctest says; else anew."""

import atexit
import os
import signal
import subprocess
import uuid


class _Copy(subprocess.Popen):
    """What stands in for a run hands on every signal but SIGKILL, for which
    SIGUSR2 stands."""

    def kill(self):
        self.send_signal(signal.SIGUSR2)


class Starter:
    def __init__(self, program):
        self.program = str(program)
        self.library = os.environ.get("MORAINE_FORK_SERVER")
        self.server = None

    def command(self, arguments, ranks=1, mpirun=("mpirun", "-q")):
        """What to start, with environment()."""
        client = [os.environ["MORAINE_FORK_CLIENT"]] if self.library else []
        launcher = [*mpirun, "-n", str(ranks)] if ranks > 1 else []
        return [*launcher, *client, self.program, *map(str, arguments)]

    def environment(self):
        if not self.library:
            return None
        if not self.server:
            self.socket = f"moraine-{uuid.uuid4()}"
            self.server = subprocess.Popen(
                [self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                start_new_session=True,  # Ctrl-C is for the runs
                # Symbols are looked up once, not by each copy.
                env={**os.environ, "LD_PRELOAD": self.library,
                     "LD_BIND_NOW": "1", "MORAINE_FORK_SOCKET": self.socket})
            atexit.register(self._end)
            if self.server.stdout.readline() != b"ready\n":
                raise RuntimeError("the fork server does not start")
        return {**os.environ, "MORAINE_FORK_SOCKET": self.socket}

    def start(self, arguments, folder, out, err):
        """Run with these arguments in a folder, on one process; standard output and
        standard error go to files."""
        with open(out, "w") as to_out, open(err, "w") as to_err:
            begin = _Copy if self.library else subprocess.Popen
            return begin(self.command(arguments), cwd=folder, stdout=to_out,
                         stderr=to_err, stdin=subprocess.DEVNULL,
                         env=self.environment())

    def _end(self):
        self.server.stdin.close()
        self.server.wait()
