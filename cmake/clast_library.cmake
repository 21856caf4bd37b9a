# SPDX-License-Identifier: MIT
# The two targets that users link: clast::clast (headers) and clast::fast (headers and the flags that kernels like).

file(GLOB_RECURSE CLAST_HEADERS CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/clast/*.hpp")

# A project may bring its own fmt (FetchContent), so search only if it is not there.
if(NOT TARGET fmt::fmt)
    find_package(fmt REQUIRED)
endif()

# for std::thread, a library of its own before glibc 2.34
find_package(Threads REQUIRED)

add_library(clast INTERFACE)
add_library(clast::clast ALIAS clast)
target_sources(clast INTERFACE FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/include" FILES ${CLAST_HEADERS})
# not where a project has all its headers compiled alone: clast/eigen.hpp needs Eigen, which only its users link
set_target_properties(clast PROPERTIES VERIFY_INTERFACE_HEADER_SETS OFF)
target_compile_features(clast INTERFACE cxx_std_20)
target_link_libraries(clast INTERFACE fmt::fmt Threads::Threads)

add_library(clast_fast INTERFACE)
add_library(clast::fast ALIAS clast_fast)
set_target_properties(clast_fast PROPERTIES EXPORT_NAME fast)
target_link_libraries(clast_fast INTERFACE clast)
set(gnu_like "$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>")
# Kernels call sqrt in their inner loops: without errno and trapping semantics these vectorise, and no result changes.
# `omp simd` needs no runtime library; it makes compilers vectorise the loops over strips at -O2, too.
target_compile_options(clast_fast INTERFACE "$<${gnu_like}:-fno-math-errno;-fno-trapping-math;-fopenmp-simd>")
target_compile_definitions(clast_fast INTERFACE "$<${gnu_like}:CLAST_OPENMP_SIMD>")
# These two belong to one build: an installed clast::fast must not carry the processor of the machine that packed it.
if(CLAST_NATIVE)
    target_compile_options(clast_fast INTERFACE "$<BUILD_INTERFACE:$<${gnu_like}:-march=native>>")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # Kernels ask the processor for wider registers when they run; those with fused multiply-add shall not use it, so that
    # the bits are the same on every processor. (No other code of such a build has it.)
    target_compile_options(clast_fast INTERFACE "$<${gnu_like}:-ffp-contract=off>")
endif()
if(CLAST_PORTABLE_BITS)
    target_compile_options(clast_fast INTERFACE "$<BUILD_INTERFACE:$<${gnu_like}:-ffp-contract=off>>")
    # GCC 12 fuses all the same where it packs straight code into vectors: vfmaddsub in products of quaternions
    target_compile_options(clast_fast
                           INTERFACE "$<BUILD_INTERFACE:$<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-tree-slp-vectorize>>")
endif()
