#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Rebuilds LAMMPS and LIGGGHTS from the sources of their Debian packages for this very machine, with what the scenes need
# alone and without MPI: native.sh [lammps] [liggghts]. Results: work/native/lammps/lmp and work/native/liggghts/liggghts,
# which `run --native` takes. Needs cmake, g++, Debian's apt, and half a gigabyte; leaves the system as it is.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
work=$here/work/native
flags="-O3 -march=native -DNDEBUG"
jobs=$(nproc)

# a list of packages of our own: deb-src need not be switched on
lists=$work/apt
source_of() {
    rm -rf "${work:?}/$1"
    mkdir -p "$lists/lists/partial" "$work/$1/source"
    cat >"$lists/debian.sources" <<END
Types: deb-src
URIs: http://deb.debian.org/debian
Suites: $(. /etc/os-release && echo "$VERSION_CODENAME")
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
END
    local apt=(apt-get -q -o "Dir::Etc::SourceList=$lists/debian.sources" -o Dir::Etc::SourceParts=-
        -o "Dir::State::lists=$lists/lists" -o APT::Sandbox::User=)
    "${apt[@]}" update >/dev/null || { echo "error: no sources of Debian packages: is deb.debian.org within reach?" >&2 && exit 2; }
    # as published, without Debian's patches: those of LAMMPS concern manuals and paths; what LIGGGHTS needs is below
    (cd "$work/$1" && "${apt[@]}" source --download-only --tar-only "$1" >/dev/null)
    tar -xf "$work/$1"/"$1"_*.orig.tar.* -C "$work/$1/source" --strip-components=1
}

build() { # name, folder with CMakeLists.txt, target, options
    local name=$1 from=$2 target=$3
    shift 3
    cmake -S "$from" -B "$work/$name/build" -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=$flags" "$@" >"$work/$name/log" 2>&1 &&
        cmake --build "$work/$name/build" --parallel "$jobs" --target "$target" >>"$work/$name/log" 2>&1 ||
        { tail -n 20 "$work/$name/log" >&2 && echo "error: $name does not build: see $work/$name/log" >&2 && exit 2; }
    cp "$work/$name/build/$target" "$work/$name/"
    rm -rf "$work/$name/build" "$work/$name/source" "$work/$name"/*.orig.tar.*
    echo "$name: $work/$name/$target ($SECONDS s)"
}

[ $# -gt 0 ] || set -- lammps liggghts
for one in "$@"; do
    SECONDS=0
    case $one in
    lammps)
        source_of lammps
        build lammps "$work/lammps/source/cmake" lmp -DBUILD_SHARED_LIBS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON -DBUILD_MPI=OFF -DBUILD_OMP=OFF \
            -DPKG_GRANULAR=ON -DPKG_RIGID=ON -DPKG_OPT=ON -DWITH_GZIP=OFF -DWITH_JPEG=OFF -DWITH_PNG=OFF -DWITH_FFMPEG=OFF
        ;;
    liggghts)
        source_of liggghts
        # its own CMakeLists.txt asks for MPI, or for stubs that it does not know how to build
        # and this file for VTK
        rm -f "$work"/liggghts/source/src/dump_mesh_vtk.*
        (cd "$work/liggghts/source/src" && sh Make.sh style && sh Make.sh models) >/dev/null
        # two lines that GCC 11 and later do not compile
        sed -i 's/return static_cast< std::ostringstream & >.*/return std::to_string(a);/' "$work/liggghts/source/src/utils.h"
        sed -i 's/numneigh > 0/numneigh != 0/' "$work/liggghts/source/src/finish.cpp"
        cat >"$work/liggghts/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.13)
project(liggghts C CXX)
file(GLOB sources source/src/*.cpp)
add_executable(liggghts ${sources} source/src/STUBS/mpi.c)
target_include_directories(liggghts PRIVATE source/src source/src/STUBS)
END
        build liggghts "$work/liggghts" liggghts -DCMAKE_CXX_FLAGS="-w -std=c++11"
        ;;
    *)
        echo "error: $one: lammps or liggghts" >&2
        exit 2
        ;;
    esac
done
