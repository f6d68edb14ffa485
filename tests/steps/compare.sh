#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# compare.sh REFERENCE COMMAND...: the command prints exactly the reference.

set -euo pipefail
reference=$1
shift
found=$("$@")
diff -u "$reference" - <<<"$found"
