#!/usr/bin/env python3
"""Runs the program as a user does and checks what contract.md and the README promise.

usage: command_line_test.py SLIPCHECK SOURCE_DIR
"""
import json
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
SCENES = SOURCE / "scenarios"
FAULTY = Path(SLIPCHECK).parent / "faulty"


def run(*arguments, **options):
    environment = dict(os.environ, **options.pop("env", {}))
    return subprocess.run([SLIPCHECK, *map(str, arguments)], capture_output=True, text=True,
                          timeout=200, env=environment, **options)


def child_of(parent, name):
    """The process id of a child whose command contains `name`, or None."""
    for status in Path("/proc").glob("[0-9]*/status"):
        try:
            text = status.read_text()
            command = (status.parent / "cmdline").read_text()
        except OSError:  # it ended meanwhile
            continue
        if f"PPid:\t{parent}\n" in text and name in command:
            return int(status.parent.name)
    return None


def scene_text(engines, name="pair", until="rolling"):
    return f"""slipcheck: 1
name: {name}
title: A pair
units: cgs
gravity: 981
materials: {{steel: {{density: 7.85}}}}
contacts:
  - {{between: [steel, steel], normal: {{model: hard, restitution: 0.9}}, tangential: {{model: none}}}}
  - {{between: [steel, substrate], friction: 0.1}}
substrate: {{}}
bodies:
  - {{name: i, material: steel, sphere: {{radius: 0.2}}, position: [-0.95, 0], velocity: [15, 0], spin: rolling}}
  - {{name: j, material: steel, sphere: {{radius: 0.2}}, position: [0.95, 0], velocity: [-15, 0], spin: rolling}}
run: {{until: {until}, limit: 1000}}
compare:
  engines: [{engines}]
  tolerance: {{effective_restitution: 0.005}}
"""


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)

    def scene(self, *arguments, **options):
        file = self.path / f"{options.get('name', 'pair')}.yaml"
        file.write_text(scene_text(*arguments, **options))
        return file

    def test_symmetric_scene_gives_the_closed_forms_to_1e_12(self):
        result = run("run", SCENES / "symmetric-30cms.yaml", "--json", "-", "--phases", "64")
        self.assertEqual(result.returncode, 1, result.stderr)
        report = json.loads(result.stdout)
        self.assertEqual(report["schema"], "slipcheck-result/1")
        seen = report["reference"]["observables"]
        e, v, mu, g = 0.9, 0.15, 0.1, 9.81
        slide = v * (1 + e) / (3.5 * mu * g)
        v_rel = 2 * v
        s = v_rel**2 * (1 + e) * (e - 1 + 5 * e) / (8 * mu * g * 3.5**2)
        self.assertAlmostEqual(seen["i-j.effective_restitution"]["value"], (2.5 * e - 1) / 3.5,
                               delta=1e-12)
        for body in "ij":
            self.assertAlmostEqual(seen[f"{body}.sliding_time"]["value"], slide, delta=1e-12)
            self.assertAlmostEqual(seen[f"{body}.sliding_distance"]["value"], s, delta=1e-12)
            self.assertAlmostEqual(report["reference"]["closed_form"][f"{body}.sliding_time"],
                                   slide, delta=1e-12)
        for rate in (240, 16000):
            engine = next(r for r in report["runs"] if r["rate"] == rate
                          and r["precision"] == "double" and r["profile"] == "default")
            self.assertEqual((engine["status"], engine["phases"]), ("ok", 64))
            lottery = engine["observables"]["i-j.effective_restitution"]
            # Two strata of 64 in a lottery of 0.143 may be missed at each end.
            self.assertAlmostEqual(lottery["min"], 0.358, delta=0.0045)
            self.assertAlmostEqual(lottery["max"], 0.498, delta=0.0045)
            self.assertFalse(engine["errors"]["i-j.effective_restitution"]["within"])
        self.assertEqual(report["verdict"], "deviates")

    def test_slow_pair_loses_its_restitution_below_bullets_threshold(self):
        result = run("run", SCENES / "symmetric-10cms.yaml", "--json", "-", "--phases", "64")
        for engine in json.loads(result.stdout)["runs"]:
            if engine["profile"] == "default":
                lottery = engine["observables"]["i-j.restitution"]
                self.assertGreaterEqual(lottery["min"], -1e-6)
                self.assertLessEqual(lottery["max"], 0.2 + 1e-6)
                self.assertGreater(lottery["max"], 0.18)

    def test_reference_alone_is_within_tolerance(self):
        result = run("run", self.scene(""))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("0.3571", result.stdout)

    def test_bad_input_is_exit_2_with_the_place_and_writes_nothing(self):
        file = self.scene("")
        file.write_text(file.read_text().replace("radius: 0.2", "radius: -0.2"))
        out = self.path / "out.json"
        result = run("run", file, SCENES / "symmetric-30cms.yaml", "--json", out)
        self.assertEqual(result.returncode, 2)
        lines = [line for line in result.stderr.splitlines() if "radius" in line]
        self.assertEqual(len(lines), 2)  # both balls' faults in one go
        self.assertRegex(lines[0], r"pair\.yaml:12:\d+: bodies\[0\]\.sphere\.radius: .*-0\.2")
        self.assertFalse(out.exists())
        self.assertEqual(result.stdout, "")

    def test_unknown_options_and_missing_files_are_exit_2(self):
        for arguments in (["run"], ["run", "x.yaml", "--nonsense"], ["nonsense"], [],
                          ["run", self.path / "none.yaml"], ["run", self.path],
                          ["run", self.scene(""), "--phases", "0"],
                          ["run", self.scene(""), "--json", self.path / "none/out.json"],
                          ["list", "nonsense"]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertNotEqual(result.stderr, "")

    def test_results_that_cannot_be_written_are_no_bad_input(self):
        result = run("run", self.scene(""), "--json", "/dev/full")
        self.assertEqual(result.returncode, 4)
        self.assertIn("cannot write /dev/full", result.stderr)

    def test_model_without_a_solver_is_refused_by_name(self):
        file = self.scene("")
        file.write_text(file.read_text().replace(
            "{model: hard, restitution: 0.9}",
            "{model: linear, restitution: 0.9, collision_time: 2.55e-5}"))
        result = run("run", file)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"pair\.yaml:8:\d+: contacts\[0\]\.normal\.model: .*linear")

    def test_killed_worker_leaves_every_other_run_intact_and_exit_3(self):
        bullet = "{engine: bullet, precision: double, rate: [240, 1000]}"
        file = self.scene("{engine: faulty, precision: double, profile: slow, rate: 1000}, " + bullet)
        out = self.path / "out.json"
        path = f"{Path(SLIPCHECK).parent}:{FAULTY}"
        process = subprocess.Popen([SLIPCHECK, "run", file, "--json", out],
                                   env=dict(os.environ, SLIPCHECK_ENGINE_PATH=path),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        victim = None
        deadline = time.time() + 30
        while victim is None and time.time() < deadline:
            time.sleep(0.05)
            victim = child_of(process.pid, "engine-faulty")
        self.assertIsNotNone(victim)
        time.sleep(0.3)  # well inside the run
        os.kill(victim, signal.SIGKILL)
        _, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3, stderr)
        report = json.loads(out.read_text())
        self.assertEqual(report["verdict"], "failed")
        self.assertEqual([r["status"] for r in report["runs"]], ["crashed", "ok", "ok"])
        self.assertIn("signal 9", report["runs"][0]["reason"])
        alone = json.loads(run("run", self.scene(bullet, name="alone"), "--json", "-").stdout)
        for beside, single in zip(report["runs"][1:], alone["runs"]):
            self.assertEqual(beside["observables"], single["observables"])
            self.assertEqual(beside["errors"], single["errors"])

    def test_interrupt_keeps_what_is_finished_and_exits_130(self):
        file = self.scene("{engine: bullet, precision: double, rate: 240},"
                          "{engine: faulty, precision: double, profile: slow, rate: 1000}")
        out = self.path / "out.json"
        path = f"{Path(SLIPCHECK).parent}:{FAULTY}"
        process = subprocess.Popen([SLIPCHECK, "run", file, "--json", out],
                                   env=dict(os.environ, SLIPCHECK_ENGINE_PATH=path),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(6)  # time enough for the first run on a busy machine
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        report = json.loads(out.read_text())
        self.assertEqual([r["status"] for r in report["runs"]], ["ok", "skipped"])

    def test_result_folder_and_same_inputs_same_bytes(self):
        file = self.scene("{engine: bullet, precision: double, rate: 240}")
        texts = []
        for name in ("a", "b"):
            result = run("run", file, "--out", self.path / name)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(sorted(p.name for p in (self.path / name).iterdir()),
                             ["pair.json", "report.html"])
            text = (self.path / name / "pair.json").read_text()
            texts.append(re.sub(r'"cpu_seconds": [^,\n]*', "", text))
        self.assertEqual(texts[0], texts[1])

    def test_phases_option_and_several_scenes(self):
        one = self.scene("{engine: bullet, precision: single, rate: 240}")
        two = self.scene("", name="second")
        report = json.loads(run("run", one, two, "--json", "-", "--phases", "5").stdout)
        self.assertEqual(report["schema"], "slipcheck-results/1")
        self.assertEqual([r["scenario"]["name"] for r in report["results"]], ["pair", "second"])
        self.assertEqual(report["results"][0]["runs"][0]["phases"], 5)
        twice = self.path / "copy.yaml"
        twice.write_text(one.read_text())
        self.assertEqual(run("run", one, twice).returncode, 2)

    def test_results_on_stdout_and_the_rest_on_stderr(self):
        result = run("run", self.scene(""), "--quiet")
        self.assertEqual((result.stdout, result.stderr, result.returncode), ("", "", 0))
        plain = run("run", self.scene("{engine: bullet, precision: double, rate: 240}"))
        self.assertNotIn("\x1b", plain.stdout + plain.stderr)

    def test_every_command_has_help_with_an_example(self):
        for command in ("run", "explain", "list", "schema"):
            result = run(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertRegex(result.stdout, r"Example")
            self.assertIn("--quiet", result.stdout)

    def test_lists(self):
        engines = json.loads(run("list", "engines", "--json").stdout)
        self.assertIn(("bullet", "double"), [(e["engine"], e.get("precision")) for e in engines])
        self.assertEqual(engines[0]["profiles"], ["default", "naive"])
        scenarios = json.loads(run("list", "scenarios", "--json").stdout)
        self.assertEqual(len(scenarios), len(list(SCENES.glob("*.yaml"))))
        observables = [o["name"] for o in json.loads(run("list", "observables", "--json").stdout)]
        self.assertIn("effective_restitution", observables)
        models = json.loads(run("list", "models", "--json").stdout)
        solved = {(m["key"], m["model"]) for m in models if m["solver"]}
        self.assertIn(("normal", "hard"), solved)
        self.assertNotIn(("normal", "hertz"), solved)
        self.assertIn("hertz", [m["model"] for m in models])
        self.assertIn("bullet", run("list", "engines").stdout)

    def test_explain_runs_nothing_and_says_what_is_left_out(self):
        result = run("explain", SCENES / "symmetric-30cms.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        left_out = result.stdout.split("Left out")[1].split("Bodies")[0]
        self.assertIn("rolling friction", left_out)
        self.assertIn("0.3571428571", result.stdout)
        self.assertIn("not represented", result.stdout)

    def test_explain_derives_a_linear_contacts_numbers(self):
        file = self.scene("")
        file.write_text(file.read_text().replace(
            "{model: hard, restitution: 0.9}",
            "{model: linear, restitution: 0.9, collision_time: 2.55e-5}").replace(
            "{model: none}", "{model: viscous, damping_ratio: 0.5, friction: 0.5}"))
        result = run("explain", file)
        self.assertEqual(result.returncode, 0, result.stderr)
        # γ_N = −2 ln e_n/t_col, ω0² = (π/t_col)² + γ_N²/4, C = π A γ_S/(2 ω0).
        gamma = -2 * math.log(0.9) / 2.55e-5
        omega0 = math.hypot(math.pi / 2.55e-5, gamma / 2)
        c = math.pi * 2.5 * gamma / 2 / (2 * omega0)
        for text in (f"γ_N = {gamma:.6g}", f"ω0 = {omega0:.6g}", f"C = {c:.4g}",
                     "0.3571428571", "contacts[0].normal.model"):
            self.assertIn(text, result.stdout)

    def test_every_bundled_scene_runs_in_the_reference(self):
        report = json.loads(run("run", *sorted(SCENES.glob("*.yaml")), "--json", "-",
                                "--phases", "1").stdout)
        for result in report["results"]:
            reference = result["reference"]
            name = result["scenario"]["name"]
            self.assertGreater(len(reference["observables"]), 5, name)
            for key, value in reference["closed_form"].items():
                found = reference["observables"][key]["value"]
                self.assertTrue(math.isclose(found, value, rel_tol=1e-12, abs_tol=1e-12), key)
            for engine in result["runs"]:
                self.assertEqual(engine["status"], "ok", name)

    def test_schema_is_the_committed_one(self):
        self.assertEqual(run("schema").stdout, (SCENES / "schema.json").read_text())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
