#!/usr/bin/env python3
"""Runs the cells of a notebook one after the other, without Jupyter; what they write goes into a folder.

usage: run_notebook.py NOTEBOOK [FOLDER]
"""
import json
import os
import sys
from pathlib import Path


def main() -> int:
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    cells = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))["cells"]
    os.environ.setdefault("MPLBACKEND", "Agg")
    os.chdir(sys.argv[2] if len(sys.argv) == 3 else ".")
    names = {"__name__": "__main__"}
    for number, cell in enumerate(cells, 1):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{sys.argv[1]}, cell {number}", "exec"), names)
    return 0


if __name__ == "__main__":
    sys.exit(main())
