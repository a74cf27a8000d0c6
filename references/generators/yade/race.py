"""Times an exported network that vibrates freely in YADE.

yade -n -x -jTHREADS references/generators/yade/race.py FOLDER OUT
"""

import sys
import time
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, build, version
from exported import memory_mb, network, report, table
from yade import Vector3


def look():
    marks.append(time.perf_counter())
    if O.iter == 0:
        # Not before: the bonds would take these velocities for a step that has been made, and start sheared.
        for body, row in zip(O.bodies, velocities):
            body.state.vel = Vector3(row["vx"], row["vy"], row["vz"])


folder, out = sys.argv[1:3]
marks = []
velocities = table(Path(folder) / "velocities.csv")
net = build(folder, 0.0, "look()", every=network(folder).run["steps"])
O.run(net.run["steps"], True)
displacements = [tuple(body.state.pos - body.state.refPos) for body in O.bodies]
# The second mark is set at the next step: O.run itself looks for the end only now and then.
O.run(1, True)
report(out, marks[1] - marks[0], memory_mb(), displacements, version())
