#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes the initial states, once, with LAMMPS: scenes.py NAME... (packing-10k, packing-100k, triaxial-10k, clumps-4, clumps-14, bonded)."""
import os
import sys

import numpy

from common import State, here, read_parameters, run, write_state

work = os.path.join(here, "work")


def data_file(path, box, x, r, density, molecule=None, types=1):
    """A LAMMPS data file of atom style sphere (or hybrid sphere molecule)."""
    with open(path, "w") as file:
        file.write("made by scenes.py\n\n%d atoms\n%d atom types\n\n" % (len(r), types))
        for k, axis in enumerate("xyz"):
            file.write("%.17g %.17g %slo %shi\n" % (box[0][k], box[1][k], axis, axis))
        file.write("\nAtoms\n\n")
        for i in range(len(r)):
            file.write("%d 1 %.17g %g %.17g %.17g %.17g" % (i + 1, 2 * r[i], density, *x[i]))
            file.write("\n" if molecule is None else " %d\n" % molecule[i])


def lattice(n, spacing):
    """n points of a cubic lattice in shuffled order, and the box."""
    per_axis = int(numpy.ceil(n ** (1 / 3) - 1e-9))
    grid = numpy.stack(numpy.meshgrid(*[numpy.arange(per_axis)] * 3, indexing="ij"), -1).reshape(-1, 3)
    keep = numpy.sort(numpy.random.default_rng(7).permutation(len(grid))[:n])
    return (grid[keep] + 0.5) * spacing, numpy.array([[0.0] * 3, [per_axis * spacing] * 3])


def read_dump(path):
    """Box and columns of a LAMMPS text dump."""
    lines = open(path).read().split("\n")
    count = int(lines[3])
    box = numpy.array([[float(w) for w in lines[5 + k].split()[:2]] for k in range(3)]).T
    return box, numpy.array([[float(w) for w in line.split()] for line in lines[9:9 + count]])


def packing(name, n):
    parameters = read_parameters(os.path.join(here, "parameters", "packing.txt"))
    r = 0.01 * numpy.random.default_rng(n).uniform(0.95, 1.05, n)
    x, box = lattice(n, 0.0212)
    data_file(os.path.join(work, name + ".data"), box, x, r, parameters["density"])
    phi = (4 / 3 * numpy.pi * r ** 3).sum() / numpy.prod(box[1] - box[0])
    loose = numpy.log(0.62 / phi) / 3 / (4000 * parameters["dt"])
    dump = os.path.join(work, name + ".dump")
    run(["lmp", "-log", name + ".log", "-in", os.path.join(here, "lammps", "prepare_packing.in"), "-var", "data", name + ".data", "-var", "out", dump,
         "-var", "kn", str(parameters["kn"]), "-var", "gamma_n", str(parameters["gamma_n"]), "-var", "dt", str(parameters["dt"]),
         "-var", "target", "2e6", "-var", "loose", "%.6f" % loose], work)
    box, table = read_dump(dump)
    low, lengths = box[0].copy(), box[1] - box[0]
    x = numpy.mod(table[:, 1:4] - low, lengths)
    state = State("spheres", numpy.array([[0.0] * 3, lengths]), table[:, 0].astype(int), x, table[:, 4])
    write_state(os.path.join(work, name + ".txt"), state)
    print(name, "phi", (4 / 3 * numpy.pi * state.r ** 3).sum() / numpy.prod(lengths), "box", lengths)


makers = {"packing-10k": lambda name: packing(name, 10000), "packing-100k": lambda name: packing(name, 100000)}


def main():
    os.makedirs(work, exist_ok=True)
    for name in sys.argv[1:] or makers:
        if not os.path.exists(os.path.join(work, name + ".txt")):
            makers[name](name)


if __name__ == "__main__":
    main()
