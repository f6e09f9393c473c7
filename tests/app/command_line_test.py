#!/usr/bin/env python3
"""Runs the program as a user does and checks what contract.md and the README promise.

usage: command_line_test.py SLIPCHECK SOURCE_DIR [sanitized] [unscripted]
"""
import base64
import json
import math
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
SCENES = SOURCE / "scenarios"
FAULTY = Path(SLIPCHECK).parent / "faulty"
SANITIZED = "sanitized" in sys.argv[3:]


def run(*arguments, **options):
    environment = dict(os.environ, **options.pop("env", {}))
    return subprocess.run([SLIPCHECK, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600, env=environment, **options)


def page_data(page):
    if "unscripted" in sys.argv[3:]:
        raise unittest.SkipTest("the program is built without the page's script")
    packed = re.search(r'id="slipcheck-data">([^<]*)<', page).group(1)
    return json.loads(zlib.decompress(base64.b64decode(packed)))


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


def wait_until_idle(parent, name):
    """Waits until that child has computed something and then nothing for 2 s."""
    deadline, used, since = time.time() + 300, 0, time.time()
    while time.time() < deadline and (used == 0 or time.time() - since < 2):
        time.sleep(0.1)
        child = child_of(parent, name)
        now = cpu_ticks(child) if child else used
        if now != used:
            used, since = now, time.time()


def cpu_ticks(process):
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:  # it ended meanwhile
        return 0
    return int(fields[11]) + int(fields[12])


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

    def test_what_is_no_number_is_in_no_range(self):
        scene = self.scene("")
        for arguments in (["run", scene, "--time-limit"], ["check", scene, "--time-limit"],
                          ["precision", scene, "--rates"], ["stability", scene, "--rates"],
                          ["tune", scene, "--engine", "bullet", "-o", self.path / "p.yaml", "--budget"],
                          ["versions", "a", "b", "c", "--threshold"], ["gas", scene, "--fraction"],
                          ["conformance", "bullet", "--reply-limit"]):
            for number in ("nan", "-nan", "-1"):
                with self.subTest(f"{arguments[0]} {arguments[-1]} {number}"):
                    result = run(*arguments[:-1], f"{arguments[-1]}={number}")
                    self.assertEqual((result.returncode, result.stdout), (2, ""))
                    self.assertIn(f"{arguments[-1]}: Value {number} ", result.stderr)

    def test_a_full_disk_is_told_wherever_something_is_printed(self):
        scene = self.scene("{engine: bullet, rate: 240}")
        commands = [["--version"], ["list", "observables"], ["schema"], ["explain", scene],
                    ["run", scene], ["check", scene, "--baselines", self.path / "none"],
                    ["precision", scene, "--engines", "bullet", "--rates", "240", "--phases", "1",
                     "--profiles", "default"],
                    ["stability", scene, "--engines", "bullet", "--rates", "240", "--phases", "1",
                     "--profiles", "default"]]
        with open("/dev/full", "w") as full:
            for command in commands:
                with self.subTest(command):
                    result = subprocess.run([SLIPCHECK, *map(str, command)], stdout=full, text=True,
                                            stderr=subprocess.PIPE, timeout=600)
                    self.assertEqual(result.returncode, 4, result.stderr)
                    self.assertIn("cannot write to ", result.stderr)
                    self.assertIn("No space left on device", result.stderr)
            # Who cannot read a message loses that alone.
            for command, code in ((["run", self.path / "none.yaml"], 2), (["nonsense"], 2),
                                  (["run", scene, "--svg", "/dev/null"], 2),
                                  (["report", scene, "-o", self.path / "page.html"], 2)):
                with self.subTest(command):
                    result = subprocess.run([SLIPCHECK, *map(str, command)], stderr=full,
                                            stdout=subprocess.PIPE, timeout=600)
                    self.assertEqual(result.returncode, code)

    def test_a_limit_on_the_size_of_files_leaves_none_behind(self):
        scene, out = self.scene(""), self.path / "out.json"
        files = sorted(self.path.iterdir())
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
        # What a build for coverage counts would be cut off too, and is not to be that of the rest.
        counts = tempfile.TemporaryDirectory()
        self.addCleanup(counts.cleanup)
        result = subprocess.run([SLIPCHECK, "run", scene, "--json", out], capture_output=True,
                                text=True, timeout=600, preexec_fn=limit,
                                env=dict(os.environ, GCOV_PREFIX=counts.name))
        told = [line for line in result.stderr.splitlines() if not line.startswith("libgcov")]
        self.assertEqual((result.returncode, told[-1]),
                         (4, f"slipcheck: cannot write {out}: File too large"))
        self.assertEqual(sorted(self.path.iterdir()), files)

    def test_what_cannot_be_written_is_refused_before_anything_runs(self):
        # In /proc not even root can make a folder.
        scene, file = self.scene("{engine: no-such-engine, rate: 240}"), self.path / "file"
        file.write_text("a file")
        for option in ("--out", "--svg", "--vtk", "--xyz"):
            for folder in ("/proc/results", "/proc/none/results", file / "results"):
                with self.subTest(f"{option} {folder}"):
                    result = run("run", scene, option, folder)
                    self.assertEqual((result.returncode, result.stdout), (2, ""))
                    self.assertIn(f"slipcheck: {option}: must be a directory that can be written "
                                  f"to, got {folder}: ", result.stderr)
        self.assertEqual(run("run", scene, "--html", "/proc/page.html").returncode, 2)
        self.assertEqual(run("figures", "/proc/figures", "--only", "K7").returncode, 2)
        self.assertEqual(sorted(self.path.iterdir()), [file, scene])

    def test_model_without_a_solver_is_refused_by_name(self):
        file = self.scene("")
        text = file.read_text()
        for old, new in self.UNSUPPORTED:
            text = text.replace(old, new)
        file.write_text(text)
        result = run("run", file)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"pair\.yaml:8:\d+: contacts\[0\]\.normal\.restitution: .*"
                                        r"materials\.steel\.dissipation_time")

    def test_profiles_are_files_and_faulty_ones_are_exit_2(self):
        profile = self.path / "mine.yaml"
        profile.write_text((SOURCE / "bullet_backend/profiles/naive.yaml").read_text())
        file = self.scene("{engine: bullet, rate: 240, profile: ./mine.yaml},"
                          "{engine: bullet, rate: 240, profile: naive}")
        mine, naive = json.loads(run("run", file, "--json", "-", "--phases", "4").stdout)["runs"]
        self.assertEqual((mine["status"], mine["profile"]), ("ok", "./mine.yaml"))
        self.assertEqual(mine["settings"]["coefficients"], "fields")
        for key in ("settings", "observables", "applied"):
            self.assertEqual(mine[key], naive[key])
        self.assertIn("the profile sets coefficients", run("explain", file, "--all").stdout)

        profile.write_text(profile.read_text().replace("coefficients:", "coeficients:"))
        out = self.path / "out.json"
        for arguments in (["run", file, "--json", out], ["explain", file]):
            result = run(*arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertRegex(result.stderr, r"mine\.yaml:\d+:3: settings\.coeficients: is no setting "
                                            r"of this engine \(did you mean coefficients\?\)")
        profile.unlink()
        result = run("run", file, "--json", out)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"pair\.yaml:16:\d+: compare\.engines\[0\]\.profile: .*"
                                        r"No such file or directory, got \./mine\.yaml")
        self.assertFalse(out.exists())

    def test_engines_that_are_not_installed_are_exit_2_before_anything_runs(self):
        out, scene = self.path / "out.json", SCENES / "symmetric-30cms.yaml"
        for name, rule in (("rapier@0.0.1", "rapier@0.0.1 is not installed: slipcheck engines add rapier@0.0.1 may have it"),
                           ("odd", r"must be one of the engines bullet, .*did you mean ode\?\), got odd")):
            for arguments in (["run", scene, "--engines", f"bullet,{name}", "--json", out],
                              ["precision", scene, "--engines", name, "--json", out],
                              ["stability", "--engines", name, "--json", out],
                              ["tune", scene, "--engine", name, "-o", out]):
                result = run(*arguments)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertRegex(result.stderr, f"^--engines?: {rule}\n")
        result = run("run", scene, "--engines", "bullet", "--profiles", "tunde", "--json", out)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"--profiles: must be profiles of the engines, default, fast, naive, physical, tuned, "
                                        r"or paths \(did you mean tuned\?\), got tunde")
        self.assertFalse(out.exists())

    def test_killed_worker_leaves_every_other_run_intact_and_exit_3(self):
        bullet = "{engine: bullet, precision: double, rate: [240, 1000]}"
        file = self.scene("{engine: faulty, precision: double, profile: slow, rate: 1000}, " + bullet)
        out = self.path / "out.json"
        path = f"{Path(SLIPCHECK).parent}:{FAULTY}"
        process = subprocess.Popen([SLIPCHECK, "run", file, "--json", out],
                                   env=dict(os.environ, SLIPCHECK_ENGINE_PATH=path),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        victim, before = None, -1
        deadline = time.time() + 300
        # The first one may only have been asked what settings there are; 0.3 s is inside the run.
        while (victim is None or victim != before) and time.time() < deadline:
            time.sleep(0.3)
            victim, before = child_of(process.pid, "engine-faulty"), victim
        self.assertIsNotNone(victim)
        os.kill(victim, signal.SIGKILL)
        _, stderr = process.communicate(timeout=600)
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
        # So many steps that the worker's CPU time, counted in ticks of 10 ms, shows that it ran.
        file = self.scene("{engine: bullet, precision: double, rate: 16000},"
                          "{engine: faulty, precision: double, profile: slow, rate: 1000}")
        out = self.path / "out.json"
        path = f"{Path(SLIPCHECK).parent}:{FAULTY}"
        process = subprocess.Popen([SLIPCHECK, "run", file, "--json", out],
                                   env=dict(os.environ, SLIPCHECK_ENGINE_PATH=path),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_until_idle(process.pid, "engine-bullet")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=600)
        self.assertEqual(process.returncode, 130)
        report = json.loads(out.read_text())
        self.assertEqual([r["status"] for r in report["runs"]], ["ok", "skipped"])

    def result_of(self, *arguments):
        result = run("run", *arguments, "--json", "-")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return re.sub(r'"cpu_seconds": [^,\n]*', '"cpu_seconds": 0', result.stdout)

    def test_the_number_of_workers_changes_no_bit(self):
        pair = self.scene("{engine: bullet, precision: double, rate: 240}")
        # A cascade takes sanitizers minutes, and its reference might run out of time.
        third = "asymmetric.yaml" if SANITIZED else "three-ball-line.yaml"
        for files in ([pair], [pair, SCENES / "slide-to-roll.yaml", SCENES / third]):
            alone = self.result_of(*files, "--phases", "7", "--workers", "1")
            for workers in (2, 3, 16):
                self.assertEqual(
                    self.result_of(*files, "--phases", "7", "--workers", str(workers)), alone)

    def test_general_loops_give_the_same(self):
        # Steps of fixed length in the loop that has everything: the same to the last bit.
        text = (SCENES / "rubbing-capped.yaml").read_text().replace(
            "compare:", "compare:\n  reference: steps\n  steps_per_contact: 50")
        file = self.path / "steps.yaml"
        file.write_text(text)
        special, general = (json.loads(self.result_of(file, "--time-limit", "600", *option))["reference"]["observables"]
                            for option in ((), ("--general",)))
        self.assertEqual(special, general)
        self.assertGreater(len(special), 10)
        # Bullet: likewise, frames and all.
        pair = self.scene("{engine: bullet, precision: double, rate: 240}")
        special, general = (json.loads(self.result_of(pair, *option))["runs"][0]["observables"]
                            for option in ((), ("--general",)))
        self.assertEqual(special, general)
        self.assertIn("Loop\n    phases on a level, still plane\n", run("explain", pair, "--all").stdout)
        text = run("explain", pair, "--general", "--all").stdout
        self.assertIn("Loop\n    phases on any plane\n", text)
        # Bullet itself makes no rows for friction that is not there.
        self.assertIn("left out: rolling rows", text)
        self.assertGreater(run("explain", pair, "--all").stdout.count("left out: "),
                           text.count("left out: "))

    def test_result_folder_and_same_inputs_same_bytes(self):
        file = self.scene("{engine: bullet, precision: double, rate: 240}")
        texts = []
        for name in ("a", "b"):
            result = run("run", file, "--out", self.path / name)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(sorted(p.name for p in (self.path / name).iterdir()),
                             ["pair.json", "pair.motion.json", "report.html", "results.csv"])
            text = (self.path / name / "pair.json").read_text()
            texts.append((re.sub(r'"cpu_seconds": [^,\n]*', "", text),
                          (self.path / name / "pair.motion.json").read_text()))
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
        for command in ("run", "conformance", "convert", "explain", "figures", "list", "schema"):
            result = run(command, "--help")
            self.assertEqual(result.returncode, 0)
            self.assertRegex(result.stdout, r"Example")
            self.assertIn("--quiet", result.stdout)

    def test_a_folder_that_is_gone_is_no_end(self):
        for arguments, code in ((["--version"], 0), (["list", "models"], 0), (["run", "s.yaml"], 2)):
            folder = self.path / "gone"
            folder.mkdir()
            result = subprocess.run(["sh", "-c", 'rmdir "$PWD"; exec "$@"', "sh", SLIPCHECK, *arguments], cwd=folder,
                                    capture_output=True, text=True, timeout=60)
            self.assertEqual(result.returncode, code, result.stderr)

    def test_lists(self):
        engines = json.loads(run("list", "engines", "--json").stdout)
        self.assertIn(("bullet", "double"), [(e["engine"], e.get("precision")) for e in engines])
        shipped = sorted(f.stem for f in (SOURCE / "bullet_backend/profiles").glob("*.yaml"))
        self.assertLessEqual({"default", "naive"}, set(shipped))
        self.assertEqual(engines[0]["profiles"], shipped)
        profiles = json.loads(run("list", "profiles", "--json").stdout)
        self.assertEqual([p["profile"] for p in profiles if p["engine"] == "bullet"], shipped)
        self.assertTrue(all(p["about"] for p in profiles))
        settings = json.loads(run("list", "settings", "--json").stdout)
        installed = {e["engine"] for e in engines if e["status"] == "ok"}
        self.assertEqual({s["engine"] for s in settings}, installed)
        coefficients = [s for s in settings
                        if s["engine"] == "bullet" and s["name"] == "coefficients"]
        self.assertEqual(len(coefficients), 1)
        self.assertEqual(coefficients[0]["precision"], ["double", "single"])
        self.assertIn("fields", coefficients[0]["takes"])
        for setting in settings:
            if setting["takes"] in ("number", "whole number"):
                self.assertGreaterEqual(setting["shipped"], setting["low"] or -math.inf)
        # As a profile has to write them.
        table = run("list", "settings").stdout
        self.assertRegex(table, r"split_impulse +true +true, false ")
        self.assertRegex(table, r"substeps +1 +whole number, 1 … \d+ ")
        scenarios = json.loads(run("list", "scenarios", "--json").stdout)
        self.assertEqual(len(scenarios), len(list(SCENES.glob("*.yaml"))))
        observables = [o["name"] for o in json.loads(run("list", "observables", "--json").stdout)]
        self.assertIn("effective_restitution", observables)
        models = json.loads(run("list", "models", "--json").stdout)
        solvers = {(m["key"], m["model"]): m["solvers"] for m in models}
        for key, model, expected in (
                ("normal", "hard", ["event"]), ("normal", "hertz", ["contact"]),
                ("tangential", "asperity", ["contact"]), ("tangential", "hard", ["event"]),
                ("drilling", "coupled", ["event", "contact"]),
                ("collapse", "contact_time", ["event"]),
                ("motion", "oscillate", ["event", "contact"])):
            self.assertEqual(solvers[key, model], expected, model)
        self.assertIn("bullet", run("list", "engines").stdout)

    def test_explain_runs_nothing_and_says_what_is_left_out(self):
        result = run("explain", SCENES / "symmetric-30cms.yaml", "--all")
        self.assertEqual(result.returncode, 0, result.stderr)
        left_out = result.stdout.split("Left out")[1].split("Bodies")[0]
        self.assertIn("rolling friction", left_out)
        self.assertIn("0.3571428571", result.stdout)
        self.assertIn("not represented", result.stdout)

    # A restitution over the speed for which the material lacks its dissipation_time.
    UNSUPPORTED = (("{model: hard, restitution: 0.9}", "{model: hard, restitution: viscoelastic}"),
                   ("{density: 7.85}",
                    "{density: 7.85, young_modulus: 2.06e12, poisson_ratio: 0.28}"))

    def test_explain_names_what_no_solver_takes(self):
        file = self.scene("")
        text = file.read_text()
        for old, new in self.UNSUPPORTED:
            text = text.replace(old, new)
        file.write_text(text)
        result = run("explain", file, "--all")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("No solver for this scene", result.stdout)
        self.assertIn("contacts[0].normal.restitution", result.stdout)

    def test_explain_fits_a_screen_and_keeps_warnings(self):
        short = run("explain", SCENES / "symmetric-30cms.yaml").stdout
        whole = run("explain", SCENES / "symmetric-30cms.yaml", "--all").stdout
        self.assertLessEqual(len(short.splitlines()), 60)
        self.assertGreater(len(whole.splitlines()), 100)
        for part in ("Needs", "Expected", "not represented", ": --all"):
            self.assertIn(part, short)
        self.assertNotIn(": --all", whole)

    def test_what_is_misspelt_gets_the_nearest_word(self):
        for arguments, near in ((["rnu", "x.yaml"], "run"), (["list", "--jsno"], "--json"),
                                (["explian", "x.yaml"], "explain")):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(f"Did you mean {near}?", result.stderr)
        file = self.path / "typo.yaml"
        file.write_text(scene_text("", until="roling"))
        self.assertIn("did you mean rolling?", run("explain", file).stderr)

    def test_a_new_scene_runs_and_has_its_schema(self):
        result = run("new", "my-scene", cwd=self.path)
        self.assertEqual((result.returncode, result.stdout), (0, "my-scene.yaml\n"))
        text = (self.path / "my-scene.yaml").read_text()
        self.assertTrue(text.startswith("# yaml-language-server: $schema=slipcheck.schema.json\n"))
        self.assertEqual(json.loads((self.path / "slipcheck.schema.json").read_text()),
                         json.loads(run("schema").stdout))
        done = run("run", "my-scene.yaml", "--phases", "2", "--json", "out.json", cwd=self.path)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        # Decelerates by mu g: it rolls after 2 v / (7 mu g).
        seen = json.loads((self.path / "out.json").read_text())["reference"]["observables"]
        self.assertAlmostEqual(seen["ball.sliding_time"]["value"], 2 * 0.5 / (7 * 0.2 * 9.80665),
                               delta=1e-9)
        again = run("new", "my-scene", cwd=self.path)
        self.assertEqual(again.returncode, 2)
        self.assertIn("my-scene.yaml is there already", again.stderr)
        self.assertEqual(run("new", "../x", cwd=self.path).returncode, 2)
        self.assertEqual((self.path / "my-scene.yaml").read_text(), text)

    def test_the_schema_of_profiles_takes_the_shipped_ones(self):
        schema = json.loads(run("schema", "--profile").stdout)
        for file in (SOURCE / "bullet_backend/profiles").glob("*.yaml"):
            keys = re.findall(r"^([a-z-]+):", file.read_text(), re.MULTILINE)
            self.assertLessEqual(set(keys), set(schema["properties"]), file)
            self.assertLessEqual(set(schema["required"]), set(keys), file)

    def test_tables_in_a_pipe_have_all_columns_and_follow_COLUMNS(self):
        file = self.scene("{engine: bullet, precision: double, rate: 240}")
        heads = [line for line in run("run", file, "--phases", "2").stdout.splitlines()
                 if "max error" in line]
        for column in ("reference", "median", "min … max", "tolerance"):
            self.assertTrue(heads and column in heads[0], (column, heads))
        narrow = run("run", file, "--phases", "2", env={"COLUMNS": "60"}).stdout
        self.assertLessEqual(max(map(len, narrow.splitlines())), 60)
        self.assertIn("no room for", narrow)

    def test_a_result_folder_names_its_page(self):
        out = self.path / "results"
        result = run("run", self.scene(""), "--out", out)
        self.assertIn(f"{out / 'report.html'}\n", result.stderr)

    def test_explain_prints_columns(self):
        text = run("explain", SCENES / "rubbing-capped.yaml", "--all").stdout
        for line in (
                "    sliding friction on the substrate    straight slip, parabolic paths",
                "                            R           m                   I   A = mR²/I"
                "        speed         slip",
                "    i                2.000 mm    263.1 mg    4.2089e-10 kg m²         2.5"
                "   300.0 mm/s        0 m/s",
                "    t_col               24.96 µs  duration of a collision at 300.0 mm/s",
                "                        16.23 µs  of velocity Verlet, undamped",
                "      When they begin to slide",
                "      After the collision                i               j",
                "    t^s                           73.25 ms        92.94 ms  sliding time",
                "    i.sliding_time                           0.08309404844 s",
                "    the profile sets substeps                         4",
                "    solver_iterations                    10"):
            self.assertIn("\n" + line + "\n", text)

    def test_a_box_is_run_and_told_of_in_every_form(self):
        scene = self.path / "box.yaml"
        text = (SCENES / "box-rough-moving-walls.yaml").read_text()
        scene.write_text(text.split("compare:")[0])
        table = run("run", scene)
        self.assertEqual(table.returncode, 0, table.stderr)
        self.assertRegex(" ".join(table.stdout.split()), "means over 800 samples after 200 periods")
        self.assertIn("all.height", table.stdout)
        run("run", scene, "--out", self.path / "box")
        report = json.loads((self.path / "box/box-rough-moving-walls.json").read_text())
        reference = report["reference"]
        statistics = reference["statistics"]
        self.assertEqual((statistics["samples"], statistics["discarded_periods"],
                          statistics["stride"]), (800, 200, 1))
        for name in ("height", "kinetic_energy", "rotational_energy", "collision_rate"):
            values = statistics["series"][name]
            self.assertEqual(len(values), 800)
            self.assertAlmostEqual(sum(values) / 800 / reference["observables"]["all." + name]["value"],
                                   1, delta=1e-12)
        # Phase zero at each 10 ms.
        for k, instant in enumerate(statistics["series"]["time"]):
            self.assertAlmostEqual(instant, 0.01 * (201 + k), delta=1e-11)
        page = page_data((self.path / "box/report.html").read_text())
        self.assertEqual(len(page["scenes"][0]["charts"][0]["panels"]), 4)

    def test_every_bundled_scene_runs_in_the_reference(self):
        scenes = sorted(SCENES.glob("*.yaml"))
        if SANITIZED:  # a minute for 200 balls or a cascade, whose code other tests go through
            slow = ("gas-", "pile-", "three-ball-line", "ten-ball-break")
            scenes = [scene for scene in scenes if not scene.stem.startswith(slow)]
        # Sanitizers are slow, and this is no test of limits.
        report = json.loads(run("run", *scenes, "--json", "-", "--phases", "1",
                                "--time-limit", "600").stdout)
        for result in report["results"]:
            reference = result["reference"]
            name = result["scenario"]["name"]
            self.assertGreater(len(reference["observables"]), 5, name)
            for key, value in reference["closed_form"].items():
                found = reference["observables"][key]["value"]
                self.assertTrue(math.isclose(found, value, rel_tol=1e-12, abs_tol=1e-12), key)
            for engine in result["runs"]:
                if engine["status"] == "skipped":  # what an engine cannot do it says
                    self.assertRegex(engine["reason"], "the substrate moves|surfaces", name)
                else:
                    self.assertEqual(engine["status"], "ok", name)

    def test_figures_that_are_asked_for_and_no_others(self):
        texts = []
        for name in ("one", "two"):
            folder = self.path / name / "figures"
            result = run("figures", folder, "--only", "K7,K6", "--quiet")
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
            self.assertEqual(sorted(file.name for file in folder.iterdir()),
                             ["K6.csv", "K6.svg", "K7.csv", "K7.svg"])
            texts.append([file.read_bytes() for file in sorted(folder.iterdir())])
        self.assertEqual(texts[0], texts[1])

    def test_figures_without_gnuplot_keep_their_numbers(self):
        folder, nothing = self.path / "figures", self.path / "nothing"
        nothing.mkdir()
        result = run("figures", folder, "--only", "K7", env=dict(os.environ, PATH=str(nothing)))
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertIn("install gnuplot", result.stderr)
        self.assertEqual([file.name for file in folder.iterdir()], ["K7.csv"])

    def test_figures_of_single_collisions_are_no_longer_in_full(self):
        texts = []
        for name, options in (("brief", []), ("full", ["--full"])):
            folder = self.path / name / "figures"
            self.assertEqual(run("figures", folder, "--only", "L3", *options).returncode, 0)
            texts.append((folder / "L3.csv").read_bytes())
        self.assertEqual(texts[0], texts[1])

    def test_figures_refuses_names_that_no_figure_has(self):
        folder = self.path / "figures"
        result = run("figures", folder, "--only", "K7,K4")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, "slipcheck: --only: must be of K5, K6, K7, K8, K9, K10, K11, "
                         "collision-course, slide-course, spin-exchange, rolling-restitution, "
                         "rolling-gas, B1, B2, L2, L3, L4, L5, L6, L7, L8, L9, L10, L11, L12, L13, "
                         "box-energy-ratio, soft-box-convergence, got K4\n")
        self.assertFalse(folder.exists())
        folder.write_text("a file")
        result = run("figures", folder, "--only", "K7")
        self.assertEqual(result.returncode, 2)
        self.assertIn("must be a directory", result.stderr)
        self.assertEqual(folder.read_text(), "a file")

    def test_schema_is_the_committed_one(self):
        self.assertEqual(run("schema").stdout, (SCENES / "schema.json").read_text())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
