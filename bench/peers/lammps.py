"""LAMMPS (Debian's package lammps) on the scripts of this folder."""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent


def require():
    if not shutil.which("lmp"):
        sys.exit(f"{Path(sys.argv[0]).name}: LAMMPS is not installed (apt-get install lammps)")


def arguments(documentation):
    """Those of a program that runs it beside a solver."""
    parser = argparse.ArgumentParser(description=documentation.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--ranks", type=int, default=1)
    parsed = parser.parse_args()
    require()
    return parsed


def command(script, log, ranks=1, **variables):
    start = ["mpirun", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks)] if ranks > 1 else []
    return [*start, "lmp", "-in", HERE / script, "-log", log, "-screen", "none",
            *(word for name, value in variables.items() for word in ("-var", name, str(value)))]


def seconds(log, ranks=1):
    """What the last run took: CPU time on one rank, wall time on several."""
    text = log.read_text()
    wall = float(re.findall(r"Loop time of (\S+)", text)[-1])
    used = float(re.findall(r"([\d.]+)% CPU use", text)[-1]) / 100
    return wall * used if ranks == 1 else wall


def run(script, log, ranks, **variables):
    """seconds() and what it printed first for the last step."""
    subprocess.run(command(script, log, ranks, **variables),
                   env=dict(os.environ, OMP_NUM_THREADS="1"), check=True)
    last = variables["warm"] + variables["steps"]
    shown = re.findall(rf"^\s*{last}\s+(\S+)", log.read_text(), re.M)
    return seconds(log, ranks), float(shown[-1])
