"""Brings an exported network to rest in YADE: displacement and rotation of every particle.

yade -n -x -j1 references/generators/yade/static.py FOLDER CASE NAME
"""

import math
import sys
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, add_forces, build, hand_in, motion, unbalanced
from exported import field_columns, how_scaled, kept, largest_force, load_share, scaled

STEPS_BETWEEN_LOOKS = 50
# The step is 0.7 of the critical one: the fastest mode takes more than four steps, and damping every other one misses none.
STEPS_BETWEEN_DAMPING = 2
MOST_STEPS = 2_000_000


def damp_and_load():
    """Mass-proportional damping, on velocities before the particles move: the bonds see the velocities that moved them."""
    if keep < 1.0 and O.iter % STEPS_BETWEEN_DAMPING == 0:
        for state in free:
            state.vel *= keep
            state.angVel *= keep
    add_forces(net, load_share(net.run))


def quarter_period():
    """Steps until the kinetic energy of the undamped start peaks: a quarter of the period of the slowest mode."""
    energy = highest = 0.0
    while energy >= 0.9 * highest:
        O.run(STEPS_BETWEEN_LOOKS, True)
        energy = sum(state.mass * state.vel.squaredNorm() for state in free)
        if energy >= highest:
            highest, quarter = energy, O.iter
    return quarter


def relax(folder):
    """At the critical rate of the slowest mode, 2ω, until displacements no longer change within its period."""
    global net, free, keep
    keep = 1.0
    net = build(folder, 0.0, "damp_and_load()")
    bodies = [body.state for body in O.bodies]
    free = [bodies[p] for p in range(len(bodies)) if p not in set(net.clamped)]
    quarter = quarter_period()
    keep = math.exp(-STEPS_BETWEEN_DAMPING * math.pi / quarter)
    change = math.inf
    while change > net.run["settled"]:
        if O.iter > MOST_STEPS:
            sys.exit(f"not at rest after {O.iter} steps: displacements still change by {change:.1e}")
        before = [state.pos for state in bodies]
        O.run(4 * quarter, True)
        largest = max((state.pos - state.refPos).norm() for state in bodies)
        change = max((state.pos - at).norm() for state, at in zip(bodies, before)) / largest
    rows = [kept(motion(i), net.plane) for i in range(len(net.particles))]
    return scaled(rows, net.run), O.iter, unbalanced(net) / (load_share(net.run) * largest_force(net.forces))


folder, case, name = sys.argv[1:4]
rows, steps, reached = relax(folder)
again, _, _ = relax(folder)
hand_in(
    folder,
    case,
    name,
    field_columns(net.plane),
    rows,
    again,
    f"Equilibrium of {len(net.particles)} particles and {len(net.bonds)} bonds, in the order of particles.csv; "
    f"{how_scaled(net.run)}viscous damping, {steps} steps, until displacements change by less than {net.run['settled']:.0e} in "
    f"a period; unbalanced forces at last {reached:.1e} of the largest load.",
)
