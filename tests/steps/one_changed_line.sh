#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# one_changed_line.sh STEPS: step-2 is step-1 but for the one line it is about.

set -uo pipefail
found=$(diff "$1/step-1/step-1.cc" "$1/step-2/step-2.cc" | grep '^[<>]')
expected='< constexpr MeshAfterStep after_step = MeshAfterStep::follow_material;
> constexpr MeshAfterStep after_step = MeshAfterStep::reset;'
diff <(echo "$expected") <(echo "$found")
