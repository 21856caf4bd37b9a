# SPDX-License-Identifier: MIT
"""Reads the scene files that every peer shares and prints the result line."""
import argparse
import json
import math
import os
import subprocess
import sys

import numpy

here = os.path.dirname(os.path.abspath(__file__))


def arguments():
    """The command line that every peer program understands."""
    parser = argparse.ArgumentParser()
    parser.add_argument("kind", choices=["packing", "triaxial", "clumps", "bonded"])
    parser.add_argument("--parameters", required=True)
    parser.add_argument("--state", required=True)
    parser.add_argument("--steps", type=int, required=True)
    parser.add_argument("--work", default=os.path.join(here, "work", "scratch"), help="folder for scratch files")
    parser.add_argument("--skin", type=float, default=None, help="neighbour skin (m); default: the peer's tuned value")
    found = parser.parse_args()
    found.work = os.path.abspath(found.work)
    found.state = os.path.abspath(found.state)
    os.makedirs(found.work, exist_ok=True)
    return found


def read_parameters(path):
    """A dictionary key -> float from a parameter file."""
    lines = [line.split("#")[0].split() for line in open(path)]
    return {words[0]: float(words[1]) for words in lines if words}


class State:
    """An initial state: kind, box (2 x 3, low and high corner), owner (clump or particle number from 1), x (n x 3), r (n)."""

    def __init__(self, kind, box, owner, x, r):
        self.kind, self.box, self.owner, self.x, self.r = kind, box, owner, x, r

    @property
    def lengths(self):
        return self.box[1] - self.box[0]

    @property
    def centre(self):
        return 0.5 * (self.box[0] + self.box[1])

    @property
    def bodies(self):
        return int(self.owner.max())


def read_state(path):
    with open(path) as file:
        magic, version, kind = file.readline().split()
        if (magic, version) != ("clast_peers", "1"):
            raise SystemExit(path + ": not a state file of version 1")
        box = numpy.array([float(word) for word in file.readline().split()[1:]]).reshape(2, 3)
        count = int(file.readline().split()[1])
        table = numpy.loadtxt(file, max_rows=count, ndmin=2)
    return State(kind, box, table[:, 0].astype(int), table[:, 1:4], table[:, 4])


def write_state(path, state):
    with open(path + ".part", "w") as file:
        file.write("clast_peers 1 %s\nbox %s\ncount %d\n" % (state.kind, " ".join(repr(float(v)) for v in state.box.ravel()), len(state.r)))
        for owner, x, r in zip(state.owner, state.x, state.r):
            file.write("%d %.17g %.17g %.17g %.17g\n" % (owner, *x, r))
    os.replace(path + ".part", path)


def bonds(state):
    """Pairs (from 0) of spheres of the same owner that touch: distance of the centres up to 1.001 of the sum of the radii."""
    found = []
    starts = numpy.flatnonzero(numpy.diff(state.owner, prepend=0))
    for first, last in zip(starts, list(starts[1:]) + [len(state.r)]):
        x, r = state.x[first:last], state.r[first:last]
        distance = numpy.linalg.norm(x[:, None] - x[None], axis=2)
        a, b = numpy.nonzero(numpy.triu(distance <= 1.001 * (r[:, None] + r[None]), 1))
        found += list(zip((first + a).tolist(), (first + b).tolist()))
    return found


def touching_pairs(owner, x, r):
    """Number of overlapping pairs of spheres of different owners, without periodicity."""
    cell = 2 * r.max()
    boxes = {}
    for i, key in enumerate(map(tuple, numpy.floor(x / cell).astype(int))):
        boxes.setdefault(key, []).append(i)
    count = 0
    for key, inside in boxes.items():
        near = [j for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1) for j in boxes.get((key[0] + dx, key[1] + dy, key[2] + dz), ())]
        near = numpy.array(near)
        for i in inside:
            later = near[(near > i) & (owner[near] != owner[i])]
            count += int((((x[later] - x[i]) ** 2).sum(1) < (r[later] + r[i]) ** 2).sum())
    return count


def rates(parameters):
    return numpy.array([parameters["rate_" + axis] for axis in "xyz"])


def run(command, directory, timeout=3600):
    """Runs a program on one core and returns what it printed."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run(command, cwd=directory, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=timeout)
    if done.returncode:
        sys.stderr.write(done.stdout[-4000:])
        raise SystemExit("%s failed with code %d" % (command[0], done.returncode))
    return done.stdout


def report(peer, version, kind, bodies, steps, seconds, stress, coordination, **extra):
    """Prints the result: stress = (xx, yy, zz), compression positive, Pa; bodies = what the rate counts (spheres or clumps)."""
    p = float(sum(stress) / 3)
    q = float(stress[2] - 0.5 * (stress[0] + stress[1]))
    if not all(math.isfinite(v) for v in (p, q, coordination, seconds)):
        raise SystemExit(peer + ": the result is not finite")
    print(json.dumps(dict(peer=peer, version=version, scene=kind, n=int(bodies), steps=int(steps), seconds=float(seconds),
                          particle_steps_per_s=bodies * steps / seconds, p_Pa=p, q_Pa=q, coordination=float(coordination), **extra)))
