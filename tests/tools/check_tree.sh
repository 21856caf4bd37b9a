#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Rules of the source tree that no compiler checks.
#
#   bash check_tree.sh <root of the tree> <file with the test sources that are built, relative to tests/>
#
# Prints every fault and ends with 1 if there is one.
set -euo pipefail
export LC_ALL=C
root=$1
built=$2
cd "$root"
faults=0
fault() {
    printf '%s\n' "$*"
    faults=$((faults + 1))
}

# A header of the interface has its test at the same path.
while IFS= read -r header; do
    path=${header#include/clast/}
    case $path in
    */detail/* | clast.hpp | version.hpp | fwd.hpp | */fwd.hpp | */concepts.hpp | */none.hpp) continue ;;
    esac
    if [ ! -f "tests/${path%.hpp}.cpp" ]; then fault "$header: no test (tests/${path%.hpp}.cpp)"; fi
done < <(find include/clast -name '*.hpp' | sort)

# A test that is not built tests nothing.
while IFS= read -r source; do
    path=${source#tests/}
    case $path in
    compile_fail/* | compilers/* | consumer/* | digests/* | headers/* | tools/*) continue ;; # built by their own rules
    esac
    if ! grep -Fqx -- "$path" "$built"; then fault "$source: in no test program"; fi
    if ! grep -q 'TEST_CASE' "$source"; then fault "$source: no TEST_CASE"; fi
    # CMake splits lists at semicolons outside brackets, so such a name would hide its neighbours from ctest.
    if grep -qzE 'TEST_CASE\([[:space:]]*"[^"]*[][;\\]' "$source"; then
        fault "$source: name of a TEST_CASE with one of [ ] ; \\"
    fi
done < <(find tests -name '*.cpp' | sort)

# benchmarks/peers/work holds what those programs write; it is not part of the tree.
sources() {
    find .ci CMakeLists.txt CMakePresets.json cmake include tests examples benchmarks docs README.md \
        -path benchmarks/peers/work -prune -o -type f -print 2>/dev/null | sort
}

while IFS= read -r file; do
    case $file in
    *.hpp)
        if [ "$(head -n 1 "$file")" != "// SPDX-License-Identifier: MIT" ]; then fault "$file: no licence in line 1"; fi
        if ! grep -q '^#pragma once' "$file"; then fault "$file: no #pragma once"; fi
        ;;
    *.cpp)
        if [ "$(head -n 1 "$file")" != "// SPDX-License-Identifier: MIT" ]; then fault "$file: no licence in line 1"; fi
        ;;
    esac
    # Paths of one machine; an address such as https://x/home/ is none.
    while IFS= read -r line; do fault "$file:$line: path of one machine"; done \
        < <(grep -nIE '(^|[^A-Za-z0-9_.-])/(work|home|root|Users)/' "$file" || true)
    # Unfinished work belongs into the issue tracker. (Words split, or this script would find itself.)
    while IFS= read -r line; do fault "$file:$line: unfinished"; done \
        < <(grep -nIwE 'TO''DO|FIX''ME' "$file" || true)
done < <(sources)

if [ "$faults" -gt 0 ]; then
    printf '%d fault(s) in the tree\n' "$faults"
    exit 1
fi
