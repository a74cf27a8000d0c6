"""A bonded network in YADE: the exported stiffnesses on YADE's own cohesive contact law.

With kn = EA/L, ks = 12EI/L³, kr = EI/L, ktw = GJ/L and the contact point in the middle of the bond (equal radii), the
law is the Euler–Bernoulli bond. Shear is integrated from velocities: nothing may touch them between steps.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from exported import difference, files, network, rotation_vector
from reference import machine, write
from yade import O, config
from yade.utils import createInteraction, sphere
from yade.wrapper import (
    CohFrictMat,
    ForceResetter,
    Ig2_Sphere_Sphere_ScGeom6D,
    InteractionLoop,
    Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
    Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
    NewtonIntegrator,
    PyRunner,
)

UNBREAKABLE = 1e30


def build(folder, damping, load, every=1):
    """Fills the scene; `load` is the command that PyRunner calls, each step or every so many, before the particles move."""
    net = network(folder)
    O.reset()
    material = O.materials.append(
        CohFrictMat(young=1.0, poisson=0.3, density=1.0, frictionAngle=0.0, isCohesive=True, momentRotationLaw=True,
                    normalCohesion=UNBREAKABLE, shearCohesion=UNBREAKABLE)
    )
    radii = {p.radius for p in net.particles}
    if len(radii) != 1:
        sys.exit("particles.csv: radii differ; the contact point of YADE is then not in the middle of the bond")
    for p in net.particles:
        body = O.bodies[O.bodies.append(sphere(p.at, p.radius, material=material))]
        body.state.mass, body.state.inertia = p.mass, (p.inertia,) * 3
        body.state.blockedDOFs = "zXY" if net.plane else ""
    for particle, parts in net.held.items():
        # YADE writes rotations as capitals.
        letters = {part[1].upper() if part[0] == "r" else part[1] for part in parts}
        O.bodies[particle].state.blockedDOFs = "".join(sorted(letters | set("zXY" if net.plane else "")))
    cohesion = Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=False, setCohesionOnNewContacts=True)
    O.engines = [
        ForceResetter(),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom6D(avoidGranularRatcheting=False)],
            [cohesion],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()],
        ),
        PyRunner(command=load, iterPeriod=every, initRun=True),
        NewtonIntegrator(damping=damping, gravity=(0, 0, 0)),
    ]
    for bond in net.bonds:
        contact = createInteraction(bond.i, bond.j)
        phys = contact.phys
        phys.kn, phys.ks, phys.kr, phys.ktw = bond.kn, bond.ks, bond.kb, bond.kt
        phys.unp = contact.geom.penetrationDepth
        phys.normalAdhesion = phys.shearAdhesion = UNBREAKABLE
        phys.cohesionBroken, phys.momentRotationLaw = False, True
        phys.maxRollPl = phys.maxTwistPl = phys.unpMax = -1
        phys.tangensOfFrictionAngle = 0
    cohesion.setCohesionOnNewContacts = False
    O.dt = net.run["step_s"]
    return net


def add_forces(net, factor):
    for particle, force in net.forces.items():
        O.forces.addF(particle, tuple(factor * f for f in force))


def unbalanced(net):
    """Largest force, or moment over radius, on what is free to move."""

    def of(particle):
        held, radius = net.held.get(particle, {}), net.particles[particle].radius
        size = lambda vector, letter: sum(v * v for v, axis in zip(vector, "xyz") if letter + axis not in held) ** 0.5
        return max(size(O.forces.f(particle), "u"), size(O.forces.t(particle), "r") / radius)

    return max(map(of, range(len(net.particles))))


def motion(particle):
    """Displacements and rotations of a particle, six numbers."""
    state = O.bodies[particle].state
    u = state.pos - state.refPos
    q = state.ori
    return (*u, *rotation_vector(q[3], q[0], q[1], q[2]))


def version():
    return config.version


def hand_in(folder, case, name, columns, rows, again, about):
    """Writes a reference of YADE; `again` are the rows of a second run."""
    write(
        case,
        name,
        columns,
        rows,
        inputs=files(folder),
        repeat=(difference(rows, again), "the same input run twice in one process with one thread (-j1)"),
        kind="yade",
        about=about,
        source="Run for Seam, from a network that Seam exported; YADE's own contact law and integrator",
        code="YADE, the Debian package yade; Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
        version=version(),
        command=f"seam references regenerate --with yade {case}/{name} --accept",
        machine=machine(),
    )
