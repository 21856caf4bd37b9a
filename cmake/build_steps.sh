# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# The steps that examples/run and tests/run share; sourced by them. They set clast_root.
#
#   clast_prepare <preset> <build directory> <group of dependencies> [cmake --build arguments]
#
# installs what is missing, configures and builds. One line per phase; the rest goes to logs that are shown on failure.

# shellcheck source=cmake/install_dependencies.sh
source "$clast_root/cmake/install_dependencies.sh"

# As many jobs as cores, but at most one for each 1.5 GB of memory: template-heavy files need about that.
clast_jobs() {
    local cores memory
    cores=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
    memory=$(awk '/^MemTotal:/ { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null || true)
    if [ -n "$memory" ] && [ "$memory" -lt "$cores" ]; then cores=$memory; fi
    if [ "$cores" -lt 1 ]; then cores=1; fi
    echo "$cores"
}

# clast_step <phase> <log> <command>...: a line when it starts, its time when it ends, the log when it fails.
clast_step() {
    local phase=$1 log=$2 start=$SECONDS status=0 line
    shift 2
    printf 'clast: %s ...' "$phase"
    if [ -t 1 ]; then
        # "[12/40]" of Ninja or "[ 30%]" of make, shown in place
        "$@" </dev/null 2>&1 | tee "$log" | while IFS= read -r line; do
            if [[ $line =~ ^(\[[0-9\ /%]+\]) ]]; then printf '\rclast: %s ... %s ' "$phase" "${BASH_REMATCH[1]}"; fi
        done || status=${PIPESTATUS[0]}
    else
        "$@" </dev/null >"$log" 2>&1 || status=$?
    fi
    if [ "$status" -ne 0 ]; then
        printf ' failed\n'
        tail -n 100 "$log"
        clast_say "$phase failed; whole log: $log"
        return "$status"
    fi
    printf ' %d s\n' $((SECONDS - start))
}

clast_cached() { sed -n "s/^$1:[A-Z]*=//p" "$2/CMakeCache.txt" 2>/dev/null; }

clast_prepare() {
    local preset=$1 build=$2 group=$3
    shift 3
    mkdir -p "$build"
    # Two runs that start together must not build in the same place at the same time.
    if clast_has_command flock; then
        exec 9>"$build/.lock"
        if ! flock -n 9; then
            clast_say "waiting for another build in $build"
            flock 9
        fi
    fi
    clast_install_dependencies "$build/install.log" "$group" || return $?

    if [ -z "${CMAKE_GENERATOR:-}" ]; then
        if clast_has_command ninja; then export CMAKE_GENERATOR=Ninja; else export CMAKE_GENERATOR="Unix Makefiles"; fi
    fi
    # A build directory that was moved here, or made with another tool, is of no use.
    local fresh=""
    if [ -f "$build/CMakeCache.txt" ] && { [ "$(clast_cached CMAKE_GENERATOR "$build")" != "$CMAKE_GENERATOR" ] ||
        [ "$(clast_cached CMAKE_CACHEFILE_DIR "$build")" != "$build" ] ||
        [ "$(clast_cached CMAKE_HOME_DIRECTORY "$build")" != "$clast_root" ]; }; then
        fresh=--fresh
    fi
    clast_step configuring "$build/configure.log" \
        cmake ${fresh:+"$fresh"} -S "$clast_root" --preset "$preset" -B "$build" || return $?
    clast_step building "$build/build.log" cmake --build "$build" --parallel "$(clast_jobs)" "$@"
}
