#!/usr/bin/env python3
"""Elastic constants of homogenised random packings of spheres against the bond radius.

Run from anywhere: python3 references/generators/prototype/homogenised_packing.py

The numbers are restated: no code that computed them is kept, so this script holds them as they were
noted, digit for digit.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from reference import write

COLUMNS = {
    "radius_ratio": ("1", "bond radius over mean radius of the two particles, r̃ = 2 r_b/(R_i + R_j)"),
    "young_ratio": ("1", "homogenised Young's modulus over that of the bonds, E/E_μ"),
    "poisson": ("1", "homogenised Poisson's ratio ν"),
    "affine_young_ratio": ("1", "E/E_μ of the affine law, an upper bound"),
    "affine_poisson": ("1", "ν of the affine law"),
}
# Text, so that the digits stay as they were noted.
ROWS = [
    ("0.3", "0.0270", "0.315", "0.0495", "0.229"),
    ("0.5", "0.1122", "0.239", "0.1555", "0.194"),
    ("0.71", "0.2988", "0.169", "0.3668", "0.142"),
    ("0.9", "0.5799", "0.110", "0.6830", "0.085"),
]

write(
    "homogenised-packing",
    "prototype",
    COLUMNS,
    ROWS,
    inputs={},
    repeat=(0.01, "scatter between packing seeds at N = 600; the scatter at N = 2000 was not noted"),
    kind="prototype",
    about="Periodic homogenisation of random packings of N = 2000 spheres, radii within ±20 %, solid fraction 0.64, "
    "6.2 bonds per sphere, bonds with ν_μ = 0.3. The affine law is α = 3 (r/L)², ν = (1−α)/(4+α), "
    "E = (Σ l² k_n / 3V)(2+3α)/(4+α). How the packing was made and how its bonds were chosen was not noted, "
    "and two protocols may differ by 2 %.",
    source="Restated from the project's own notes on mechanics; in no publication. According to the notes, "
    "rebuilt twice independently.",
    code="prototypes, not kept",
    version="not recorded",
    command="python3 references/generators/prototype/homogenised_packing.py",
    machine="not recorded",
)
