#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes the initial states, once, with LAMMPS: scenes.py NAME... (packing-10k, packing-100k, triaxial-10k, clumps-4, clumps-14, bonded)."""
import os
import re
import sys

import numpy

from common import State, here, read_parameters, run, write_state

work = os.path.join(here, "work")


def data_file(path, box, x, r, density, molecule=None, v=None, types=1, hybrid=False):
    """A LAMMPS data file of atom style sphere, with a section of clump numbers if molecule is given, and one of velocities if v is given.
    hybrid: the clump number stands in the atom line (LIGGGHTS, hybrid granular molecular)."""
    with open(path, "w") as file:
        file.write("made by scenes.py\n\n%d atoms\n%d atom types\n\n" % (len(r), types))
        for k, axis in enumerate("xyz"):
            file.write("%.17g %.17g %slo %shi\n" % (box[0][k], box[1][k], axis, axis))
        file.write("\nAtoms\n\n")
        for i in range(len(r)):
            file.write("%d 1 %.17g %g %.17g %.17g %.17g\n" % (i + 1, 2 * r[i], density, *x[i]) if not hybrid else
                       "%d 1 %.17g %.17g %.17g %.17g %g %d\n" % (i + 1, *x[i], 2 * r[i], density, molecule[i]))
        if v is not None:
            file.write("\nVelocities\n\n")
            for i in range(len(r)):
                file.write("%d %.17g %.17g %.17g 0 0 0\n" % (i + 1, *v[i]))
        if molecule is not None and not hybrid:
            file.write("\nMolecules\n\n")
            for i in range(len(r)):
                file.write("%d %d\n" % (i + 1, molecule[i]))


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


def rotations(n, generator):
    """n random rotation matrices (uniform, from unit quaternions)."""
    q = generator.normal(size=(n, 4))
    w, x, y, z = (q / numpy.linalg.norm(q, axis=1)[:, None]).T
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)


def walled(name, n, kind, shape=None, target=1e6):
    """A packing in six walls: spheres, or grains of several spheres given by a shape file (x y z r), compressed as rigid bodies without friction."""
    parameters = read_parameters(os.path.join(here, "parameters", {"spheres": "triaxial", "clumps": "clumps", "clusters": "bonded"}[kind] + ".txt"))
    generator = numpy.random.default_rng(n)
    if shape is None:
        points, radii = numpy.zeros((1, 3)), numpy.array([0.01])
        scale = generator.uniform(0.95, 1.05, n)
    else:
        table = numpy.loadtxt(os.path.join(here, shape), ndmin=2)
        points, radii, scale = table[:, :3], table[:, 3], numpy.ones(n)
    reach = (numpy.linalg.norm(points, axis=1) + radii).max()
    centres, box = lattice(n, 2.12 * reach)
    x = (centres[:, None] + numpy.einsum("nij,pj->npi", rotations(n, generator), points)).reshape(-1, 3)
    r = (scale[:, None] * radii).ravel()
    owner = numpy.repeat(numpy.arange(1, n + 1), len(radii))
    speed = numpy.repeat(generator.uniform(-3, 3, (n, 3)), len(radii), axis=0)
    margin = 0.05 * (box[1] - box[0])
    data_file(os.path.join(work, name + ".data"), [box[0] - margin, box[1] + margin], x, r, parameters["density"], None if shape is None else owner, speed)
    lengths, middle = box[1] - box[0], 0.5 * (box[0] + box[1])
    dump = os.path.join(work, name + ".dump")
    variables = dict(data=name + ".data", rigid=int(shape is not None), newton="on", steps=60000, thermo=500, mu=0, kt=0, skin=0.002, preparing=1, out=dump, target=target,
                     folder=os.path.join(here, "lammps"), **{key: parameters[key] for key in ("kn", "gamma_n", "dt")})
    for k, axis in enumerate("xyz"):
        variables["l" + axis], variables["c" + axis], variables["e" + axis] = repr(float(lengths[k])), repr(float(middle[k])), -2.5
    command = ["lmp", "-log", name + ".log", "-in", os.path.join(here, "lammps", "walls.in")]
    for key, value in variables.items():
        command += ["-var", key, str(value)]
    text = run(command, work)
    size = numpy.array([float(word) for word in re.search(r"^BOX (.*)", text, re.M).group(1).split()])
    table = read_dump(dump)[1]
    x = table[:, 1:4] - (middle - 0.5 * size)
    write_state(os.path.join(work, name + ".txt"), State(kind, numpy.array([[0.0] * 3, size]), owner, x, table[:, 4]))
    print(name, "sphere volume / box", (4 / 3 * numpy.pi * table[:, 4] ** 3).sum() / numpy.prod(size), "box", size)


makers = {"packing-10k": lambda name: packing(name, 10000), "packing-100k": lambda name: packing(name, 100000),
          "triaxial-10k": lambda name: walled(name, 10000, "spheres"),
          "clumps-4": lambda name: walled(name, 5000, "clumps", "shape_4.txt"),
          "clumps-14": lambda name: walled(name, 5000, "clumps", "shape_14.txt"),
          "bonded": lambda name: walled(name, 1000, "clusters", "shape_bonded.txt")}


def main():
    os.makedirs(work, exist_ok=True)
    for name in sys.argv[1:] or makers:
        if name in makers and not os.path.exists(os.path.join(work, name + ".txt")):
            makers[name](name)


if __name__ == "__main__":
    main()
