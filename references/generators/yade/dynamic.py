"""Moves an exported network in YADE without damping: history of the watched particle.

yade -n -x -j1 references/generators/yade/dynamic.py FOLDER CASE NAME
"""

import sys
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, add_forces, build, motion, version
from exported import difference, files, history_columns, kept
from reference import machine, write


def look_and_load():
    """Positions and forces are those of O.time, also the load factor."""
    if O.iter % net.run["every"] == 0:
        rows.append((O.time, *kept(motion(net.run["watched"]), net.plane)))
    add_forces(net, min(O.time / net.run["rise_s"], 1.0))


def run(folder):
    global net, rows
    net, rows = build(folder, 0.0, "look_and_load()"), []
    O.run(net.run["steps"] + 1, True)
    return rows


folder, case, name = sys.argv[1:4]
first = run(folder)
again = run(folder)
write(
    case,
    name,
    history_columns(net.plane),
    first,
    inputs=files(folder),
    repeat=(difference(first, again), "the same input run twice in one process with one thread (-j1)"),
    kind="yade",
    about=f"Motion of particle {net.run['watched']} of {len(net.particles)} particles and {len(net.bonds)} bonds, "
    f"undamped, {net.run['steps']} steps of {net.run['step_s']} s.",
    source="Run for Seam, from a network that Seam exported; YADE's own contact law and integrator",
    code="YADE, the Debian package yade; Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
    version=version(),
    command=f"seam references regenerate --with yade {case}/{name} --accept",
    machine=machine(),
)
