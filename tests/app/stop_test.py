#!/usr/bin/env python3
"""Every command ends within a second of a signal, and what is finished is kept.

usage: stop_test.py SLIPCHECK SOURCE_DIR [sanitized]
"""
import json
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
# What the sanitizers and a busy machine add.
PATIENCE = 10 if "sanitized" in sys.argv[3:] else 2

HARD = "{model: hard, restitution: 1}"
SOFT = "{model: linear, restitution: 1, collision_time: 1e-3}"
PERIODIC = "substrate: {periodic: [1, 1]}"
SHAKEN = "substrate: {motion: {kind: oscillate, amplitude: [0.02, 0], frequency: 5}}"
BOX = "container: {width: 1, height: 1, floor: {amplitude: 0.01, frequency: 10}}"


def scene(name, normal, surroundings, count, solver, ground="substrate], friction: 0.3"):
    grounds = [ground] if surroundings != BOX else [
        f"{part}], normal: {normal}" for part in ("floor", "wall", "lid")]
    contacts = "".join(f"  - {{between: [m, {each}}}\n" for each in grounds)
    return f"""slipcheck: 1
name: {name}
title: It goes on for centuries
gravity: 9.81
materials: {{m: {{density: 1000}}}}
contacts:
  - {{between: [m, m], normal: {normal}}}
{contacts}{surroundings}
fill: {{prefix: g, count: {count}, material: m, radius: 0.01, area: [0.05, 0.05, 0.95, 0.95], speed: 1}}
run: {{until: 1e10}}
compare: {{reference: {solver}, engines: [], tolerance: {{final_position: 1 %}}}}
"""


ENDLESS = {
    "events": scene("events", HARD, PERIODIC, 20, "event", "substrate]"),
    "integrated": scene("integrated", SOFT, SHAKEN, 2, "contact"),
    "steps": scene("steps", SOFT, SHAKEN, 3, "steps"),
    "grains": scene("grains", SOFT, PERIODIC, 100, "steps", "substrate]"),
    "box-events": scene("box-events", HARD, BOX, 20, "event"),
    "box-contacts": scene("box-contacts", SOFT, BOX, 20, "contact"),
}


class Stopping(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.path = Path(self.directory.name)
        for name, text in ENDLESS.items():
            (self.path / f"{name}.yaml").write_text(text)

    def tearDown(self):
        self.directory.cleanup()

    def file(self, name):
        return self.path / f"{name}.yaml"

    def stopped(self, *arguments, by=signal.SIGTERM, after=0.7, times=1):
        """Runs a command, signals it, and gives its exit code."""
        process = subprocess.Popen([SLIPCHECK, *map(str, arguments)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(after)
        self.assertIsNone(process.poll(), f"{arguments} ended by itself")
        begin = time.monotonic()
        for _ in range(times):
            process.send_signal(by)
            time.sleep(0.02)
        try:
            process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
        self.assertLess(time.monotonic() - begin, PATIENCE, arguments)
        return process.returncode

    def test_every_solver(self):
        for name in ENDLESS:
            for by in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(solver=name, by=by):
                    self.assertEqual(self.stopped("run", self.file(name), "-q", by=by), 130)

    def test_every_command(self):
        (self.path / "baselines").mkdir()
        hopeless = self.file("integrated")
        for command in (["explain", hopeless], ["precision", hopeless, "--engines", "bullet", "-q"],
                        ["stability", hopeless, "--engines", "bullet", "-q", "--limits", "no"],
                        ["tune", hopeless, "--engine", "bullet", "-o", self.path / "t.yaml"],
                        ["check", hopeless, "--baselines", self.path / "baselines"],
                        ["figures", self.path / "figures", "--only", "L10", "-q"],
                        ["gas", SOURCE / "scenarios" / "gas-rolling.yaml", "--particles",
                         "1000000", "--collisions", "100000", "-q"]):
            with self.subTest(command=command[0]):
                self.assertEqual(self.stopped(*command), 130)
        self.assertFalse((self.path / "t.yaml").exists())

    def test_what_is_finished_is_kept_even_of_the_impatient(self):
        out = self.path / "out"
        quick = SOURCE / "scenarios" / "symmetric-30cms.yaml"
        for times in (1, 3):
            # As long as a slow machine takes to finish the quick one, of which nothing tells from outside.
            for after in (0.7, 3, 12, 48):
                code = self.stopped("run", quick, self.file("events"), "--workers", "2", "--out", out, "-q",
                                    after=after, times=times)
                self.assertEqual(code, 130)
                finished = json.loads((out / "symmetric-30cms.json").read_text())["reference"]
                if finished["reached"]:
                    break
            self.assertTrue(finished["reached"])
            self.assertAlmostEqual(
                finished["observables"]["i-j.effective_restitution"]["value"], 1.25 / 3.5, 12)
            cut = json.loads((out / "events.json").read_text())["reference"]
            self.assertFalse(cut["reached"])
            self.assertEqual((cut["failed"], cut["reason"]), (True, "interrupted"))
            self.assertEqual([v for v in cut["observables"].values() if v["value"] is not None], [])

    def test_a_time_limit_ends_a_reference_and_says_so(self):
        out = self.path / "out.json"
        begin = time.monotonic()
        subprocess.run([SLIPCHECK, "run", *map(self.file, ENDLESS), "--time-limit", "0.5", "--json", out,
                        "-q"], timeout=600, check=False)
        self.assertLess(time.monotonic() - begin, len(ENDLESS) * 0.5 + 2 * PATIENCE)
        scenes = json.loads(out.read_text())["results"]
        self.assertEqual(len(scenes), len(ENDLESS))
        for each in scenes:
            self.assertFalse(each["reference"]["reached"])
            self.assertEqual(each["reference"]["reason"],
                             "took longer than the time limit of 0.5 s (--time-limit)")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
