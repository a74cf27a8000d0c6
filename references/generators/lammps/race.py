"""Times an exported network that vibrates freely in LAMMPS.

[mpiexec -n RANKS] <python of the virtual environment> references/generators/lammps/race.py FOLDER OUT
"""

import ctypes
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from bonded import build, version
from exported import memory_mb, report, table

folder, out = sys.argv[1:3]
net, lmp = build(folder)
rows = table(Path(folder) / "velocities.csv")
velocity = [row[v] for row in rows for v in ("vx", "vy", "vz")]
lmp.scatter_atoms("v", 1, 3, (ctypes.c_double * len(velocity))(*velocity))
lmp.command("run 0")
start = time.perf_counter()
lmp.command(f"run {net.run['steps']} pre no post no")
seconds = time.perf_counter() - start
at = lmp.gather_atoms("x", 1, 3)
if lmp.extract_setting("world_rank") == 0:
    ranks = lmp.extract_setting("world_size")
    moved = [tuple(at[3 * k + i] - p.at[i] for i in range(3)) for k, p in enumerate(net.particles)]
    # Ranks share the work alike: the memory of one stands for each.
    report(out, seconds, ranks * memory_mb(), moved, version(lmp))
# Not before the first rank has written: one that leaves without finalising takes all others with it, and mpiexec says
# nothing of it.
lmp.finalize()
