#!/usr/bin/env python3
"""Nodal displacements of a clamped cantilever: CalculiX's CPE4 (plane strain) and C3D8 (solid).

Run from anywhere: python3 references/generators/calculix/cantilever.py

      y
      |  clamped at x = 0      ___ force F in -y (and F/2 in z), the same on each node of x = l
    //|=======================|
    //|_______________________|   --> x      mesh bent, see ccx.bent_grid
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from ccx import bent_grid, cells, deck, hand_in, run

YOUNG_PA, POISSON, FORCE_N = 70e9, 0.3, 1e6
# Share of the length of each side by which nodes move; elements of the meshes below stay convex.
BEND = 0.03
AXES = "xyz"


def cantilever(element, lengths, divisions):
    """Nodes, force on each node and the input of ccx."""
    nodes = bent_grid(lengths, divisions, BEND)
    end = [k for k, node in enumerate(nodes) if node[0] == lengths[0]]
    force = (0.0, -FORCE_N / len(end), 0.5 * FORCE_N / len(end))[: len(lengths)]
    forces = {node: force for node in end}
    fixed = [k for k, node in enumerate(nodes) if node[0] == 0.0]
    return nodes, forces, deck(element, nodes, cells(divisions), fixed, forces, YOUNG_PA, POISSON)


def largest(rows):
    return max(abs(float(u)) for row in rows for u in row)


def generate(element, lengths, divisions):
    dimensions = len(lengths)
    nodes, forces, text = cantilever(element, lengths, divisions)
    u, _ = run(text, dimensions)
    again, _ = run(text, dimensions)
    if len(u) != len(nodes):
        sys.exit(f"ccx printed {len(u)} of {len(nodes)} nodes")
    change = max(abs(float(a) - float(b)) for p, q in zip(u, again) for a, b in zip(p, q)) / largest(u)
    name = element.lower()
    axes = AXES[:dimensions]
    columns = {
        **{a: ("m", f"position of the node along {a}") for a in axes},
        **{f"f{a}": ("N", f"force on the node along {a}") for a in axes},
        **{f"u{a}": ("m", f"displacement of the node along {a}") for a in axes},
    }
    rest = (0.0,) * dimensions
    rows = [(*x, *forces.get(k, rest), *u[k]) for k, x in enumerate(nodes)]
    size = " × ".join(map(str, lengths)) + " m"
    hand_in(
        __file__,
        f"calculix-{name}",
        "calculix",
        columns,
        rows,
        change,
        {f"calculix-{name}.inp": text},
        f"Linear statics of a cantilever {size}, {' × '.join(map(str, divisions))} elements {element}, nodes "
        f"with x fastest; E = {YOUNG_PA:g} Pa, ν = {POISSON:g}"
        + (", plane strain, thickness 1 m" if dimensions == 2 else "")
        + "; all displacements zero at x = 0.",
    )


if __name__ == "__main__":
    generate("CPE4", (2.0, 0.4), (20, 5))
    generate("C3D8", (2.0, 0.4, 0.3), (10, 4, 3))
