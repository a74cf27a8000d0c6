"""Loads an exported network in YADE, bond by bond: which bond breaks, how far what is moved has come, and the force on it.

yade -n -x -j1 references/generators/yade/breaking.py FOLDER CASE NAME

YADE's own strength looks at normal and shear force only. Here a bond breaks by the tension at its rim, bending included:
σ = N/A + r M/I, M being the larger of the moments at its two ends. What is moved moves slowly and stops; a bond is judged when
all is at rest. The one with the largest σ over strength goes first, and nothing is moved until no bond is above its strength.
"""

import math
import sys
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, build, hand_in, unbalanced
from exported import table
from yade import Vector3

DAMPING = 0.3
STEPS_OF_A_MOVE = 2000
STEPS_BETWEEN_LOOKS = 500
MOST_STEPS = 5_000_000
# What is moved goes this share beyond the point where the next bond is expected to fail.
BEYOND = 1e-4
# The first move, as a share of the length of a bond: far below failure, and far above the rounding of positions.
FIRST_MOVE = 1e-5


def move():
    """Velocities of what is moved; nothing else may be touched between steps, for shear is integrated from velocities."""
    velocity = speed if O.iter < until else 0.0
    for particle, axis, way in moved:
        state = O.bodies[particle].state
        vel = Vector3(state.vel)
        vel[axis] = way * velocity
        state.vel = vel


def advance(distance):
    global speed, until
    speed, until = distance / (STEPS_OF_A_MOVE * O.dt), O.iter + STEPS_OF_A_MOVE
    O.run(STEPS_OF_A_MOVE, True)
    settle()


def force():
    """On what is moved, along its motion."""
    return -sum(O.forces.f(particle)[axis] * way for particle, axis, way in moved)


def settle():
    """Waits until all is at rest, twice in a row: forces may all pass through zero at one look."""
    quiet = 0
    while quiet < 2:
        if O.iter > MOST_STEPS:
            sys.exit(f"not at rest after {O.iter} steps")
        O.run(STEPS_BETWEEN_LOOKS, True)
        quiet = quiet + 1 if unbalanced(net) <= net.run["residual"] * abs(force()) else 0


def demand(bond):
    """σ over strength."""
    contact = O.interactions[bond.i, bond.j]
    n, phys = contact.geom.normal, contact.phys
    area, inertia = math.pi * bond.radius**2, math.pi * bond.radius**4 / 4
    arm = 0.5 * bond.length * n.cross(phys.shearForce)
    bending = max((phys.moment_bending + arm).norm(), (phys.moment_bending - arm).norm())
    return (-phys.normalForce.dot(n) / area + bond.radius * bending / inertia) / strength[bond.number]


def worst():
    return max(((demand(bond), bond) for bond in alive), key=lambda pair: pair[0])


def tear(folder):
    """One row for each bond, in the order they break."""
    global net, moved, strength, alive, speed, until
    speed, until = 0.0, 0
    net = build(folder, DAMPING, "move()")
    parts = ((particle, "xyz".index(name[1]), way) for particle, held in net.held.items() for name, way in held.items())
    moved = [part for part in parts if part[2]]
    strength = {int(row["bond"]): row["strength_Pa"] for row in table(Path(folder) / "strengths.csv")}
    for number, bond in enumerate(net.bonds):
        bond.number = number
    alive = [bond for bond in net.bonds if bond.number in strength]
    at = FIRST_MOVE * net.bonds[0].length
    advance(at)
    rows = []
    while len(rows) < net.run["events"]:
        load, bond = worst()
        if load < 1.0:
            # Nearly linear: a step that is a little short is followed by another.
            further = at * ((1.0 + BEYOND) / load - 1.0)
            advance(further)
            at += further
            continue
        before = force()
        O.interactions.erase(bond.i, bond.j)
        alive.remove(bond)
        settle()
        rows.append((bond.i, bond.j, at, before, force()))
    return rows, O.iter


folder, case, name = sys.argv[1:4]
rows, steps = tear(folder)
again, _ = tear(folder)
hand_in(
    folder,
    case,
    name,
    {
        "i": ("1", "first particle of the bond that breaks, as in bonds.csv"),
        "j": ("1", "second particle of it"),
        "displacement": ("m", "displacement of what is moved"),
        "force": ("N", "force on it, before"),
        "force_after": ("N", "force on it after the break, at the same displacement"),
    },
    rows,
    again,
    f"The first {len(rows)} bonds that break in a notched network of {len(net.particles)} particles and {len(net.bonds)} "
    f"bonds, loaded slowly with local damping {DAMPING}, {steps} steps; at rest to {net.run['residual']:.0e} of the force "
    "on what is moved whenever a bond is judged, by the criterion in the script.",
)
