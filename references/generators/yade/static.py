"""Brings an exported network to rest in YADE: displacement and rotation of every particle.

yade -n -x -j1 references/generators/yade/static.py FOLDER CASE NAME
"""

import sys
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, add_forces, build, motion, version
from exported import difference, field_columns, files, how_scaled, kept, largest_force, load_share, network, scaled
from reference import machine, write

# Cundall's local damping, unless the run asks for more; it acts on velocities inside the integrator and leaves the shear whole.
DAMPING = 0.3
STEPS_BETWEEN_LOOKS = 1000
MOST_STEPS = 2_000_000


def residual(net, free, radius):
    """Largest unbalanced force or moment over radius of what is free, relative to the largest load."""

    def of(particle):
        held = net.held.get(particle, {})
        size = lambda vector, letter: sum(v * v for v, axis in zip(vector, "xyz") if letter + axis not in held) ** 0.5
        return max(size(O.forces.f(particle), "u"), size(O.forces.t(particle), "r") / radius)

    return max(map(of, free)) / (load_share(net.run) * largest_force(net.forces))


def relax(folder):
    global net, damping
    run = network(folder).run
    damping = run.get("damping", DAMPING)
    net = build(folder, damping, f"add_forces(net, {load_share(run)!r})")
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
    return scaled(rows, net.run), O.iter, residual(net, free, radius)


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
    f"{how_scaled(net.run)}local damping {damping}, {steps} steps, unbalanced forces at last {reached:.1e} of the largest load.",
    source="Run for Seam, from a network that Seam exported; YADE's own contact law and integrator",
    code="YADE, the Debian package yade; Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
    version=version(),
    command=f"seam references regenerate --with yade {case}/{name} --accept",
    machine=machine(),
)
