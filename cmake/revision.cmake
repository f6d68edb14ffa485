# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

# cmake -DSOURCE=... -DFILE=... -P revision.cmake: writes the source file that
# knows the revision, if it is another one than the file there says.
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE revision
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(revision STREQUAL "")
  set(revision unknown)
endif()
set(text
    "#include <moraine/core/version.h>\n\nconst char *const moraine::revision = \"${revision}\";\n")
set(there "")
if(EXISTS ${FILE})
  file(READ ${FILE} there)
endif()
if(NOT there STREQUAL text)
  file(WRITE ${FILE} "${text}")
endif()
