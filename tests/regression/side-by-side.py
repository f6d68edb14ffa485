# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""Runs on one process at the same time share nothing, above all no session
directory of Open MPI, which the first that ends would remove."""

import os
import subprocess
from concurrent.futures import ThreadPoolExecutor

clean = {key: value for key, value in os.environ.items()
         if not key.startswith(("OMPI_MCA_", "LD_PRELOAD"))}


def check(_=None, **variables):
    return subprocess.run(
        [program, "check", root / "tests/bad-input/base.prm"],
        env={**clean, **variables}, capture_output=True).returncode


# Where there can be none: below a file.
(folder / "file").touch()
text("without a session directory",
     check(OMPI_MCA_orte_tmpdir_base=str(folder / "file")))
(folder / "tmp").mkdir()
with ThreadPoolExecutor(8) as pool:
    codes = list(pool.map(lambda _: check(TMPDIR=str(folder / "tmp")), range(40)))
text("40 runs, 8 at a time, that failed", sum(code != 0 for code in codes))
text("left behind", os.listdir(folder / "tmp"))
