#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What README and manual promise: the README's program is the first example, and links lead to files.
#
#   bash check_docs.sh <root of the tree>
set -euo pipefail
export LC_ALL=C
cd "$1"
faults=0
fault() {
    printf '%s\n' "$*"
    faults=$((faults + 1))
}

# the first cpp block, against the example without its licence line
awk '/^```cpp$/ { inside = 1; next } /^```$/ && inside { exit } inside' README.md |
    diff - <(tail -n +2 examples/01_own_simulator/main.cpp) ||
    fault "README.md: its program is not examples/01_own_simulator/main.cpp"

for page in README.md examples/manual/*.md; do
    while IFS= read -r target; do
        case $target in
        http*) continue ;;
        esac
        if [ ! -e "$(dirname "$page")/${target%%#*}" ]; then fault "$page: no such file: $target"; fi
    done < <(sed '/^```/,/^```/d' "$page" | grep -oE '\]\([^)#][^)]*\)' | sed -E 's/^\]\((.*)\)$/\1/')
done

if [ "$faults" -gt 0 ]; then
    printf '%d fault(s) in README and manual\n' "$faults"
    exit 1
fi
