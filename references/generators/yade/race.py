"""Times an exported network that vibrates freely in YADE.

yade -n -x -jTHREADS references/generators/yade/race.py FOLDER OUT
"""

import sys
import time
from pathlib import Path

# YADE runs this file by its own __file__.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))

from bonded import O, build
from exported import memory_mb, report, table
from yade import Vector3

folder, out = sys.argv[1:3]
marks = []
net = build(folder, 0.0, "marks.append(time.perf_counter())", every=10**9)
steps = net.run["steps"]
# Called at the first step and at the last but one, whose time is left out: O.run itself looks for the end only now and then.
O.engines[2].iterPeriod = steps
for row in table(Path(folder) / "velocities.csv"):
    O.bodies[int(row["particle"])].state.vel = Vector3(row["vx"], row["vy"], row["vz"])
O.run(steps, True)
displacements = [tuple(b.state.pos - b.state.refPos) for b in O.bodies]
O.run(1, True)
report(out, marks[1] - marks[0], memory_mb(), displacements)
