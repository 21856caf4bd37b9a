#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing to build clast, and only that.
#
#   bash cmake/install_dependencies.sh [run] [test] [benchmark]
#
# With apt-get and the right to use it, missing packages are installed; otherwise they are named. Either way the last
# word has what is really there: compilers, tools and headers are looked for themselves, not the packages of one
# distribution, so a hand-made installation is as good. Exit code 2: something necessary is still missing.

clast_say() { printf 'clast: %s\n' "$*"; }

# Where compilers and users keep headers, one directory per line.
clast_include_directories() {
    printf '%s\n' /usr/include /usr/local/include /opt/homebrew/include /opt/local/include
    local list
    for list in "${CPATH:-}" "${CPLUS_INCLUDE_PATH:-}"; do
        if [ -n "$list" ]; then tr ':' '\n' <<<"$list"; fi
    done
    for list in "${CMAKE_PREFIX_PATH:-}" "${CONDA_PREFIX:-}"; do
        if [ -n "$list" ]; then tr ':;' '\n\n' <<<"$list" | sed 's|/*$|/include|'; fi
    done
}

clast_has_header() { # one of the names is enough
    local directory name
    while IFS= read -r directory; do
        for name in "$@"; do
            if [ -n "$directory" ] && [ -f "$directory/$name" ]; then return 0; fi
        done
    done < <(clast_include_directories)
    return 1
}

clast_has_command() { command -v "$1" >/dev/null 2>&1; }

clast_has_compiler() {
    local compiler
    for compiler in ${CXX:-c++ g++ clang++}; do
        if clast_has_command "$compiler" &&
            printf '#include <concepts>\n#include <span>\ntemplate <std::integral T> T f(T x) { return x; }\n' |
            "$compiler" -std=c++20 -fsyntax-only -x c++ - >/dev/null 2>&1; then
            return 0
        fi
        # with CXX unset CMake takes the first that exists, so a later one would not help
        if clast_has_command "$compiler"; then return 1; fi
    done
    return 1
}

clast_has_cmake() {
    local version major minor
    version=$(cmake --version 2>/dev/null </dev/null | sed -n 's/^cmake version \([0-9]*\.[0-9]*\).*/\1/p')
    major=${version%%.*}
    minor=${version#*.}
    [ -n "$version" ] && { [ "$major" -gt 3 ] || { [ "$major" -eq 3 ] && [ "$minor" -ge 25 ]; }; }
}

clast_has_build_tool() { clast_has_command ninja || clast_has_command make; }

# Prints "package|necessity|what for" for each thing that the groups need and that is not there.
clast_missing() {
    local group
    clast_has_compiler || echo "g++|needed|a C++20 compiler (GCC 12 or Clang 16 are tested)"
    clast_has_cmake || echo "cmake|needed|CMake 3.25 or newer"
    clast_has_build_tool || echo "ninja-build|needed|Ninja (or make)"
    clast_has_header fmt/format.h || echo "libfmt-dev|needed|fmt, text"
    for group in "$@"; do
        case $group in
        run | test)
            clast_has_header CLI/CLI.hpp || echo "libcli11-dev|needed|CLI11, options of the triaxial program"
            clast_has_header nlohmann/json.hpp || echo "nlohmann-json3-dev|needed|JSON, summary of the triaxial program"
            clast_has_command gnuplot || echo "gnuplot-nox|wanted|gnuplot, plots (without it the data are still written)"
            ;;
        esac
        case $group in
        test)
            clast_has_header catch2/catch_all.hpp catch2/catch.hpp || echo "catch2|needed|Catch2, tests"
            clast_has_header Eigen/Core eigen3/Eigen/Core || echo "libeigen3-dev|needed|Eigen, tests and clast/eigen.hpp"
            ;;
        esac
        case $group in
        test | benchmark)
            clast_has_header benchmark/benchmark.h || echo "libbenchmark-dev|needed|Google Benchmark, kernels"
            ;;
        esac
    done
}

# Runs a command with the rights to install, if we can have them.
clast_as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@" </dev/null
    elif clast_has_command sudo && sudo -n true 2>/dev/null </dev/null; then
        sudo -n "$@" </dev/null
    elif clast_has_command sudo && [ -t 0 ] && [ -t 2 ] && [ -z "${CI:-}" ]; then
        sudo "$@" # asks for the password on the terminal
    else
        return 126
    fi
}

clast_apt() {
    clast_as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=120 -o Acquire::Retries=3 "$@"
}

# clast_install_dependencies <log file> <group>...
clast_install_dependencies() {
    local log=$1 missing packages package
    shift
    missing=$(clast_missing "$@")
    if [ -z "$missing" ]; then return 0; fi
    packages=$(cut -d '|' -f 1 <<<"$missing" | sort -u | tr '\n' ' ')

    if ! clast_has_command apt-get; then
        clast_say "missing (Debian names, install them by your own package manager): $packages"
    elif ! clast_as_root true; then
        clast_say "missing, and no right to install: $packages"
    else
        clast_say "installing $packages"
        # an update that fails for one source may still serve the others, so go on
        clast_apt update >>"$log" 2>&1 || true
        # shellcheck disable=SC2086 # one word per package
        if ! clast_apt install --yes --no-install-recommends $packages >>"$log" 2>&1; then
            for package in $packages; do # what one package lacks must not hold up the others
                clast_apt install --yes --no-install-recommends "$package" >>"$log" 2>&1 || true
            done
        fi
        hash -r
        missing=$(clast_missing "$@")
        if [ -z "$missing" ]; then return 0; fi
        clast_say "apt-get could not provide everything (log: $log)"
    fi

    local fatal=0 necessity purpose
    while IFS='|' read -r package necessity purpose; do
        clast_say "  $necessity: $purpose [package $package]"
        if [ "$necessity" = needed ]; then fatal=1; fi
    done <<<"$missing"
    if [ "$fatal" -eq 1 ]; then
        clast_say "cannot go on without what is needed. On Debian or Ubuntu, as root: apt-get install $packages"
        clast_say "Elsewhere put headers into a default include directory or name the prefix in CMAKE_PREFIX_PATH."
        return 2
    fi
    return 0
}

if [ "${BASH_SOURCE[0]}" = "$0" ]; then
    set -euo pipefail
    for group in "$@"; do
        case $group in
        run | test | benchmark) ;;
        *)
            echo "usage: bash cmake/install_dependencies.sh [run] [test] [benchmark]" >&2
            exit 2
            ;;
        esac
    done
    if [ $# -eq 0 ]; then set -- run test; fi
    log=$(mktemp "${TMPDIR:-/tmp}/clast_install.XXXXXX")
    clast_install_dependencies "$log" "$@" || { status=$?; tail -n 20 "$log" >&2; exit "$status"; }
    rm -f "$log"
    clast_say "all there"
fi
