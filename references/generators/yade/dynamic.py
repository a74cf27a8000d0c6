"""Moves an exported network in YADE without damping: history of what is watched, one particle or several.

yade -n -x -j1 references/generators/yade/dynamic.py FOLDER CASE NAME
"""

import sys
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, add_forces, build, hand_in, motion
from exported import history_columns, how_scaled, kept, load_share, scaled


def look_and_load():
    """Positions and forces are those of O.time, also the load factor."""
    if O.iter % net.run["every"] == 0:
        watched = net.run["watched"]
        if isinstance(watched, int):
            rows.append((O.time, *kept(motion(watched), net.plane)))
        else:
            rows.extend((O.time, p, *kept(motion(p), net.plane)) for p in watched)
    add_forces(net, load_share(net.run) * min(O.time / net.run["rise_s"], 1.0))


def run(folder):
    global net, rows
    net, rows = build(folder, 0.0, "look_and_load()"), []
    O.run(net.run["steps"] + 1, True)
    return scaled(rows, net.run, given=1 if isinstance(net.run["watched"], int) else 2)


folder, case, name = sys.argv[1:4]
first = run(folder)
again = run(folder)
several = not isinstance(net.run["watched"], int)
columns = history_columns(net.plane)
if several:
    columns = {"t": columns.pop("t"), "particle": ("1", "particle, as in particles.csv"), **columns}
what = f"{len(net.run['watched'])} particles" if several else f"particle {net.run['watched']}"
hand_in(
    folder,
    case,
    name,
    columns,
    first,
    again,
    f"Motion of {what} of {len(net.particles)} particles and {len(net.bonds)} bonds, {how_scaled(net.run)}undamped, "
    f"{net.run['steps']} steps of {net.run['step_s']} s.",
)
