# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
#
# No picture: the table of doc/topics/contact.md.

/usr/bin/python3 -B "$figures/contact_study.py" "$build/moraine"
