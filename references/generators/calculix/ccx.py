"""Runs CalculiX on a bar of quadrilaterals or hexahedra, reads the displacements of its nodes, and hands in references.

Needs the program ccx, in Debian: apt-get install calculix-ccx
"""

import math
import os
import re
import subprocess
import sys
import tempfile
import time
from itertools import product
from pathlib import Path

from reference import machine, write

# One thread: the order of additions, and with it the last bits, stays the same.
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", CCX_NPROC_STIFFNESS="1", CCX_NPROC_EQUATION_SOLVER="1")
MISSING = "ccx not found: install CalculiX (Debian: apt-get install calculix-ccx)"
# CalculiX reads 20 characters per number, and the CSV must hold what it read.
PLACES = 12


def call(arguments, folder):
    try:
        return subprocess.run(
            ["ccx", *arguments], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True
        ).stdout
    except FileNotFoundError:
        sys.exit(MISSING)


def version():
    """Version that ccx reports, e.g. 2.20."""
    found = re.search(r"Version\s+(\S+)", call(["-v"], None))
    if found is None:
        sys.exit("ccx -v names no version")
    return found.group(1)


def hand_in(script, case, name, columns, rows, change, inputs, about):
    """Writes a reference of CalculiX; `change` is how far a second run of the same inputs {file: text} differs."""
    write(
        case,
        name,
        columns,
        rows,
        inputs={file: text.encode() for file, text in inputs.items()},
        repeat=(change, "the same input run twice on one machine with one thread; numbers as printed, 7 digits"),
        kind="calculix",
        about=about,
        source="Run for Seam, from an input that the generator writes and Seam has no part in",
        code="CalculiX CrunchiX (ccx), the Debian package calculix-ccx",
        version=version(),
        command=f"python3 references/generators/calculix/{Path(script).name}",
        machine=machine(),
    )


def bent_grid(lengths, divisions, bend):
    """Nodes of a box [0, l_i] with x varying fastest, then y, then z.

    With s_i = x_i/l_i a node moves by bend · l_i · sin(π s_i) · sin(2π s_j) along each axis i, j being
    the next axis: elements lose their right angles, the sides of the box stay flat.
    """
    dimensions = len(lengths)
    nodes = []
    for at in product(*(range(n + 1) for n in reversed(divisions))):
        s = [k / n for k, n in zip(reversed(at), divisions)]
        moved = [
            lengths[i] * (s[i] + bend * math.sin(math.pi * s[i]) * math.sin(2 * math.pi * s[(i + 1) % dimensions]))
            for i in range(dimensions)
        ]
        nodes.append(tuple(round(x, PLACES) for x in moved))
    return nodes


def cells(divisions):
    """Corner nodes, from zero, of each element of the grid, in the order of CPE4 and C3D8."""
    strides = [1]
    for n in divisions[:-1]:
        strides.append(strides[-1] * (n + 1))
    for at in product(*(range(n) for n in reversed(divisions))):
        base = sum(k * s for k, s in zip(reversed(at), strides))
        ring = [base, base + 1, base + 1 + strides[1], base + strides[1]]
        yield ring + [node + strides[2] for node in ring] if len(divisions) == 3 else ring


def deck(element, nodes, elements, fixed, forces, young, poisson, thickness=1.0):
    """Input of ccx: linear statics, nodes of `fixed` held, `forces` {node: components}; numbers count from one."""
    line = lambda *fields: ", ".join(map(str, fields))
    dimensions = len(nodes[0])
    out = ["*NODE, NSET=ALL"]
    out += [line(k + 1, *(f"{x:.{PLACES}f}" for x in node)) for k, node in enumerate(nodes)]
    out += [f"*ELEMENT, TYPE={element}, ELSET=BODY"]
    for k, cell in enumerate(elements):
        # A line of an input holds at most 16 numbers; one that ends in a comma goes on.
        numbers = [str(n + 1) for n in cell]
        out += [line(k + 1, *numbers[:15]) + ("," if numbers[15:] else "")] + ([line(*numbers[15:])] if numbers[15:] else [])
    out += ["*NSET, NSET=FIXED"] + [str(node + 1) for node in fixed]
    out += ["*MATERIAL, NAME=M", "*ELASTIC", line(young, poisson), "*SOLID SECTION, ELSET=BODY, MATERIAL=M"]
    # A plane section is followed by its thickness.
    out += [repr(thickness).removesuffix("0")] if dimensions == 2 else []
    out += ["*BOUNDARY", line("FIXED", 1, dimensions), "*STEP", "*STATIC", "*CLOAD"]
    out += [line(node + 1, i + 1, f) for node, force in forces.items() for i, f in enumerate(force) if f != 0.0]
    out += ["*NODE PRINT, NSET=ALL", "U", "*END STEP", ""]
    return "\n".join(out)


def run(text, dimensions):
    """Displacements of all nodes as the text that ccx prints, and the seconds it took."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "bar.inp").write_text(text)
        start = time.monotonic()
        log = call(["bar"], folder)
        seconds = time.monotonic() - start
        table = Path(folder) / "bar.dat"
        if not table.is_file() or "Job finished" not in log:
            sys.exit("ccx failed:\n" + log[-2000:])
        fields = [line.split() for line in table.read_text().splitlines()]
    rows = [row for row in fields if row and row[0].isdigit()]
    return [tuple(row[1 : 1 + dimensions]) for row in rows], seconds
