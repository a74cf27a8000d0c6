"""Writes a reference: the CSV, and beside it the provenance with the hash of the CSV.

Plain Python (3.9 or later), no dependencies; the generators import it. Nothing else writes below
references/data.
"""

import datetime
import hashlib
import json
import os
import platform
from pathlib import Path

# Where `seam references regenerate` wants the new files, to compare them before they replace anything.
DATA = Path(os.environ.get("SEAM_REFERENCES", Path(__file__).resolve().parent.parent / "data"))


def sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def machine() -> str:
    """Class of this machine: processor, cores and system, but not its name."""
    try:
        system = platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, AttributeError):
        system = platform.system()
    return f"{platform.machine()}, {os.cpu_count()} cores, {system}"


def write(case, name, columns, rows, *, inputs, repeat, **fields):
    """Writes data/<case>/<name>.csv and .toml.

    columns: {name: (unit, about)} in the order of the CSV; rows: tuples of numbers or of text that is
    written as it stands; inputs: {file name: bytes}; repeat: (difference, about); fields: kind, about,
    source, code, version, command, machine.
    """
    folder = DATA / case
    folder.mkdir(parents=True, exist_ok=True)
    lines = [",".join(columns)] + [",".join(map(str, row)) for row in rows]
    csv = ("\n".join(lines) + "\n").encode()
    # A JSON string without exotic characters is a TOML basic string.
    text = lambda value: json.dumps(value, ensure_ascii=False)
    toml = [f"id = {text(f'{case}/{name}')}"]
    for key in ("kind", "about", "source", "code", "version", "command"):
        toml.append(f"{key} = {text(fields[key])}")
    toml += [
        f"date = {datetime.date.today().isoformat()}",
        f"machine = {text(fields['machine'])}",
        f"csv_sha256 = {text(sha256(csv))}",
        f"repeat = {{ difference = {float(repeat[0])!r}, about = {text(repeat[1])} }}",
        "",
        "[inputs]",
    ]
    toml += [f"{text(file)} = {text(sha256(data))}" for file, data in inputs.items()]
    toml += ["", "[columns]"]
    toml += [
        f"{column} = {{ unit = {text(unit)}, about = {text(about)} }}"
        for column, (unit, about) in columns.items()
    ]
    (folder / f"{name}.csv").write_bytes(csv)
    (folder / f"{name}.toml").write_text("\n".join(toml) + "\n", encoding="utf-8", newline="\n")
    print(f"wrote {case}/{name}: {len(rows)} rows")
