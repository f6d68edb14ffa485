# ranks: 1  # debug: no
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
"""A run that the system refuses memory ends with one line and a summary."""

import json
import resource
import subprocess

limit = 600 * 2**20
done = subprocess.run(
    [str(program), "run", str(root / "prm/cortis-2017/footing.prm"),
     "--set", "Mesh/Cells = 600,600", "--set", "Mesh/Cell size = 0",
     "--output", str(folder / "refused")],
    capture_output=True, text=True,
    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
text("exit code", done.returncode)
text("message", done.stderr.strip().splitlines()[-1])
summary = json.loads((folder / "refused/summary.json").read_text())
text("status", summary["status"])
text("message in summary.json", summary["message"].split(":")[0])
