#!/usr/bin/env python3
"""What many bodies cost: CPU time for a body and step, or a collision, and memory for a body, of each
solver and of LAMMPS (Debian's package lammps) where it is installed. The table of docs/scale.md.

usage: scale.py BUILD_FOLDER [--large]

Memory is the difference of the largest resident sets at two sizes over that of the bodies, the scene
itself and what writes the peer's data included. --large: the larger size is 10⁶ bodies.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "peers"))
import lammps  # noqa: E402


def child(command):
    """Its output and the largest resident set [B]."""
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, text=True,
                               env=dict(os.environ, OMP_NUM_THREADS="1"))
    out = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"scale.py: {command[0]} ended with {process.returncode}")
    return out, usage.ru_maxrss * 1024


def events(build, n):
    out, memory = child([build / "slipcheck_bench", f"--benchmark_filter=^BM_SmoothGas/{n}/",
                         "--benchmark_format=json"])
    run = json.loads(out)["benchmarks"][0]
    return run["cpu_time"], run["time_unit"], memory


def grains(build, n, fraction, kind, steps, data):
    out, memory = child([build / "grains", n, fraction, kind, 1, steps // 10, steps, 1, data])
    return 1e9 / float(out.split()[0]), memory


def bed(build, n, warm, steps, data):
    out, memory = child([build / "beds", n, 1, warm, steps, 1, data])
    words = [float(each) for each in out.split()]
    return 1e9 * words[3] / (n * steps), memory, words[4:8]


def peer(script, n, steps, data, folder, **values):
    log = folder / "log"
    _, memory = child(lammps.command(script, log, data=data, steps=steps, **values))
    return 1e9 * lammps.seconds(log) / (n * steps), memory


def row(what, n, time, unit, small, large, memory):
    bytes_each = (memory[1] - memory[0]) / (large - small)
    print(f"| {what} | {n:.0e} | {time:.3g} {unit} | {bytes_each:.0f} B |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--large", action="store_true")
    arguments = parser.parse_args()
    build = arguments.build
    small, large = 100_000, 1_000_000 if arguments.large else 300_000
    print("| solver | N | CPU time | memory for a body |\n|---|---|---|---|")
    first = events(build, 100_000)
    second = events(build, 1_000_000)
    for n, run in ((100_000, first), (1_000_000, second)):
        row("events: smooth hard disks, for an event", n, run[0], run[1], 100_000, 1_000_000,
            (first[2], second[2]))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        data = folder / "data"
        for kind, fraction in (("gas", 0.2), ("gas", 0.7), ("monolayer", 0.7)):
            what = f"{kind} of {fraction:g}, for a step"
            ours, theirs = [], []
            for n, steps in ((small, 200), (large, 20)):
                ours.append(grains(build, n, fraction, kind, steps, data))
                if shutil.which("lmp"):
                    theirs.append(peer(f"{kind}.lmp", n, steps, data, folder, skin=0.3,
                                       warm=steps // 10))
            for solver, runs in (("GrainSolver", ours), ("LAMMPS, one rank", theirs)):
                if runs:
                    row(f"{solver}: {what}", small, runs[0][0], "ns", small, large,
                        (runs[0][1], runs[1][1]))
        runs, theirs = [], []
        for n, steps in ((10_000, 400), (40_000, 50)):
            time, memory, (step, kn, gamma, side) = bed(build, n, 1500, steps, data)
            runs.append((time, memory))
            if shutil.which("lmp"):
                theirs.append(peer("bed.lmp", n, steps, data, folder, skin=0.002, warm=1500,
                                   kn=kn, gamma=gamma, side=side, step=step))
        for solver, each in (("PileSolver", runs), ("LAMMPS, one rank", theirs)):
            if each:
                row(f"{solver}: spheres that settle, for a step", 10_000, each[0][0], "ns", 10_000,
                    40_000, (each[0][1], each[1][1]))


if __name__ == "__main__":
    main()
