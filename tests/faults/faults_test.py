#!/usr/bin/env python3
"""One call of the program fails: an allocation, a write, an fsync, a rename, a thread that cannot be started …
The program then ends by itself, with an exit code of its own and a word on stderr, leaves no half-written
file and no temporary one, no process, and never a result that differs from the one without the fault.

usage: faults_test.py SLIPCHECK LIBRARY SOURCE_DIR [--all] [--only COMMAND] [--kind KIND] [--of I/N]

LIBRARY is failing_calls.cpp, built. Without --all a few calls of each kind are tried, evenly over all; with
it each call of each kind, of allocations the first of each call stack. --of 2/4: the second quarter of them.
"""
import argparse
import json
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PARSER = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
PARSER.add_argument("slipcheck")
PARSER.add_argument("library")
PARSER.add_argument("source", type=Path)
PARSER.add_argument("--all", action="store_true")
PARSER.add_argument("--only")
PARSER.add_argument("--kind")
PARSER.add_argument("--of", default="1/1")
PARSER.add_argument("--some", type=int, default=2, help="calls of each kind, and five times as many allocations")
OPTIONS = PARSER.parse_args()
OPTIONS.slipcheck, OPTIONS.library = (str(Path(each).resolve()) for each in (OPTIONS.slipcheck, OPTIONS.library))

SCENE = (OPTIONS.source / "scenarios/symmetric-30cms.yaml").read_text().split("compare:")[0]
COMPARE = """compare:
  engines: [{engine: bullet, precision: double, profile: default, rate: 240}]
  tolerance: {sliding_time: 1 %, effective_restitution: 0.005}
"""
SWEEP = "sweep: {grid: {engine: bullet, rate: [60, 240], phases: 2}}\n"
OLD = '{"old": true}\n'
PATIENCE = 60
EXIT_CODES = range(0, 5)
# A store and what SQLite keeps beside it until it has been opened again.
STORE = (".db", ".db-wal", ".db-shm", ".db-journal")

# What may stay in a folder after each command, and what it is asked to do.
COMMANDS = {
    "run": ["run", "s.yaml", "--phases", "2", "--workers", "1", "--json", "old.json", "--out", "out", "--markdown", "new.md", "--html", "new.html"],
    "explain": ["explain", "s.yaml"],
    "report": ["report", "kept", "-o", "new.html", "--csv", "new.csv"],
    "check": ["check", "s.yaml", "--baselines", "baselines", "--phases", "2", "--json", "new.json", "--junit", "new.xml"],
    "update": ["check", "s.yaml", "--baselines", "proposed", "--phases", "2", "--update", "--why", "a test", "--changes", "CHANGES.md"],
    "sweep": ["sweep", "w.yaml", "-o", "store.db", "-q"],
    "query": ["query", "kept.db", "--csv", "new.csv", "--json", "new.json"],
}


def environment(folder, fault=None, count=None):
    kept = {k: v for k, v in os.environ.items() if not k.startswith("SLIPCHECK_FAULT")}
    kept |= {"LD_PRELOAD": str(OPTIONS.library), "SLIPCHECK_ENGINES": str(folder / "none")}
    if fault:
        kept["SLIPCHECK_FAULT"] = fault
    if count:
        kept["SLIPCHECK_FAULT_COUNT"] = str(count)
    return kept


def plain(arguments, folder):
    done = subprocess.run([OPTIONS.slipcheck, *arguments], cwd=folder, capture_output=True, text=True, timeout=PATIENCE)
    if done.returncode not in (0, 1):
        sys.exit(f"{arguments}: {done.returncode}\n{done.stderr}")


def prepare(folder):
    """A folder that every command can be run in."""
    (folder / "s.yaml").write_text(SCENE + COMPARE)
    (folder / "w.yaml").write_text(SCENE + "compare: {tolerance: {sliding_time: 1 %}}\n" + SWEEP)
    (folder / "old.json").write_text(OLD)
    (folder / "CHANGES.md").write_text((OPTIONS.source / "results/CHANGES.md").read_text())
    (folder / "baselines").mkdir()
    (folder / "proposed").mkdir()
    plain(["check", "s.yaml", "--baselines", "baselines", "--phases", "2", "--update", "--why", "first", "--changes", "first.md", "-q"], folder)
    plain(["run", "s.yaml", "--phases", "2", "--out", "kept", "-q"], folder)
    plain(["sweep", "w.yaml", "-o", "kept.db", "-q"], folder)


# What a text about a fault has.
WHY = re.compile("fail|cannot|memory|bad_alloc|closed|exited|killed|not installed")

# What a run took and when it was is not what it gave.
VOLATILE = re.compile(r'"(cpu_seconds|[a-z_]*seconds|date|started|host|[a-z_]*time_ratio|written|command|commands|machine|cost[a-z_]*)": *'
                      r'("[^"]*"|\[[^\]]*\]|\{[^}]*\}|[^,}\n]*)|time="[^"]*"|timestamp="[^"]*"')


def judged(text):
    """The part of a JSON result that says what was found."""
    return VOLATILE.sub("", text)


def words(text):
    """What a run says, without its numbers: it says another time each time."""
    return re.sub(r"[\d.]+( ?[nµm]?s\b)?", "", text)


def is_of_udunits(told):
    """Whether the call stack of a fault is one inside of UDUNITS, which does not look at what malloc() gives, or asserts it."""
    frames = [line for line in told.splitlines() if re.search(r"\[0x[0-9a-f]+\]$", line)]
    own = next((k for k, line in enumerate(frames) if "slipcheck(" in line), len(frames))
    return any("libudunits2" in line for line in frames[:own])


def files_of(folder):
    return {str(p.relative_to(folder)): p for p in folder.rglob("*") if p.is_file()}


def whole(path, name):
    """Why the file is not a whole one; empty for one that is."""
    if name.endswith(STORE):
        if name.endswith(".db"):
            with sqlite3.connect(path) as store:
                if path.stat().st_size and store.execute("PRAGMA integrity_check").fetchone() != ("ok",):
                    return "is no sound store"
        return ""
    text = path.read_text()
    if name.endswith(".json"):
        try:
            json.loads(text)
        except ValueError as fault:
            return f"is no JSON: {fault}"
    if name.endswith(".html") and not text.rstrip().endswith("</html>"):
        return "ends in the middle"
    return "" if text.endswith("\n") or name.endswith((".html", ".json", ".xml")) else "has no end of its last line"


def left_alive(session):
    """Processes of that session; those that are about to end have a second."""
    until = time.monotonic() + 1
    while True:
        alive = []
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            if int(fields[3]) == session and fields[0] != "Z":
                alive.append(int(entry.name))
        if not alive or time.monotonic() > until:
            return alive
        time.sleep(0.01)


class Case:
    """One command in copies of a prepared folder."""

    def __init__(self, name, prepared, place):
        self.name, self.prepared, self.place, self.of_udunits = name, prepared, place, 0

    def run(self, fault=None, count=None):
        folder = self.place / "work"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.prepared, folder)
        process = subprocess.Popen([OPTIONS.slipcheck, *COMMANDS[self.name]], cwd=folder, text=True, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, start_new_session=True, env=environment(folder, fault, count))
        try:
            out, told = process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return None, "", "", folder
        self.alive = left_alive(process.pid)
        return process.returncode, out, told, folder

    def begin(self):
        """Without a fault: what it gives, and how many calls of each kind it makes."""
        count = self.place / "count"
        self.code, self.out, self.told, folder = self.run(count=count)
        if self.code not in (0, 1):
            sys.exit(f"{self.name} fails without a fault: {self.code}\n{self.told}")
        self.files = {name: path.read_bytes() for name, path in files_of(folder).items()}
        self.before = {name: path.read_bytes() for name, path in files_of(self.prepared).items()}
        self.calls, self.firsts = {}, []
        for line in count.read_text().splitlines():
            kind, number = line.split()
            if kind == "first":
                self.firsts.append(int(number))
            else:
                self.calls[kind] = int(number)
        self.firsts.sort()

    def numbers(self, kind):
        all_of_it = self.firsts if kind == "allocate" else list(range(1, self.calls[kind] + 1))
        if OPTIONS.all or not all_of_it:
            return all_of_it
        most = OPTIONS.some * (5 if kind == "allocate" else 1)
        if len(all_of_it) <= most:
            return all_of_it
        return [all_of_it[k * (len(all_of_it) - 1) // (most - 1)] for k in range(most)]

    def fault_of(self, fault):
        """What is wrong with how the program took that fault; empty where nothing is."""
        code, out, told, folder = self.run(fault)
        if code is None:
            return "does not end"
        if code in (-signal.SIGSEGV, -signal.SIGABRT) and is_of_udunits(told):
            self.of_udunits += 1
            return ""
        if code not in EXIT_CODES:
            return f"exit code {code}: {told[-300:]}"
        says_so = words(told) != words(self.told) or words(out) != words(self.out)
        if code != self.code and not says_so and not fault.startswith("print"):
            return f"exit code {code} without a word"
        if self.alive:
            return f"left processes: {self.alive}"
        for name, path in files_of(folder).items():
            if name not in self.files and not name.endswith(STORE):
                return f"left {name}"
            if why := whole(path, name):
                return f"{name} {why}"
            now = path.read_bytes()
            if not name.endswith((".json", ".xml")) or now == self.before.get(name):
                continue  # tables and pages have times among their numbers
            if code == self.code and not says_so and judged(now.decode()) != judged(self.files[name].decode()):
                return f"{name} is another one, without a word"
        if code == self.code and not says_so:
            if missing := [name for name in self.files if not (folder / name).exists()]:
                return f"without a word {missing} are missing"
        if self.name == "explain" and says_so and code == self.code and not re.search(WHY, told + out):
            return "says something else"
        return ""


def main():
    share, shares = map(int, OPTIONS.of.split("/"))
    faults, tried, ends = [], 0, {}
    with tempfile.TemporaryDirectory() as directory:
        place = Path(directory)
        prepared = place / "prepared"
        prepared.mkdir()
        prepare(prepared)
        for name in COMMANDS:
            if OPTIONS.only and name != OPTIONS.only:
                continue
            case = Case(name, prepared, place)
            case.begin()
            begin, before = time.monotonic(), tried
            for kind in case.calls:
                if OPTIONS.kind and kind != OPTIONS.kind:
                    continue
                for place_in_list, number in enumerate(case.numbers(kind)):
                    if place_in_list % shares != share - 1:
                        continue
                    # One call fails, or it and all after it: SQLite tries both.
                    for fault in ([f"{kind}:{number}", f"{kind}:{number}+"] if OPTIONS.all else
                                  [f"{kind}:{number}{'+' * (place_in_list % 2)}"]):
                        tried += 1
                        if why := case.fault_of(fault):
                            faults.append(f"{name} with {fault}: {why}")
                            print(faults[-1], flush=True)
            counts = ", ".join(f"{kind} {number}" for kind, number in case.calls.items() if number)
            print(f"{name}: {tried - before} faults tried in {time.monotonic() - begin:.0f} s; calls: {counts}; "
                  f"{len(case.firsts)} call stacks of allocations; {case.of_udunits} ended in UDUNITS", flush=True)
    print(f"{tried} faults tried, {len(faults)} taken badly")
    return 1 if faults or not tried else 0


if __name__ == "__main__":
    sys.exit(main())
