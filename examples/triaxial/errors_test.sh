#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Wrong input must end with exit code 2 and a message that names the option, the value, what is allowed and a way out.
# usage: errors_test.sh PATH_OF_TRIAXIAL
set -u
program=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# refuse CODE TEXT... -- ARGUMENTS...: the program must end with CODE and its stderr must contain every TEXT
refuse() {
    local code=$1 texts=() message status t
    shift
    while [ "$1" != -- ]; do texts+=("$1"); shift; done
    shift
    message=$("$program" "$@" 2>&1 >/dev/null)
    status=$?
    if [ $status != "$code" ]; then
        echo "FAILED: triaxial $*: exit code $status, expected $code: $message"
        failures=$((failures + 1))
    fi
    for t in "${texts[@]}"; do
        case $message in
        *"$t"*) ;;
        *)
            echo "FAILED: triaxial $*: '$t' is not in: $message"
            failures=$((failures + 1))
            ;;
        esac
    done
}

refuse 2 "--confinning: there is no such option" "Did you mean --confining?" -- --confinning 2MPa
refuse 2 "--confining: 1 required STRESS missing" -- --confining
refuse 2 "belongs to an option" -- 2MPa
refuse 2 "--confining: '2e6'" "The unit is missing" "MPa, kPa, Pa, GPa" "Write for example" -- --confining 2e6
refuse 2 "'bar' is not a unit" "MPa, kPa, Pa, GPa" -- --confining 20bar
refuse 2 "--confining: '-2MPa'" "1kPa to 100MPa" -- --confining -2MPa
refuse 2 "--confining: '-2MPa'" "1kPa to 100MPa" -- --confining=-2MPa
refuse 2 "--confining: '0MPa'" -- --confining 0MPa
refuse 2 "--confining: 'nanMPa'" -- --confining nanMPa
refuse 2 "--strain: '80%'" "up to 50%" -- --strain 80%
refuse 2 "--strain: '0'" -- --strain 0
refuse 2 "--scale: '0.22'" "0.23 to 2" "wider than a grain" -- --scale 0.22
refuse 2 "--scale: '0.01'" "0.15 to 2" -- --scale 0.01
refuse 2 "--scale: '9'" "0.15 to 2" -- --scale 9
refuse 2 "--tiles-per-ring: '60'" "a tile would be 9.4 mm wide, a pebble is 12.6 mm" "6 to 44" "--scale 0.81" -- --tiles-per-ring 60
refuse 2 "--tiles-per-ring: '3'" "from 6 to 1000" -- --tiles-per-ring 3
refuse 2 "--rings: '60'" "a tile would be 7.0 mm high, a pebble is 12.6 mm" "1 to 33" -- --rings 60
refuse 2 "--rings: '2.5'" "whole number" -- --rings 2.5
refuse 2 "--rings: '12'" "solid" -- --membrane solid --rings 12
refuse 2 "--shape" "missing.txt" -- --shape missing.txt
printf '0 0 0 1\n0 0 x 1\n' >broken.txt
refuse 2 "broken.txt:2" -- --shape broken.txt
refuse 2 "--shape: '14B:much'" "behind a colon" "14B:0.7,4B:0.3" -- --shape 14B:much
refuse 2 "--shape: '14B:0.7,4B:-1'" -- --shape 14B:0.7,4B:-1
printf '0 0 0 1\n1 0 0 1\n' >overlap.txt
refuse 2 "overlap.txt" "overlap by" "never break" -- --shape overlap.txt
refuse 2 "--grading: " "missing.txt" -- --grading missing.txt
printf '5 0\n10 20\n20 90\n' >short.txt
refuse 2 "--grading: " "short.txt" "from 0 % to 90 %" -- --grading short.txt
printf '5 0\n100 100\n' >coarse.txt
refuse 2 "--grading: 'grains that are 140 mm wide'" "of up to 82 mm at scale 0.6" "--scale 1.03" -- --grading coarse.txt --tiles-per-ring 8 --rings 4
refuse 2 "--packing: " "missing.txt" -- --packing missing.txt
printf '0 0 0 0.02\n' >ball.txt
refuse 2 "--packing: " "ball.txt:1" "orientations" -- --packing ball.txt
refuse 2 "--strength: 'week'" "weak, medium, strong" "43.2MPa" -- --strength week
refuse 2 "--strength: '0MPa'" "1kPa to 1TPa" -- --strength 0MPa
refuse 2 "--grain-size: 'sieve'" "equivalent, circumscribed" -- --grain-size sieve
refuse 2 "--stiffness: 'hertz'" "contact, series" -- --stiffness hertz
refuse 2 "--contact-force: 'sum'" "resultant, single" -- --contact-force sum
refuse 2 "--membrane-stiffness: '3kN/m'" "none with --membrane solid" -- --membrane solid --membrane-stiffness 3kN/m
refuse 2 "--membrane-stiffness: '3kN'" "N/m" -- --membrane-stiffness 3kN
refuse 2 "--weibull: '0'" "1 to 100, or none" -- --weibull 0
refuse 2 "--membrane: 'rubber'" "tiles, rings, solid, rigid" -- --membrane rubber
refuse 2 "--criterion: 'tresca'" "nominal_force" "major_principal" "none" -- --criterion tresca
refuse 2 "--replacement: 'daughters'" "modified, refreezing, rigid_bonded, bonded_from_start, none" -- --replacement daughters
refuse 2 "--birth: 'hot'" "warm, zero" -- --birth hot
refuse 2 "--protocol: 'oedometric'" "triaxial, isotropic, unload" -- --protocol oedometric
refuse 2 "--cycles: '4'" "only with --protocol cyclic" -- --cycles 4
refuse 2 "--membrane: 'tiles'" "box with --protocol true_triaxial" -- --protocol true_triaxial --membrane tiles
refuse 2 "--b: '2'" "0 to 1" -- --protocol true_triaxial --b 2
refuse 2 "--cycle-low-deviator" "below --cycle-deviator" -- --protocol cyclic --cycle-deviator 1kPa
refuse 2 "--until-peak: '10%'" "only with" -- --protocol isotropic --until-peak 10%
refuse 2 "--bond-stiffness: '9.6e8'" "N/m, kN/m, MN/m" "Pa/m" -- --bond-stiffness 9.6e8
refuse 2 "--bond-stiffness: '-1N/m'" "positive" -- --bond-stiffness=-1N/m
refuse 2 "--inertial-number: '1'" "up to 0.1" -- --inertial-number 1
refuse 2 "--friction: '-0.1'" "0 to 10" -- --friction -0.1
refuse 2 "--damping: '1'" "0 to 0.95" -- --damping 1
refuse 2 "--seed: '-1'" "whole number" -- --seed -1
refuse 2 "--threads: 'all'" "0 to 1024" -- --threads all
refuse 2 "--save-every: '0'" "longer than 0" -- --save-every 0
refuse 2 "--save-every: '5days'" "'days' is not a unit" -- --save-every 5days
refuse 2 "--snapshots: '-1'" -- --snapshots -1
refuse 2 "--rows: '0'" -- --rows 0
refuse 2 "--preset: 'article'" "paper" -- --preset article

# folders
touch file
refuse 2 "--out: 'file'" "It is a file" -- --out file --scale 0.25
refuse 2 "--out: '/proc/nothing'" "cannot be created" -- --out /proc/nothing --scale 0.25
refuse 2 "--out: '/sys/kernel'" -- --out /sys/kernel --scale 0.25
mkdir results
echo mine >results/series.csv
refuse 2 "It has series.csv" "--resume results" "--overwrite" -- --out results --scale 0.25
[ "$(cat results/series.csv)" = mine ] || { echo "FAILED: a refused folder was changed"; failures=$((failures + 1)); }

# resume
refuse 2 "--resume: 'nowhere'" "the folder of an earlier run" "arguments.txt" -- --resume nowhere
mkdir run
echo "--scale=0.25" >run/arguments.txt
refuse 2 "--strain" "cannot be changed by --resume" -- --resume run --strain 10%
refuse 2 "checkpoint" "cannot be opened" -- --resume run
echo "not a checkpoint at all" >run/checkpoint.clast
refuse 2 "is not a clast checkpoint" -- --resume run
printf 'clastcp\n' >run/checkpoint.clast
refuse 2 "is truncated" -- --resume run
echo "--scale=big" >run/arguments.txt
refuse 2 "--resume: 'run/arguments.txt' cannot be used" "--scale: 'big'" -- --resume run

# a run that fails has the summary and the figures of what there is, and says why they are unfinished
refuse 3 "overlaps with" "what to change" -- --grain-size circumscribed --stiffness series --scale 0.2 --inertial-number 1e-3 --confining 100MPa --seed 2 --snapshots 0 --quiet --out failed
for text in '"finished": false' '"what": "pebble' '"stages"'; do
    grep -q "$text" failed/summary.json || { echo "FAILED: '$text' is not in the summary of a failed run"; failures=$((failures + 1)); }
done
grep -q unfinished failed/plots/style.gp || { echo "FAILED: the figures of a failed run are not marked"; failures=$((failures + 1)); }

[ $failures = 0 ] && echo "all wrong inputs were refused as they should be"
exit $((failures > 0))
