# SPDX-License-Identifier: MIT
# cmake -Dway=find_package|add_subdirectory ... -P check.cmake: installs clast if need be, then configures, builds and
# runs the project, whose program is the first example (and the one that the README shows).
function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${way}: ${what} failed (${result}):\n${output}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

# from scratch, or a header that is gone would still be found
file(REMOVE_RECURSE "${scratch}")
file(MAKE_DIRECTORY "${scratch}")
file(COPY "${project}/CMakeLists.txt" "${clast_source}/examples/01_own_simulator/main.cpp" DESTINATION "${scratch}/project")
set(options "")
if(way STREQUAL "find_package")
    run("install" "${CMAKE_COMMAND}" --install "${clast_build}" --prefix "${scratch}/prefix")
    list(PREPEND prefix_path "${scratch}/prefix")
    list(APPEND options "-Dclast_version=${clast_version}")
else()
    list(APPEND options "-Dclast_source=${clast_source}")
endif()
string(REPLACE ";" "\\;" prefix_path "${prefix_path}")
run("configure" "${CMAKE_COMMAND}" -S "${scratch}/project" -B "${scratch}/build" -G "${generator}"
    "-DCMAKE_CXX_COMPILER=${compiler}" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=${prefix_path}" ${options})
run("build" "${CMAKE_COMMAND}" --build "${scratch}/build")
foreach(program plain fast)
    run("${program} program" "${scratch}/build/${program}")
    if(NOT output MATCHES "eps_a +1\\.00 % +q +[1-9]")
        message(FATAL_ERROR "${way}: the ${program} program does not end with a row at 1 % strain:\n${output}")
    endif()
endforeach()
