#!/usr/bin/env python3
"""Measures everything that docs/performance.md tells, in one run on this machine, and writes it as
results/timings/MACHINE.csv: name, value, unit.

usage: timings.py BUILD_FOLDER [--out FILE] [--no-peers]

Nothing else should run meanwhile. The other program's rows need LAMMPS (bench/peers/run.py).
"""
import argparse
import csv
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
UNITS = {"per_step": "s", "collisions/s": "1/s", "particle_steps/s": "1/s", "pair_steps/s": "1/s"}


def machine():
    text = Path("/proc/cpuinfo").read_text()
    model = re.search(r"model name\s*: (.*)", text)
    return model.group(1).strip() if model else platform.machine()


def benchmarks(build):
    """Best of three of each benchmark, by its counters or else its time."""
    out = subprocess.run([build / "slipcheck_bench", "--benchmark_format=json",
                          "--benchmark_repetitions=3"], capture_output=True, text=True, check=True)
    known = {"name", "family_index", "per_family_instance_index", "run_name", "run_type",
             "repetitions", "repetition_index", "threads", "iterations", "real_time", "cpu_time",
             "time_unit", "label", "items_per_second"}
    best = {}
    for row in json.loads(out.stdout)["benchmarks"]:
        if row["run_type"] != "iteration":
            continue
        scale = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}[row["time_unit"]]
        name = row["run_name"].removeprefix("BM_").split("/iterations:")[0]
        for counter, value in row.items():
            if counter in known or not isinstance(value, (int, float)):
                continue
            rate = counter.endswith("/s")
            key = (f"{name} {counter}", UNITS.get(counter, "1/s" if rate else ""))
            best[key] = (max if rate else min)(best.get(key, value), value)
        key = (f"{name} cpu_time", "s")
        best[key] = min(best.get(key, float("inf")), row["cpu_time"] * scale)
    return [(name, value, unit) for (name, unit), value in best.items()]


def start_to_exit(build):
    """Of one scene of two bodies, the reference alone [s]."""
    scene = (ROOT / "scenarios/symmetric-30cms.yaml").read_text().split("\ncompare:")[0]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "pair.yaml"
        file.write_text(scene + "\n")
        least = float("inf")
        for _ in range(50):
            begin = time.perf_counter()
            subprocess.run([build / "slipcheck", "run", file], stdout=subprocess.DEVNULL, check=True)
            least = min(least, time.perf_counter() - begin)
    return [("slipcheck run of two bodies, start to exit", least, "s")]


def peers(build):
    out = subprocess.run([sys.executable, ROOT / "bench/peers/run.py", build], capture_output=True,
                         text=True, check=True).stdout
    rows = []
    for line in out.splitlines()[1:]:
        n, fraction, kind, theirs, ours, ratio, *energy = line.split()
        case = f"{kind} of {n} at {fraction}"
        rows += [(f"LAMMPS {case}", float(theirs) * 1e6, "1/s"),
                 (f"GrainSolver {case}", float(ours) * 1e6, "1/s"),
                 (f"ratio {case}", float(ratio), "")]
        if energy:
            apart, error = (float(part) / 100 for part in energy[0].rstrip("%").split("±"))
            rows += [(f"energy apart {case}", apart, ""), (f"error of that {case}", error, "")]
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--no-peers", action="store_true")
    arguments = parser.parse_args()
    slug = re.sub(r"[^a-z0-9]+", "-", re.sub(r"\(r\)|\(tm\)", "", machine().lower())).strip("-")
    out = arguments.out or ROOT / f"results/timings/{slug}.csv"
    rows = [("processor", machine(), ""), ("hardware threads", os.cpu_count(), "")]
    rows += benchmarks(arguments.build) + start_to_exit(arguments.build)
    if not arguments.no_peers:
        rows += peers(arguments.build)
    out.parent.mkdir(parents=True, exist_ok=True)
    unfinished = out.with_suffix(".tmp")
    with open(unfinished, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("name", "value", "unit"))
        for name, value, unit in rows:
            writer.writerow((name, f"{value:.6g}" if isinstance(value, float) else value, unit))
    unfinished.rename(out)
    print(out)


if __name__ == "__main__":
    main()
