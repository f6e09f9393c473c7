#!/usr/bin/env python3
"""Runs LAMMPS (Debian's package lammps) and GrainSolver on the same grains, one after the other and
several times in turn, and prints both rates and their ratio.

usage: run.py BUILD_FOLDER [--quick]

Rates are millions of particle-steps a second on one core, the best of the turns. `energy` is how far
the kinetic energies in the end are apart; of the monolayers' only the rates can be compared.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
TURNS = 3
# The peer's skin of each area fraction, the fastest of 0.1, 0.2, 0.3, 0.5.
SKINS = {0.2: 0.3, 0.7: 0.3}


def ours(build, case, data):
    out = subprocess.run([build / "grains", *map(str, case), data], capture_output=True, text=True,
                         check=True).stdout.split()
    return float(out[0]) / 1e6, float(out[1])


def peer(case, data, folder):
    n, fraction, kind, warm, steps = case
    log = folder / "log"
    subprocess.run(["lmp", "-in", HERE / f"{kind}.lmp", "-log", log, "-screen", "none",
                    "-var", "data", data, "-var", "skin", str(SKINS[fraction]),
                    "-var", "warm", str(warm), "-var", "steps", str(steps)],
                   env=dict(os.environ, OMP_NUM_THREADS="1"), check=True)
    text = log.read_text()
    seconds = float(re.findall(r"Loop time of (\S+)", text)[-1])
    energy = float(re.findall(rf"^\s*{warm + steps}\s+(\S+)", text, re.M)[-1])
    return n * steps / seconds / 1e6, energy


def main():
    build = Path(sys.argv[1])
    if not shutil.which("lmp"):
        sys.exit("run.py: LAMMPS is not installed (apt-get install lammps)")
    sizes = [(1000, 20000), (10000, 3000), (100000, 1000)]
    if "--quick" in sys.argv:
        sizes = [(1000, 4000), (10000, 1000)]
    print(f"{'grains':>10} {'fraction':>8} {'kind':>10} {'LAMMPS':>8} {'ours':>8} {'ratio':>6} "
          f"{'energy':>9}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for kind in ("gas", "monolayer"):
            for fraction in SKINS:
                for n, steps in sizes:
                    case = (n, fraction, kind, steps // 10, steps)
                    best, theirs = (0, 0), (0, 0)
                    for _ in range(TURNS):
                        best = max(best, ours(build, case, folder / "data"))
                        theirs = max(theirs, peer(case, folder / "data", folder))
                    apart = f"{best[1] / theirs[1] - 1:+.2%}" if kind == "gas" else ""
                    print(f"{n:>10} {fraction:>8} {kind:>10} {theirs[0]:>8.1f} {best[0]:>8.1f} "
                          f"{best[0] / theirs[0]:>6.1f} {apart:>9}", flush=True)


if __name__ == "__main__":
    main()
