# SPDX-License-Identifier: MIT
# Periodic packing in pure shear, in Yade. Reads the words of PEER_CALL (key=value;...) from the environment.
import os
import sys
import time

import numpy

sys.path.insert(0, os.environ["PEER_COMMON"])
from common import rates, read_parameters, read_state, report  # noqa: E402

parameters = read_parameters(os.environ["PEER_PARAMETERS"])
state = read_state(os.environ["PEER_STATE"])
steps = int(os.environ["PEER_STEPS"])
skin = float(os.environ["PEER_SKIN"])
kn, kt, gamma, density = (parameters[key] for key in ("kn", "kt", "gamma_n", "density"))

O.periodic = True
O.cell.setBox(*[float(v) for v in state.lengths])
# The law of FrictViscoMat and not of ViscElMat, which takes the velocity across a moving periodic boundary with the wrong sign (seen in 2023.02a: particles
# next to the boundary are dragged). Its damper is 2 beta sqrt(m_eff kn) with the mean beta of both: the beta below gives gamma m_eff up to second order
# of the spread of the masses. young = kn / r gives kn, poisson is kt / kn.
for x, r in zip(state.x - state.box[0], state.r):
    mass = density * 4 / 3 * numpy.pi * r**3
    beta = 0.5 * gamma * numpy.sqrt(0.5 * mass / kn)
    material = FrictViscoMat(density=density, young=kn / r, poisson=kt / kn, betan=beta, frictionAngle=float(numpy.arctan(parameters["mu"])))
    O.bodies.append(sphere([float(v) for v in x], float(r), material=material))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=skin),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictViscoMat_FrictViscoMat_FrictViscoPhys()], [Law2_ScGeom_FrictViscoPhys_CundallStrackVisco()]),
    NewtonIntegrator(damping=0.0),
]
O.dt = parameters["dt"]
e = rates(parameters)
# The gradient acts on the cell (which grows exponentially) and, when it is set, adds its affine field to the total velocities.
O.cell.velGrad = Matrix3(float(e[0]), 0, 0, 0, float(e[1]), 0, 0, 0, float(e[2]))
O.step()
start, used = time.perf_counter(), time.process_time()
O.run(steps - 1, True)
seconds, cpu = time.perf_counter() - start, time.process_time() - used

stress = getStress()
touching = sum(1 for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0)
import yade.config  # noqa: E402
report("yade", yade.config.version, "packing", len(state.r), steps - 1, seconds, [-stress[k][k] for k in range(3)], 2.0 * touching / len(state.r),
       cpu_seconds=cpu)
