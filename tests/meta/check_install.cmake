# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors

# Install, then configure, build and run the consumer against the installation.

file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})
function(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status
                  OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${text}\nfailed: ${ARGN}")
  endif()
  set(output "${text}" PARENT_SCOPE)
endfunction()

step(${CMAKE_COMMAND} --install ${build} --prefix ${work}/prefix)
step(${work}/prefix/bin/moraine --version)
set(scenes ${work}/prefix/share/moraine/prm)
step(${work}/prefix/bin/moraine check ${scenes}/cortis-2017/block-30.prm)
step(${work}/prefix/bin/moraine check ${scenes}/verification/mesh-quads.prm)
foreach(file LICENSE README.md CITATION.cff doc/parameters.md
        doc/figures/footing.png)
  if(NOT EXISTS ${work}/prefix/share/doc/moraine/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
step(${CMAKE_COMMAND} -S ${consumer} -B ${work}/build -G ${generator} -D
     CMAKE_BUILD_TYPE=${type} -D CMAKE_PREFIX_PATH=${work}/prefix)
step(${CMAKE_COMMAND} --build ${work}/build)
step(${work}/build/consumer)
if(NOT output MATCHES "twice 21 is 42")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()
