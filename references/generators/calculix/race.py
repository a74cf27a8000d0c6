"""Times linear statics of an exported mesh in CalculiX.

python3 references/generators/calculix/race.py FOLDER OUT; threads as in OMP_NUM_THREADS
"""

import os
import resource
import sys
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import ccx
from exported import AXES, report, table

folder, out = Path(sys.argv[1]), sys.argv[2]
threads = os.environ.get("OMP_NUM_THREADS", "1")
for name in ccx.ENVIRONMENT.keys() & {"OMP_NUM_THREADS", "CCX_NPROC_STIFFNESS", "CCX_NPROC_EQUATION_SOLVER"}:
    ccx.ENVIRONMENT[name] = threads
run = tomllib.loads((folder / "run.toml").read_text())
nodes = [(row["x"], row["y"], row["z"]) for row in table(folder / "nodes.csv")]
cells = [[int(row[f"n{k}"]) for k in range(1, 9)] for row in table(folder / "elements.csv")]
fixed = sorted({int(row["node"]) for row in table(folder / "supports.csv")})
forces = {}
for row in table(folder / "loads.csv"):
    forces.setdefault(int(row["node"]), [0.0] * 3)[AXES.index(row["component"][1])] += row["value"]
text = ccx.deck(run["element"], nodes, cells, fixed, forces, run["young_Pa"], run["poisson"])
displacements, seconds = ccx.run(text, 3)
memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
report(out, seconds, memory, [tuple(map(float, u)) for u in displacements], ccx.version())
