"""Brings an exported network to rest in YADE: displacement and rotation of every particle.

yade -n -x -j1 references/generators/yade/static.py FOLDER CASE NAME
"""

import sys
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, add_forces, build, motion, version
from exported import BOTH_WAYS, difference, field_columns, files, half_difference, kept, largest_force
from reference import machine, write

# Cundall's local damping; it acts on velocities inside the integrator and leaves the shear whole.
DAMPING = 0.3
STEPS_BETWEEN_LOOKS = 1000
MOST_STEPS = 2_000_000


def residual(net, free, radius):
    """Largest unbalanced force or moment over radius of what is free, relative to the largest load."""

    def of(particle):
        held = net.held.get(particle, {})
        size = lambda vector, letter: sum(v * v for v, axis in zip(vector, "xyz") if letter + axis not in held) ** 0.5
        return max(size(O.forces.f(particle), "u"), size(O.forces.t(particle), "r") / radius)

    return max(map(of, free)) / largest_force(net.forces)


def relax(folder, sign):
    global net
    net = build(folder, DAMPING, f"add_forces(net, {sign})")
    free = sorted(set(range(len(net.particles))) - set(net.clamped))
    radius = net.particles[0].radius
    quiet = 0
    # Twice in a row: one look may fall on a moment when all forces pass through zero.
    while quiet < 2:
        if O.iter >= MOST_STEPS:
            sys.exit(f"not at rest after {O.iter} steps: residual {residual(net, free, radius):.1e}")
        O.run(STEPS_BETWEEN_LOOKS, True)
        quiet = quiet + 1 if residual(net, free, radius) <= net.run["residual"] else 0
    rows = [kept(motion(i), net.plane) for i in range(len(net.particles))]
    return rows, O.iter, residual(net, free, radius)


def answer(folder):
    """For a network under a load that is not tiny the effects of second order are taken out."""
    rows, steps, reached = relax(folder, 1.0)
    if net.run.get("both_ways"):
        return half_difference(rows, relax(folder, -1.0)[0]), steps, reached
    return rows, steps, reached


folder, case, name = sys.argv[1:4]
rows, steps, reached = answer(folder)
again, _, _ = answer(folder)
write(
    case,
    name,
    field_columns(net.plane),
    rows,
    inputs=files(folder),
    repeat=(difference(rows, again), "the same input run twice in one process with one thread (-j1)"),
    kind="yade",
    about=f"Equilibrium of {len(net.particles)} particles and {len(net.bonds)} bonds, in the order of particles.csv; "
    + (f"{BOTH_WAYS}; " if net.run.get("both_ways") else "")
    + f"local damping {DAMPING}, {steps} steps, unbalanced forces at last {reached:.1e} of the largest load.",
    source="Run for Seam, from a network that Seam exported; YADE's own contact law and integrator",
    code="YADE, the Debian package yade; Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
    version=version(),
    command=f"seam references regenerate --with yade {case}/{name} --accept",
    machine=machine(),
)
