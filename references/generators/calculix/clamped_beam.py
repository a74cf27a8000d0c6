#!/usr/bin/env python3
"""Mid-line of the clamped beam in CalculiX: CPS8 (plane stress) and C3D20R (solid), on two meshes each.

Run from anywhere: python3 references/generators/calculix/clamped_beam.py

      y
      |  clamped at x = 0
    //|============================| | force F in -y as an even traction on x = l
    //|____________________________| v
                                         mid-line: y = h/2 (and z = t/2)
"""

import sys
from itertools import product
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from ccx import deck, hand_in, run

LENGTH_M, HEIGHT_M, THICKNESS_M = 0.9, 0.1, 0.1
YOUNG_PA, POISSON, FORCE_N = 30e9, 0.2, 1000.0
# CalculiX computes plane stress on solid elements whose faces must move alike, so that a change of thickness across the height
# costs shear: a strip as thick as it is high comes out 1.1 % too stiff. A thin one under its share of the force does not.
STRIP_M = 0.01 * THICKNESS_M
CASE, STATIONS = "clamped-beam-rotation", 36


def serendipity(lengths, divisions):
    """Nodes of quadratic elements in a box, x fastest, and the elements as CPS8 and C3D20R want their nodes.

    Nodes lie on a grid of half elements: corners have even places, nodes on edges one odd place.
    """
    place, nodes = {}, []
    for at in product(*(range(2 * n + 1) for n in reversed(divisions))):
        at = at[::-1]
        if sum(k % 2 for k in at) <= 1:
            place[at] = len(nodes)
            nodes.append(tuple(l * k / (2 * n) for l, k, n in zip(lengths, at, divisions)))
    ring = [(0, 0), (2, 0), (2, 2), (0, 2)]
    edges = [(1, 0), (2, 1), (1, 2), (0, 1)]
    if len(divisions) == 3:
        layer = lambda flat, z: [(*p, z) for p in flat]
        steps = layer(ring, 0) + layer(ring, 2) + layer(edges, 0) + layer(edges, 2) + layer(ring, 1)
    else:
        steps = ring + edges
    elements = []
    for at in product(*(range(n) for n in reversed(divisions))):
        base = [2 * k for k in at[::-1]]
        elements.append([place[tuple(b + s for b, s in zip(base, step))] for step in steps])
    return place, nodes, elements


def end_forces(place, divisions):
    """An even traction on the face x = l, as forces that add up to one: 1/6, 2/3, 1/6 on an edge; -1/12 in corners and 1/3 on
    edges of a face."""
    shares = {}
    across = divisions[1:]
    for cell in product(*(range(n) for n in across)):
        for step in product(*(range(3) for _ in across)):
            node = place.get((2 * divisions[0], *(2 * c + s for c, s in zip(cell, step))))
            odd = sum(s == 1 for s in step)
            if node is not None and (len(across) == 1 or odd < 2):
                corner, middle = (1 / 6, 2 / 3) if len(across) == 1 else (-1 / 12, 1 / 3)
                shares[node] = shares.get(node, 0.0) + (middle if odd else corner)
    total = sum(shares.values())
    return {node: share / total for node, share in shares.items()}


def mid_line(element, rows):
    """Text given to ccx, and u_y at the stations, as printed."""
    plane = element == "CPS8"
    sides = (LENGTH_M, HEIGHT_M, THICKNESS_M)[: 2 if plane else 3]
    force = -FORCE_N * (STRIP_M / THICKNESS_M if plane else 1.0)
    divisions = (round(rows * LENGTH_M / HEIGHT_M), *(rows for _ in sides[1:]))
    place, nodes, elements = serendipity(sides, divisions)
    fixed = [k for at, k in place.items() if at[0] == 0]
    forces = {node: (0.0, force * share, 0.0)[: len(sides)] for node, share in end_forces(place, divisions).items()}
    text = deck(element, nodes, elements, fixed, forces, YOUNG_PA, POISSON, STRIP_M)
    u, _ = run(text, len(sides))
    if len(u) != len(nodes):
        sys.exit(f"ccx printed {len(u)} of {len(nodes)} nodes")
    every = 2 * divisions[0] // STATIONS
    line = [place[(every * k, *(n for n in divisions[1:]))] for k in range(STATIONS + 1)]
    return text, [(nodes[k][0], u[k][1]) for k in line]


def generate(element, rows):
    name = f"{element.lower()}-calculix"
    text, fine = mid_line(element, rows)
    coarse_text, coarse = mid_line(element, rows // 2)
    again = mid_line(element, rows)[1]
    largest = max(abs(float(u)) for _, u in fine)
    change = max(abs(float(a) - float(b)) for (_, a), (_, b) in zip(fine, again)) / largest
    refined = max(abs(float(a) - float(b)) for (_, a), (_, b) in zip(fine, coarse)) / largest
    columns = {
        "x": ("m", "position along the mid-line"),
        "uy": ("m", "deflection, the finer mesh"),
        "uy_coarse": ("m", "deflection, half as many elements each way"),
    }
    hand_in(
        __file__,
        CASE,
        name,
        columns,
        [(x, u, c) for (x, u), (_, c) in zip(fine, coarse)],
        change,
        {f"{name}.inp": text, f"{name}-coarse.inp": coarse_text},
        f"Mid-line of the clamped beam {LENGTH_M} × {HEIGHT_M} × {THICKNESS_M} m under {FORCE_N:g} N, {element}, {rows} "
        f"elements across the height, E = {YOUNG_PA:g} Pa, ν = {POISSON:g}"
        + (f", a strip {STRIP_M:g} m thick under its share of the force" if element == "CPS8" else "")
        + f"; from half as many it moved by {refined:.1e} of the largest deflection.",
    )


if __name__ == "__main__":
    generate("CPS8", 16)
    generate("C3D20R", 8)
