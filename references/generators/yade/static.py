"""Brings an exported network to rest in YADE: displacement and rotation of every particle.

yade -n -x -j1 references/generators/yade/static.py FOLDER CASE NAME
"""

import sys
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, add_forces, build, motion, version
from exported import difference, field_columns, files, kept, largest_force
from reference import machine, write

# Cundall's local damping; it acts on velocities inside the integrator and leaves the shear whole.
DAMPING = 0.3
STEPS_BETWEEN_LOOKS = 1000
MOST_STEPS = 2_000_000


def residual(net, free, radius):
    """Largest unbalanced force or moment over radius, relative to the largest load."""
    force = max(max(O.forces.f(i).norm(), O.forces.t(i).norm() / radius) for i in free)
    return force / largest_force(net.forces)


def relax(folder):
    global net
    net = build(folder, DAMPING, "add_forces(net, 1.0)")
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


folder, case, name = sys.argv[1:4]
rows, steps, reached = relax(folder)
again, _, _ = relax(folder)
write(
    case,
    name,
    field_columns(net.plane),
    rows,
    inputs=files(folder),
    repeat=(difference(rows, again), "the same input run twice in one process with one thread (-j1)"),
    kind="yade",
    about=f"Equilibrium of {len(net.particles)} particles and {len(net.bonds)} bonds, in the order of particles.csv; "
    f"local damping {DAMPING}, {steps} steps, unbalanced forces at last {reached:.1e} of the largest load.",
    source="Run for Seam, from a network that Seam exported; YADE's own contact law and integrator",
    code="YADE, the Debian package yade; Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
    version=version(),
    command=f"seam references regenerate --with yade {case}/{name} --accept",
    machine=machine(),
)
