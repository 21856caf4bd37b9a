# SPDX-License-Identifier: MIT
# Bonded clusters in six frictionless walls that move at constant speed, in ESyS-Particle (one worker process and its master).
import os
import sys
import time

import numpy
from esys.lsm import LsmMpi, NRotElasticWallPrms, RotBondPrms, RotFrictionPrms
from esys.lsm.util import Vec3

sys.path.insert(0, os.environ["PEER_COMMON"])
from common import bonds, rates, read_parameters, read_state, report, touching_pairs  # noqa: E402

parameters = read_parameters(os.environ["PEER_PARAMETERS"])
state = read_state(os.environ["PEER_STATE"])
steps = int(os.environ["PEER_STEPS"])
kn, kt = parameters["kn"], parameters["kt"]
e = rates(parameters)
mass = parameters["density"] * 4 / 3 * numpy.pi * state.r**3
grain_mass = numpy.bincount(state.owner, mass)
centre = numpy.stack([numpy.bincount(state.owner, mass * state.x[:, k]) / grain_mass.clip(1e-300) for k in range(3)], 1)
velocity = (centre[state.owner] - state.centre) * e

with open("bonded.geo", "w") as file:
    margin = 0.1 * state.lengths
    file.write("LSMGeometry 1.2\nBoundingBox %.17g %.17g %.17g %.17g %.17g %.17g\nPeriodicBoundaries 0 0 0\nDimension 3D\nBeginParticles\nSimple\n%d\n"
               % (*(state.box[0] - margin), *(state.box[1] + margin), len(state.r)))
    for i in range(len(state.r)):
        file.write("%.17g %.17g %.17g %.17g %d 1\n" % (*state.x[i], state.r[i], i))
    pairs = bonds(state)
    file.write("EndParticles\nBeginConnect\n%d\n" % len(pairs))
    for a, b in pairs:
        file.write("%d %d 1\n" % (a, b))
    file.write("EndConnect\n")

simulation = LsmMpi(numWorkerProcesses=1, mpiDimList=[1, 1, 1])
simulation.initNeighbourSearch(particleType="RotSphere", gridSpacing=float(os.environ["PEER_GRID"]) * 2 * float(state.r.max()), verletDist=float(os.environ["PEER_SKIN"]))
simulation.setNumTimeSteps(steps)
simulation.setTimeStepSize(parameters["dt"])
simulation.readGeometry("bonded.geo")
simulation.setParticleDensity(tag=1, mask=-1, Density=parameters["density"])
for i in range(len(state.r)):
    simulation.setParticleVelocity(i, Vec3(*[float(v) for v in velocity[i]]))
simulation.createInteractionGroup(RotBondPrms(name="bond", normalK=kn, shearK=kt, torsionK=parameters["torsion"], bendingK=parameters["bending"], normalBrkForce=1e30,
                                              shearBrkForce=1e30, torsionBrkForce=1e30, bendingBrkForce=1e30, tag=1, scaling=False))
simulation.createInteractionGroup(RotFrictionPrms(name="friction", normalK=kn, dynamicMu=parameters["mu"], staticMu=parameters["mu"], shearK=kt, scaling=False))
simulation.createExclusion("bond", "friction")
# Without a switch for it, the wall scales its stiffness by pi r (measured), like the contacts with scaling=True.
wall_stiffness = kn / (numpy.pi * float(state.r[0]))
steps_of_walls = []
for k in range(3):
    for side in (-1, 1):
        name, place, normal, move = "xyz"[k] + str((side + 1) // 2), state.centre.copy(), [0.0] * 3, [0.0] * 3
        place[k] += side * 0.5 * state.lengths[k]
        normal[k] = float(-side)
        move[k] = float(side * 0.5 * state.lengths[k] * e[k] * parameters["dt"])
        simulation.createWall(name=name, posn=Vec3(*[float(v) for v in place]), normal=Vec3(*normal))
        simulation.createInteractionGroup(NRotElasticWallPrms(name="elastic" + name, wallName=name, normalK=wall_stiffness))
        steps_of_walls.append((name, Vec3(*move)))


def advance(count):
    for _ in range(count):
        for name, move in steps_of_walls:
            simulation.moveWallBy(name, move)
        simulation.runTimeStep()


advance(1)
start = time.perf_counter()
advance(steps - 1)
seconds = time.perf_counter() - start

size = state.lengths * (1 + e * parameters["dt"] * steps)
force = {name: simulation.getWallForce(name) for name, _ in steps_of_walls}
stress = [0.5 * (abs(force[a + "1"][k]) + abs(force[a + "0"][k])) / (size.prod() / size[k]) for k, a in enumerate("xyz")]
found = {p.getId(): [p.getPosn()[k] for k in range(3)] for p in simulation.getParticleList()}
x = numpy.array([found[i] for i in range(len(state.r))])
report("esys", "2.3.5", "bonded", state.bodies, steps - 1, seconds, stress, 2.0 * touching_pairs(state.owner, x, state.r) / state.bodies)
simulation.exit()
