# SPDX-License-Identifier: MIT
# Spheres, rigid clumps or bonded clusters in six frictionless walls that move at constant speed, in Yade.
import os
import sys
import time

import numpy
import yade.config

sys.path.insert(0, os.environ["PEER_COMMON"])
from common import bonds, rates, read_parameters, read_state, report  # noqa: E402

kind = os.environ["PEER_KIND"]
parameters = read_parameters(os.environ["PEER_PARAMETERS"])
state = read_state(os.environ["PEER_STATE"])
steps = int(os.environ["PEER_STEPS"])
skin = float(os.environ["PEER_SKIN"])
kn, kt, gamma, density = (parameters[key] for key in ("kn", "kt", "gamma_n", "density"))
friction = float(numpy.arctan(parameters["mu"]))
e = rates(parameters)
mass = density * 4 / 3 * numpy.pi * state.r**3
grain_mass = numpy.bincount(state.owner, mass)

if kind == "bonded":
    # young = kn / r gives kn, poisson is kt / kn, bending stiffness is r^2 kt alphaKr; no strength is ever reached.
    r = float(state.r[0])
    ball = CohFrictMat(density=density, young=kn / r, poisson=kt / kn, frictionAngle=friction, isCohesive=True, normalCohesion=1e30, shearCohesion=1e30, momentRotationLaw=True,
                       alphaKr=parameters["bending"] / (kt * r * r), alphaKtw=parameters["torsion"] / (kt * r * r), etaRoll=-1, etaTwist=-1)
    materials = dict.fromkeys(range(1, state.bodies + 1), ball)
    wall_material = FrictMat(density=density, young=kn / r, poisson=kt / kn, frictionAngle=0.0)
    cohesive = Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=False, setCohesionOnNewContacts=True)
    loop = InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D(), Ig2_Wall_Sphere_ScGeom()], [cohesive, Ip2_FrictMat_FrictMat_FrictPhys()],
                           [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(), Law2_ScGeom_FrictPhys_CundallStrack()])
else:
    # Stiffness and damping of a contact are a b / (a + b) of the two materials (measured; the class documentation has a factor 2 that this
    # release does not apply): 2 kn of both gives kn; cn = gamma m gives gamma m_eff, with the mass m of the whole grain; a wall counts as infinite mass.
    materials = {}
    for owner in range(1, state.bodies + 1):
        materials[owner] = ViscElMat(density=density, kn=2 * kn, ks=2 * kt, cn=gamma * float(grain_mass[owner]), cs=0.0, frictionAngle=friction)
    wall_material = ViscElMat(density=density, kn=2 * kn, ks=2 * kt, cn=1e30, cs=0.0, frictionAngle=0.0)
    loop = InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()])

walls = []
for axis in range(3):
    for side in (-1, 1):
        place = state.centre.copy()
        place[axis] += side * 0.5 * state.lengths[axis]
        made = wall([float(v) for v in place], axis=axis, sense=-side, material=wall_material)
        number = O.bodies.append(made)
        speed = [0.0, 0.0, 0.0]
        speed[axis] = float(side * 0.5 * state.lengths[axis] * e[axis])
        O.bodies[number].state.vel = speed
        walls.append(number)

first = len(O.bodies)
for owner, x, r in zip(state.owner, state.x, state.r):
    O.bodies.append(sphere([float(v) for v in x], float(r), material=materials[int(owner)]))
if kind == "clumps":
    members = {}
    for number, owner in enumerate(state.owner):
        members.setdefault(int(owner), []).append(first + number)
    # discretization=0: mass and inertia are plain sums over the members
    grains = [O.bodies.clump(members[owner], discretization=0) for owner in sorted(members)]
    for number in grains:
        found = O.bodies[number].state
        found.vel = [float(v) for v in (numpy.array(found.pos) - state.centre) * e]
    worst = max(abs(O.bodies[number].state.mass / grain_mass[k + 1] - 1) for k, number in enumerate(grains))
    if worst > 1e-9:
        raise SystemExit("clump masses are not the plain sums: %g" % worst)
else:
    # The velocity of the centre of the grain, for all of its spheres.
    centre = numpy.stack([numpy.bincount(state.owner, mass * state.x[:, k]) / grain_mass.clip(1e-300) for k in range(3)], 1)
    for number in range(first, len(O.bodies)):
        found = O.bodies[number].state
        found.vel = [float(v) for v in (centre[int(state.owner[number - first])] - state.centre) * e]

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=skin),
    loop,
    NewtonIntegrator(damping=0.0, exactAsphericalRot=kind == "clumps"),
]
O.dt = parameters["dt"]
if kind == "bonded":
    for a, b in bonds(state):
        createInteraction(first + a, first + b)
    cohesive.setCohesionOnNewContacts = False
O.step()
start, used = time.perf_counter(), time.process_time()
O.run(steps - 1, True)
seconds, cpu = time.perf_counter() - start, time.process_time() - used

size = numpy.array([O.bodies[walls[2 * k + 1]].state.pos[k] - O.bodies[walls[2 * k]].state.pos[k] for k in range(3)])
area = size.prod() / size
stress = [0.5 * (O.forces.f(walls[2 * k + 1])[k] - O.forces.f(walls[2 * k])[k]) / area[k] for k in range(3)]
low = set(walls)
touching = sum(1 for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0 and i.id1 not in low and i.id2 not in low
               and state.owner[i.id1 - first] != state.owner[i.id2 - first])
report("yade", yade.config.version, kind, state.bodies, steps - 1, seconds, stress, 2.0 * touching / state.bodies, cpu_seconds=cpu)
if os.environ.get("PEER_DEBUG"):
    bonded = [i for i in O.interactions if i.isReal and i.id1 not in low and i.id2 not in low and state.owner[i.id1 - first] == state.owner[i.id2 - first]]
    print("DEBUG", len(bonded), bonded[0].phys.dict())
