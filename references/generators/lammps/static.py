"""Brings an exported network to rest in LAMMPS: displacement and rotation of every particle.

<python of the virtual environment> references/generators/lammps/static.py FOLDER CASE NAME
"""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from bonded import Motion, bond_coefficients, build, hand_in, version
from exported import BOTH_WAYS, field_columns, half_difference, kept, largest_force

STEPS_BETWEEN_LOOKS = 10
MOST_STEPS = 2_000_000


def relax(folder, factor):
    """Viscous damping at the critical rate of the slowest mode: 2ω on translations, and in the bonds on turning.

    fix viscous does not damp rotations. ω is read off the undamped start, whose kinetic energy peaks after a quarter period.
    """
    net, lmp = build(folder, factor)
    arrays = lmp.numpy
    velocity, mass, position = (arrays.extract_atom(name) for name in ("v", "rmass", "x"))
    force, torque = arrays.extract_atom("f"), arrays.extract_atom("torque")
    motion = Motion(net, lmp)
    free = motion.order[[p for p in range(len(net.particles)) if p not in set(net.clamped)]]
    start, steps = position.copy(), 0

    def run(count):
        nonlocal steps
        lmp.command(f"run {count} pre no post no")
        steps += count

    energy = highest = 0.0
    while energy >= 0.9 * highest:
        run(STEPS_BETWEEN_LOOKS)
        energy = float((mass * (velocity**2).sum(axis=1)).sum())
        if energy >= highest:
            highest, quarter = energy, steps
    damp(lmp, net, math.pi / (quarter * net.run["step_s"]))
    lmp.command("run 0")
    change = 1.0
    while change > net.run["settled"]:
        if steps > MOST_STEPS:
            sys.exit(f"not at rest after {steps} steps: displacements still change by {change:.1e}")
        before = position.copy()
        run(4 * quarter)
        change = float(abs(position - before).max() / abs(position - start).max())
    size = lambda a: (a[free] ** 2).sum(axis=1).max() ** 0.5
    residual = float(max(size(force), size(torque) / net.particles[0].radius) / largest_force(net.forces))
    label = version(lmp)
    rows = [kept(row, net.plane) for row in motion.rows(range(len(net.particles)))]
    lmp.close()
    return net, rows, steps, residual, label


def answer(folder):
    net, ahead, steps, residual, label = relax(folder, "1.0")
    behind = relax(folder, "-1.0")[1]
    return net, half_difference(ahead, behind), steps, residual, label


def damp(lmp, net, rate):
    """`rate` is 2ω in 1/s. In the bonds, sliding damps particles that all turn alike, rolling and twisting those that do not."""
    p = net.particles[0]
    lmp.command(f"fix drag all viscous {rate * p.mass!r}")
    sliding, turning = rate * p.inertia / p.radius**2, rate * p.inertia
    bond_coefficients(lmp, net, f"0 {sliding!r} {turning!r} {turning!r}")


folder, case, name = sys.argv[1:4]
net, rows, steps, reached, label = answer(folder)
again = answer(folder)[1]
hand_in(
    folder,
    case,
    name,
    field_columns(net.plane),
    rows,
    again,
    label,
    f"Equilibrium of {len(net.particles)} particles and {len(net.bonds)} bonds, in the order of particles.csv; "
    f"{BOTH_WAYS}; viscous damping, {steps} steps, until displacements change by less than {net.run['settled']:.0e} in a period; unbalanced forces at last "
    f"{reached:.1e} of the largest load, which is the rounding of LAMMPS's arc cosines.",
)
