# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs locus to a scratch prefix and builds and runs the project beside this file against it.
# In: locus_build, config, scratch, generator, compiler, flags, version.

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${scratch}") # what an earlier run installed must not hide a missing file
run(${CMAKE_COMMAND} --install "${locus_build}" --config "${config}" --component locus_headers --prefix "${scratch}/prefix")
run(${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}" -B "${scratch}/build" -G "${generator}"
  "-DCMAKE_PREFIX_PATH=${scratch}/prefix" "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_CXX_FLAGS=${flags}"
  "-DCMAKE_BUILD_TYPE=${config}" "-Dlocus_version=${version}" "-DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${scratch}/bin")
run(${CMAKE_COMMAND} --build "${scratch}/build" --config "${config}")
find_program(consumer consumer PATHS "${scratch}/bin" "${scratch}/bin/${config}" NO_DEFAULT_PATH REQUIRED)
run("${consumer}")
