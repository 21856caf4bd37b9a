# SPDX-License-Identifier: MIT
# cmake -Dway=find_package|add_subdirectory ... -P check.cmake: installs clast if need be, then configures, builds and
# runs the project.
function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${way}: ${what} failed (${result}):\n${output}")
    endif()
endfunction()

# from scratch, or a header that is gone would still be found
file(REMOVE_RECURSE "${scratch}")
file(MAKE_DIRECTORY "${scratch}")
set(options "")
if(way STREQUAL "find_package")
    run("install" "${CMAKE_COMMAND}" --install "${clast_build}" --prefix "${scratch}/prefix")
    list(PREPEND prefix_path "${scratch}/prefix")
    list(APPEND options "-Dclast_version=${clast_version}")
else()
    list(APPEND options "-Dclast_source=${clast_source}")
endif()
string(REPLACE ";" "\\;" prefix_path "${prefix_path}")
run("configure" "${CMAKE_COMMAND}" -S "${project}" -B "${scratch}/build" -G "${generator}"
    "-DCMAKE_CXX_COMPILER=${compiler}" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=${prefix_path}" ${options})
run("build" "${CMAKE_COMMAND}" --build "${scratch}/build")
run("plain program" "${scratch}/build/plain")
run("fast program" "${scratch}/build/fast")
