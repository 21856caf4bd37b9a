#!/bin/bash
# SPDX-License-Identifier: MIT
# Installs the peers that the distribution has; says what is missing and goes on.
set -u
missing=()
for package in python3-numpy lammps liggghts yade esys-particle; do
    if dpkg -s "$package" >/dev/null 2>&1; then
        echo "present: $package $(dpkg-query -W -f '${Version}' "$package")"
    elif apt-get install -y --no-install-recommends "$package" >/dev/null 2>&1; then
        echo "installed: $package $(dpkg-query -W -f '${Version}' "$package")"
    else
        missing+=("$package")
    fi
done
[ ${#missing[@]} -eq 0 ] || echo "missing (their rows are left out): ${missing[*]}"
