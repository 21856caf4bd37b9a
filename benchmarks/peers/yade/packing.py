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
# Stiffness and damping of a contact are a b / (a + b) of the two materials (measured; the class documentation has a factor 2 that this
# release does not apply): 2 kn of both gives kn, and cn = gamma m gives gamma m_eff.
for x, r in zip(state.x - state.box[0], state.r):
    mass = density * 4 / 3 * numpy.pi * r**3
    material = ViscElMat(density=density, kn=2 * kn, ks=2 * kt, cn=gamma * mass, cs=0.0, frictionAngle=float(numpy.arctan(parameters["mu"])))
    O.bodies.append(sphere([float(v) for v in x], float(r), material=material))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=skin),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False)], [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0.0),
]
O.dt = parameters["dt"]
e = rates(parameters)
# The gradient acts on the cell (which grows exponentially) and, when it is set, adds its affine field to the total velocities.
O.cell.velGrad = Matrix3(float(e[0]), 0, 0, 0, float(e[1]), 0, 0, 0, float(e[2]))
O.step()
start = time.perf_counter()
O.run(steps - 1, True)
seconds = time.perf_counter() - start

stress = getStress()
touching = sum(1 for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0)
import yade.config  # noqa: E402
report("yade", yade.config.version, "packing", len(state.r), steps - 1, seconds, [-stress[k][k] for k in range(3)], 2.0 * touching / len(state.r),
       volume=O.cell.volume)
