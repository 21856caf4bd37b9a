#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# One specimen for several tests: prepared by one run and handed over to another, a test must write the rows and end with
# the bits of one that prepares it itself; and it must stand in another membrane, under another stress.
# usage: from_test.sh PATH_OF_TRIAXIAL SCRATCH_DIRECTORY
set -eu
program=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
cd "$2"
grains=(--shape 4B --grain-size circumscribed --scale 0.2 --porosity 0.6 --seed 3)
run=(--inertial-number 1e-3 --snapshots 0 --no-plots --quiet --threads 1)

"$program" "${grains[@]}" "${run[@]}" --protocol isotropic --out whole >log
"$program" "${grains[@]}" "${run[@]}" --protocol prepare --replacement none --out prepared >log
"$program" "${run[@]}" --protocol isotropic --from prepared --out second >log
rm -r prepared/vtk prepared/series.csv prepared/checkpoint.clast # only what --from names is needed
"$program" "${run[@]}" --protocol isotropic --from prepared --confining 1MPa --membrane solid --out other >log

cmp whole/packing.csv prepared/packing.csv # to the last digit
cmp whole/packing.csv second/packing.csv
cmp whole/packing.csv other/packing.csv
clock=$(head -n 1 whole/series.csv | tr , '\n' | grep -n '^wall_time_s$' | cut -d: -f 1)
stage=$(head -n 1 whole/series.csv | tr , '\n' | grep -n '^stage$' | cut -d: -f 1)
for one in whole second; do
    awk -F, -v s="$stage" '$s == "consolidate"' "$one/series.csv" | cut -d, -f "$clock" --complement >"$one.csv"
done
test "$(wc -l <second.csv)" -gt 3
cmp whole.csv second.csv
checksum() { grep final_state_checksum "$1/summary.json"; }
test "$(checksum whole)" = "$(checksum second)" || { checksum whole; checksum second; exit 1; }
# the state at rest is told by all of them
at_rest() { tr -d ' \n' <"$1/summary.json" | grep -o '"at_rest":{[^}]*}'; }
test "$(at_rest whole)" = "$(at_rest other)" || { at_rest whole; at_rest other; exit 1; }

# what the specimen says is not asked again, and not contradicted
refused() {
    if "$program" "${run[@]}" --protocol isotropic --from prepared --out refused "$@" 2>message; then exit 1; fi
    grep -q -- "$1" message || { cat message; exit 1; }
}
refused --shape 14B
refused --scale 0.3
refused --porosity 0.55
refused --seed 4
"$program" "${run[@]}" --protocol isotropic --from prepared --scale 0.20 --seed 3 --out same >log # the same may be said again
"$program" "${run[@]}" --protocol isotropic --from prepared --out pieces --stop-after 40000 >log
mv prepared gone # a run that goes on has its own copy
"$program" --resume pieces --threads 1 >log
test "$(checksum whole)" = "$(checksum pieces)" || { checksum whole; checksum pieces; exit 1; }
echo "the same specimen in one run and in two"
