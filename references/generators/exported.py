"""Reads a folder that `seam export` wrote: a network of particles and bonds, its supports, loads and run.

Plain Python (3.11 or later), no dependencies.
"""

import csv
import math
import resource
import sys
import tomllib
from pathlib import Path
from types import SimpleNamespace

AXES = "xyz"


def table(path):
    """Rows as dictionaries of numbers where they are numbers."""

    def value(text):
        try:
            return float(text)
        except ValueError:
            return text

    with open(path, newline="", encoding="utf-8") as file:
        return [{name: value(text) for name, text in row.items()} for row in csv.DictReader(file)]


def files(folder):
    """Content of each exported file, for its hash."""
    return {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}


def network(folder):
    """Particles, bonds (stiffness times weight), clamped particles, forces {particle: (x, y, z)} and run."""
    folder = Path(folder)
    run = tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))
    particles = [SimpleNamespace(**row, at=(row["x"], row["y"], row["z"])) for row in table(folder / "particles.csv")]
    bonds = []
    for row in table(folder / "bonds.csv"):
        i, j, weight = int(row["i"]), int(row["j"]), row["weight"]
        length = sum((a - b) ** 2 for a, b in zip(particles[i].at, particles[j].at)) ** 0.5
        stiffness = {k: weight * row[k] for k in ("kn", "ks", "kb", "kt")}
        bonds.append(SimpleNamespace(i=i, j=j, length=length, **stiffness))
    plane = run["space"] == "plane"
    return SimpleNamespace(
        particles=particles,
        bonds=bonds,
        clamped=clamped(table(folder / "supports.csv"), 3 if plane else 6),
        forces=forces(table(folder / "loads.csv")),
        plane=plane,
        run=run,
    )


def clamped(rows, components):
    """Particles of which nothing moves; other supports are not known here."""
    held = {}
    for row in rows:
        if row["value"] != 0.0:
            sys.exit(f"supports.csv: particle {int(row['particle'])} is moved; only clamped particles are known here")
        held.setdefault(int(row["particle"]), set()).add(row["component"])
    for particle, which in held.items():
        if len(which) != components:
            sys.exit(f"supports.csv: particle {particle} is held in part; only clamped particles are known here")
    return sorted(held)


def forces(rows):
    total = {}
    for row in rows:
        if row["component"][0] != "f":
            sys.exit(f"loads.csv: a moment on particle {int(row['particle'])}; only forces are known here")
        force = total.setdefault(int(row["particle"]), [0.0, 0.0, 0.0])
        force[AXES.index(row["component"][1])] += row["value"]
    return {particle: tuple(force) for particle, force in total.items()}


def largest_force(forces):
    return max(sum(f * f for f in force) ** 0.5 for force in forces.values())


def field_columns(plane):
    """Columns of a field: displacements, then rotations."""
    axes, turns = ("xy", "z") if plane else ("xyz", "xyz")
    columns = {f"u{a}": ("m", f"displacement of the particle along {a}") for a in axes}
    columns.update({f"r{a}": ("rad", f"rotation of the particle about {a}") for a in turns})
    return columns


def history_columns(plane):
    """Columns of a history: time, then those of a field."""
    return {"t": ("s", "time"), **field_columns(plane)}


def kept(row, plane):
    """Of six components those of the plane, or all."""
    return (row[0], row[1], row[5]) if plane else tuple(row)


def rotation_vector(w, x, y, z):
    """Rotation vector of a unit quaternion, by its vector part: small angles keep their digits."""
    size = math.sqrt(x * x + y * y + z * z)
    if size == 0.0:
        return (0.0, 0.0, 0.0)
    angle = 2.0 * math.atan2(size, abs(w))
    factor = math.copysign(angle / size, w)
    return (factor * x, factor * y, factor * z)


def difference(first, second):
    """Largest difference of any number, relative to the largest of its column."""
    worst = 0.0
    for a, b in zip(zip(*first), zip(*second)):
        scale = max(map(abs, a))
        change = max(abs(p - q) for p, q in zip(a, b))
        worst = max(worst, change / scale if scale > 0.0 else change)
    return worst


def memory_mb():
    """Largest memory of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def report(out, seconds, memory, rows):
    """What a race needs: time and memory in one file, where everything ended in the other."""
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    (out / "time.toml").write_text(f"seconds = {seconds!r}\nmemory_mb = {memory!r}\n")
    lines = [",".join(map(repr, row)) for row in rows]
    (out / "final.csv").write_text("\n".join(["ux,uy,uz", *lines]) + "\n")
