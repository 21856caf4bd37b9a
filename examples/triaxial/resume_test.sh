#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A toy test whose grains break, whole and in pieces: stopped in every stage and resumed with another number of threads,
# it must write the same tables and end in the same state.
# usage: resume_test.sh PATH_OF_TRIAXIAL SCRATCH_DIRECTORY
set -eu
program=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
cd "$2"
# a coarse toy under a high pressure: the weakest of its few grains break in consolidation and in shear
arguments=(--scale 0.25 --strain 1% --confining 4MPa --weibull 2 --inertial-number 1e-3 --snapshots 2 --no-plots --quiet)

"$program" "${arguments[@]}" --threads 1 --out whole
test "$(wc -l <whole/series.csv)" -gt 20
test "$(wc -l <whole/events.csv)" -gt 1 || { echo "FAILED: no bond broke, so the test shows nothing of breakage"; exit 1; }

last=$(tail -n 1 whole/series.csv | cut -d, -f "$(head -n 1 whole/series.csv | tr , '\n' | grep -n '^steps$' | cut -d: -f 1)")
"$program" "${arguments[@]}" --threads 1 --out pieces --stop-after $((last / 10))
for part in 3 6 8 9; do
    "$program" --resume pieces --threads $((part % 3 + 1)) --stop-after $((last * part / 10))
done
"$program" --resume pieces --threads 2

# all columns but the computer time
clock=$(head -n 1 whole/series.csv | tr , '\n' | grep -n '^wall_time_s$' | cut -d: -f 1)
for run in whole pieces; do cut -d, -f "$clock" --complement "$run/series.csv" >"$run.csv"; done
cmp whole.csv pieces.csv
cmp whole/events.csv pieces/events.csv
checksum() { grep final_state_checksum "$1/summary.json"; }
test -n "$(checksum whole)"
test "$(checksum whole)" = "$(checksum pieces)" || { checksum whole; checksum pieces; exit 1; }

# a path whose drives follow the specimen: stopped in the middle of it
for path in "undrained --strain 1%" "constant_p --strain 1%" "cyclic --strain 2% --cycles 2 --cycle-strain 0.5%"; do
    name=${path%% *}
    # shellcheck disable=SC2086
    path_arguments=(--protocol $path --grain-size circumscribed --scale 0.2 --confining 1MPa --inertial-number 1e-3 --replacement none --snapshots 0 --no-plots --quiet)
    "$program" "${path_arguments[@]}" --threads 1 --out "$name" >"$name.log"
    steps() { tail -n 1 "$name/series.csv" | cut -d, -f "$(head -n 1 "$name/series.csv" | tr , '\n' | grep -n '^steps$' | cut -d: -f 1)"; }
    first() { grep -m 1 ',shear,' "$name/series.csv" | cut -d, -f "$(head -n 1 "$name/series.csv" | tr , '\n' | grep -n '^steps$' | cut -d: -f 1)"; }
    "$program" "${path_arguments[@]}" --threads 1 --out "$name-pieces" --stop-after $((($(steps) + $(first)) / 2)) >"$name.log"
    "$program" --resume "$name-pieces" --threads 2 >"$name.log"
    test "$(checksum "$name")" = "$(checksum "$name-pieces")" || { checksum "$name"; checksum "$name-pieces"; exit 1; }
done
echo "the same bits in one piece and in several"
