#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests check_tree.sh on a small tree: silent when the tree is sound, and one complaint for each fault put in.
set -euo pipefail
check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)/check_tree.sh
tree=$(mktemp -d "${TMPDIR:-/tmp}/clast_tree.XXXXXX")
trap 'rm -rf "$tree"' EXIT
licence='// SPDX-License-Identifier: MIT'

make_sound_tree() {
    rm -rf "$tree/root"
    mkdir -p "$tree/root/include/clast/core/detail" "$tree/root/tests/core"
    cd "$tree/root"
    printf '%s\n#pragma once\n' "$licence" | tee include/clast/clast.hpp include/clast/core/fwd.hpp \
        include/clast/core/a.hpp >include/clast/core/detail/b.hpp
    printf '%s\n// see https://example.org/home/page\nTEST_CASE("a", "[tag]") {}\n' "$licence" >tests/core/a.cpp
    printf 'core/a.cpp\n' >../built.txt
}

expect() { # expect <complaint, or nothing for a sound tree>
    local output status=0
    output=$(bash "$check" "$tree/root" "$tree/built.txt" 2>&1) || status=$?
    if [ -z "$1" ]; then
        if [ "$status" -ne 0 ] || [ -n "$output" ]; then printf 'a sound tree is blamed:\n%s\n' "$output" && exit 1; fi
    elif [ "$status" -ne 1 ] || ! grep -Fq -- "$1" <<<"$output"; then
        printf 'not found: "%s" (status %d); found:\n%s\n' "$1" "$status" "$output" && exit 1
    fi
}

make_sound_tree
expect ""
printf '%s\n#pragma once\n' "$licence" >include/clast/core/c.hpp
expect "include/clast/core/c.hpp: no test"
make_sound_tree
printf '%s\n#pragma once\n' "$licence" >include/clast/d.hpp
expect "include/clast/d.hpp: no test (tests/d.cpp)"
make_sound_tree
: >"$tree/built.txt"
expect "tests/core/a.cpp: in no test program"
make_sound_tree
printf '%s\n' "$licence" >tests/core/a.cpp
expect "tests/core/a.cpp: no TEST_CASE"
make_sound_tree
printf '%s\nTEST_CASE(\n"lies in [0, 1)", "[a]") {}\n' "$licence" >tests/core/a.cpp
expect "tests/core/a.cpp: name of a TEST_CASE"
make_sound_tree
printf '#pragma once\n' >include/clast/core/a.hpp
expect "include/clast/core/a.hpp: no licence"
make_sound_tree
printf '%s\n' "$licence" >include/clast/core/a.hpp
expect "include/clast/core/a.hpp: no #pragma once"
make_sound_tree
printf '#include "/%s/me/x.hpp"\n' home >>tests/core/a.cpp
expect "path of one machine"
make_sound_tree
printf '// TO''DO\n' >>tests/core/a.cpp
expect "unfinished"
