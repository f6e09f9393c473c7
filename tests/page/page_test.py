#!/usr/bin/env python3
"""A report in a browser: of made-up results, or with --slipcheck of scenes that the program runs.

The page and its screenshots are left in --out.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
SCENES = ["symmetric-30cms", "symmetric-10cms", "roll-to-rest", "box-one-ball"]


def run(*command, accepted=(0,)):
    done = subprocess.run([str(part) for part in command], check=False)
    if done.returncode not in accepted:
        sys.exit(f"{command[0]} {command[1]} ended with {done.returncode}")


def make_fixture(node, modules, page):
    script = modules.parent / "page.js"
    run(node, HERE / "fixture.mjs", script, page, SOURCE / "core/report/html/page.css")


def make_report(slipcheck, folder, page):
    files = [SOURCE / "scenarios" / f"{scene}.yaml" for scene in SCENES]
    # 1: an engine deviates, which is what the page is about.
    run(slipcheck, "run", *files, "--phases", 8, "--out", folder, "--quiet", accepted=(0, 1))
    run(slipcheck, "report", folder, "-o", page, "--quiet")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--node", required=True)
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--slipcheck", type=pathlib.Path)
    arguments = parser.parse_args()

    shutil.rmtree(arguments.out, ignore_errors=True)
    arguments.out.mkdir(parents=True)
    page = arguments.out / ("page.html" if arguments.slipcheck else "fixture.html")
    if arguments.slipcheck:
        make_report(arguments.slipcheck, arguments.out / "results", page)
    else:
        make_fixture(arguments.node, arguments.modules, page)
    run(arguments.node, HERE / "page_test.mjs", arguments.modules, page, arguments.out)


if __name__ == "__main__":
    main()
