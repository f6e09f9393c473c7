"""LAMMPS (Debian's package lammps) on the scripts of this folder."""
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


def run(script, log, ranks, **variables):
    """Seconds of the script's last run, and what it printed first for that run's last step: of CPU
    time on one rank, of wall time on several."""
    start = ["mpirun", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks)] if ranks > 1 else []
    subprocess.run([*start, "lmp", "-in", HERE / script, "-log", log, "-screen", "none",
                    *(word for name, value in variables.items() for word in ("-var", name, str(value)))],
                   env=dict(os.environ, OMP_NUM_THREADS="1"), check=True)
    text = log.read_text()
    seconds = float(re.findall(r"Loop time of (\S+)", text)[-1])
    if ranks == 1:
        seconds *= float(re.findall(r"([\d.]+)% CPU use", text)[-1]) / 100
    last = variables["warm"] + variables["steps"]
    return seconds, float(re.findall(rf"^\s*{last}\s+(\S+)", text, re.M)[-1])
