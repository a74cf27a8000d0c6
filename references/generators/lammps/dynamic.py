"""Moves an exported network in LAMMPS without damping: history of the watched particle.

<python of the virtual environment> references/generators/lammps/dynamic.py FOLDER CASE NAME
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from bonded import Motion, build, hand_in, version
from exported import BOTH_WAYS, half_difference, history_columns, kept, network


def run(folder, sign):
    rise = network(folder).run["rise_s"]
    net, lmp = build(folder, f"{sign}*((step*dt<{rise!r})*step*dt/{rise!r}+(step*dt>={rise!r}))")
    motion, watched = Motion(net, lmp), net.run["watched"]
    rows = []
    for k in range(net.run["steps"] // net.run["every"] + 1):
        if k > 0:
            lmp.command(f"run {net.run['every']} pre no post no")
        rows.append((k * net.run["every"] * net.run["step_s"], *kept(motion.rows([watched])[0], net.plane)))
    label = version(lmp)
    lmp.close()
    return net, rows, label


def answer(folder):
    """Second-order effects of small rotations drop out; large ones are the question."""
    net, rows, label = run(folder, 1)
    if net.run["rotations"] == "finite":
        return net, rows, label, ""
    return net, half_difference(rows, run(folder, -1)[1], given=1), label, f"; {BOTH_WAYS}"


folder, case, name = sys.argv[1:4]
net, rows, label, how = answer(folder)
again = answer(folder)[1]
hand_in(
    folder,
    case,
    name,
    history_columns(net.plane),
    rows,
    again,
    label,
    f"Motion of particle {net.run['watched']} of {len(net.particles)} particles and {len(net.bonds)} bonds, "
    f"undamped, {net.run['steps']} steps of {net.run['step_s']} s{how}.",
)
