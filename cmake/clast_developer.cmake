# SPDX-License-Identifier: MIT
# Warnings, sanitizers and the compiler cache: for our own programs and tests, never for the library targets.

option(CLAST_WARNINGS_AS_ERRORS "Stop at the first warning" OFF)
option(CLAST_CCACHE "Use ccache where it is installed" ON)
set(CLAST_SANITIZE "" CACHE STRING "Sanitizers, as a list: address;undefined or thread")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Kind of build" FORCE)
endif()
if(CLAST_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    find_program(CLAST_CCACHE_PROGRAM ccache)
    if(CLAST_CCACHE_PROGRAM)
        set(CMAKE_CXX_COMPILER_LAUNCHER "${CLAST_CCACHE_PROGRAM}")
    endif()
endif()
set(CMAKE_CXX_EXTENSIONS OFF)

add_library(clast_developer INTERFACE)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(clast_developer INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
        # false alarms: "text" + std::string inside libstdc++ (GCC bug 105651), and the compiler's own vector headers
        # under -march=native (GCC bug 105593)
        target_compile_options(clast_developer INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
    endif()
    if(CLAST_WARNINGS_AS_ERRORS)
        target_compile_options(clast_developer INTERFACE -Werror)
    endif()
    if(CLAST_SANITIZE)
        list(JOIN CLAST_SANITIZE "," sanitizers)
        target_compile_options(clast_developer INTERFACE -fsanitize=${sanitizers} -fno-sanitize-recover=all
                                                         -fno-omit-frame-pointer -g)
        target_link_options(clast_developer INTERFACE -fsanitize=${sanitizers})
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            # GCC warns of its own instrumentation, as its manual says of -fsanitize
            target_compile_options(clast_developer INTERFACE -Wno-maybe-uninitialized)
        endif()
    endif()
endif()
