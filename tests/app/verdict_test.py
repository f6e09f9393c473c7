#!/usr/bin/env python3
"""Verdicts as a user meets them: nothing absent or undecidable is green.

usage: verdict_test.py SLIPCHECK SOURCE_DIR
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
TUNED = "engine: bullet, profile: tuned, rate: 240"

# Two balls that meet at `offset` 0 and miss each other at 1 m.
PAIR = """slipcheck: 1
name: pair
title: Two balls
materials: {{s: {{density: 7850}}}}
contacts:
  - {{between: [s, s], normal: {{model: hard, restitution: 0.9}}}}
  - {{between: [s, substrate], friction: 0.2}}
substrate: {{}}
bodies:
  - {{name: a, material: s, sphere: {{radius: 0.02}}, position: [0, 0], velocity: [1, 0], spin: rolling}}
  - {{name: b, material: s, sphere: {{radius: 0.02}}, position: [0.5, {offset}]}}
run: {{until: {until}, limit: {limit}}}
compare:
  engines: [{engines}]
  tolerance: {{{tolerance}}}
"""


class Verdicts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)

    def run_pair(self, *arguments, offset=0, until="rolling", limit=5, engines="{" + TUNED + "}",
                 tolerance="effective_restitution: 0.01", env=None):
        self.scene = self.path / "pair.yaml"
        self.scene.write_text(PAIR.format(offset=offset, until=until, limit=limit, engines=engines,
                                          tolerance=tolerance))
        return subprocess.run(
            [SLIPCHECK, "run", str(self.scene), "--phases", "4", *map(str, arguments)],
            capture_output=True, text=True, timeout=600, env=env)

    def verdict_of(self, result):
        return json.loads(result.stdout)["verdict"]

    def test_a_collision_that_never_happens_is_undecided_in_every_output(self):
        junit, markdown = self.path / "out.xml", self.path / "out.md"
        page = self.path / "out.html"
        result = self.run_pair("--junit", junit, "--markdown", markdown, "--html", page, offset=1)
        self.assertEqual(result.returncode, 1, result.stderr)
        why = "effective_restitution: nothing of it occurs in the reference"
        self.assertIn("pair  ? UNDECIDED", result.stdout)
        self.assertIn(why, result.stdout)
        self.assertIn("1 scene: 0 within, 0 deviate, 1 undecided, 0 failed", result.stdout)
        failure = next(xml.etree.ElementTree.parse(junit).iter("failure"))
        self.assertEqual(failure.get("type"), "undecided")
        self.assertIn(why, failure.get("message"))
        self.assertIn("1 undecided", markdown.read_text())
        self.assertIn('<span class="verdict undecided">? undecided</span>', page.read_text())
        result = self.run_pair("--json", "-", offset=1)
        self.assertEqual(self.verdict_of(result), "undecided")
        error = json.loads(result.stdout)["runs"][0]["errors"]["effective_restitution"]
        self.assertEqual((error["within"], error["verdict"], error["max"]),
                         (False, "undecided", None))

    def test_who_wants_it_green_says_so(self):
        junit = self.path / "out.xml"
        result = self.run_pair("--allow-undecided", "--junit", junit, offset=1)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("? UNDECIDED", result.stdout)
        self.assertEqual(len(list(xml.etree.ElementTree.parse(junit).iter("skipped"))), 1)
        # A deviation stays one.
        result = self.run_pair("--allow-undecided", tolerance="final_position: 1e-9")
        self.assertEqual(result.returncode, 1, result.stdout)

    def test_a_reference_that_did_not_end_is_undecided_with_engines_and_alone(self):
        for engines in ("{" + TUNED + "}", ""):
            result = self.run_pair("--json", "-", limit=0.01, engines=engines)
            self.assertEqual(result.returncode, 1, engines)
            self.assertEqual(self.verdict_of(result), "undecided")

    def test_a_reference_alone_is_not_within(self):
        result = self.run_pair(engines="", tolerance="")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("pair  – reference alone", result.stdout)
        self.assertNotIn("within", result.stdout.splitlines()[0])
        result = self.run_pair("--json", "-", engines="", tolerance="")
        self.assertEqual(self.verdict_of(result), "reference alone")

    def test_an_engine_that_is_not_installed_is_undecided(self):
        faulty = Path(SLIPCHECK).parent / "faulty"  # in double precision alone
        result = self.run_pair("--json", "-", engines="{engine: faulty, precision: single, rate: 240}",
                               env=dict(os.environ, SLIPCHECK_ENGINE_PATH=str(faulty)))
        self.assertEqual(result.returncode, 1, result.stderr)
        run = json.loads(result.stdout)["runs"][0]
        self.assertEqual((run["status"], self.verdict_of(result)), ("skipped", "undecided"))

    def test_names_that_nobody_has_are_refused_with_the_nearest(self):
        for engines, words in (
                ("{engine: bullet, profile: tunde, rate: 240}",
                 r"pair\.yaml:14:\d+: compare\.engines\[0\]\.profile: must be one of the profiles of "
                 r"bullet, .*did you mean tuned\?\), got tunde"),
                ("{engine: bulet, rate: 240}", r"engine: must be one of .*did you mean bullet\?"),
                ("{engine: bullet, precision: singel, rate: 240}",
                 r"precision: must be .*did you mean single\?"),
                ("{engine: bullet, rate: 1e300}", r"rate: must be >= 1e-06 and <= 1000000000000 Hz"),
                ("{engine: bullet, rate: 0}", r"rate: must be"),
        ):
            out = self.path / "out.json"
            result = self.run_pair("--json", out, engines=engines)
            self.assertEqual(result.returncode, 2, engines + result.stderr)
            self.assertRegex(result.stderr, words)
            self.assertFalse(out.exists())

    def test_tolerances_by_name_judge_what_they_name(self):
        def judged(tolerance):
            result = self.run_pair("--json", "-", tolerance=tolerance)
            errors = json.loads(result.stdout)["runs"][0]["errors"]
            return {name for name, error in errors.items() if "tolerance" in error}

        self.assertEqual(judged("a-b.restitution: 0.01"), {"a-b.restitution"})
        self.assertEqual(judged("restitution: 0.01"), {"a-b.restitution"})
        self.assertEqual(judged("b.final_position: 1 %"), {"b.final_position"})
        self.assertEqual(judged("final_position: 1 %, a.final_position: none"),
                         {"b.final_position"})
        result = self.run_pair(tolerance="c.final_position: 1 %")
        self.assertEqual(result.returncode, 2)
        self.assertIn("must be of one of the bodies, but c is none", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
