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
    """Particles, bonds (stiffness times weight), supports {particle: {component: value}}, those of them that are clamped,
    forces {particle: (x, y, z)} and run."""
    folder = Path(folder)
    run = tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))
    particles = [SimpleNamespace(**row, at=(row["x"], row["y"], row["z"])) for row in table(folder / "particles.csv")]
    bonds = []
    for row in table(folder / "bonds.csv"):
        i, j, weight = int(row["i"]), int(row["j"]), row["weight"]
        length = sum((a - b) ** 2 for a, b in zip(particles[i].at, particles[j].at)) ** 0.5
        stiffness = {k: weight * row[k] for k in ("kn", "ks", "kb", "kt")}
        bonds.append(SimpleNamespace(i=i, j=j, length=length, radius=row["radius_m"], **stiffness))
    plane = run["space"] == "plane"
    held = supports(table(folder / "supports.csv"))
    return SimpleNamespace(
        particles=particles,
        bonds=bonds,
        held=held,
        clamped=[p for p, parts in held.items() if len(parts) == (3 if plane else 6) and not any(parts.values())],
        forces=forces(table(folder / "loads.csv")),
        plane=plane,
        run=run,
    )


def supports(rows):
    """Supported particles, ascending, each with {component: prescribed value}."""
    held = {}
    for row in rows:
        held.setdefault(int(row["particle"]), {})[row["component"]] = row["value"]
    return dict(sorted(held.items()))


def only_clamped(net):
    """For codes that hold a particle whole or not at all."""
    for particle in net.held.keys() - set(net.clamped):
        sys.exit(f"supports.csv: particle {particle} is held in part, or moved; only clamped particles are known here")


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


def load_share(run):
    """Share of the load that a code is given: a small one keeps a comparison with linear bonds free of second order."""
    return run.get("load_share", 1.0)


def scaled(rows, run, given=0):
    """Answers to that share as answers to the whole load; the first columns are no answer but given."""
    return [(*row[:given], *(value / load_share(run) for value in row[given:])) for row in rows]


def how_scaled(run):
    """Says so."""
    share = load_share(run)
    return "" if share == 1.0 else f"answers to {share:g} of the load, scaled to all of it; "


def half_difference(ahead, behind, given=0):
    """Half the difference of the answers to a load and to its opposite, in which nothing of second order is left; the
    first columns are no answer but given."""
    return [(*p[:given], *(0.5 * (a - b) for a, b in zip(p[given:], q[given:]))) for p, q in zip(ahead, behind)]


BOTH_WAYS = "half the difference of the answers to the load and to its opposite, so that nothing of second order is left"


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


def report(out, seconds, memory, rows, version):
    """What a race needs: time, memory and who ran in one file, where everything ended in the other."""
    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    (out / "time.toml").write_text(f"seconds = {seconds!r}\nmemory_mb = {memory!r}\nversion = {version}\n")
    lines = [",".join(map(repr, row)) for row in rows]
    (out / "final.csv").write_text("\n".join(["ux,uy,uz", *lines]) + "\n")
