#!/usr/bin/env python3
"""Runs `slipcheck check` as a CI job does, and the lines of docs/ci.md.

usage: check_test.py SLIPCHECK SOURCE_DIR
"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

SLIPCHECK, SOURCE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
FOLDER = tempfile.TemporaryDirectory()


def at_240_hz(name):
    """A bundled scene with one rate for each engine, which is enough here."""
    scene = Path(FOLDER.name) / f"{name}.yaml"
    text = (SOURCE / "scenarios" / scene.name).read_text()
    scene.write_text(re.sub(r"rate: \[[^]]*\]", "rate: 240", text))
    return scene


SCENES = [at_240_hz(name) for name in ("roll-to-rest", "symmetric-30cms")]
FAULTY = SLIPCHECK.parent / "faulty"
RUN = "bullet double default 240 Hz"

FAULTY_SCENE = """slipcheck: 1
name: ball
title: A ball
materials: {steel: {density: 7850}}
contacts: [{between: [steel, substrate], friction: 0.1}]
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 0.002}, position: [0, 0], velocity: [0.1, 0]}
run: {until: rolling}
compare:
  engines: [{engine: faulty, rate: 240, profile: ok}]
  tolerance: {sliding_time: 10 %}
"""


def has_child(parent):
    for status in Path("/proc").glob("[0-9]*/status"):
        try:
            if f"PPid:\t{parent}\n" in status.read_text():
                return True
        except OSError:  # it ended meanwhile
            continue
    return False


class Check(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.made = Path(folder.name) / "baselines"
        result = cls.check(*SCENES, "--baselines", cls.made, "--update", "--why", "they | are new")
        assert result.returncode == 0, result.stderr
        cls.first_output = result.stdout

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        self.baselines = self.path / "baselines"
        shutil.copytree(self.made, self.baselines)

    @staticmethod
    def check(*arguments, **options):
        options.setdefault("timeout", 300)
        return subprocess.run([SLIPCHECK, "check", "--phases", "4", *map(str, arguments)],
                              capture_output=True, text=True, **options)

    def held(self, *arguments, **options):
        return self.check(*SCENES, "--baselines", self.baselines, *arguments, **options)

    def edit(self, scene, old, new):
        file = self.baselines / f"{scene}.json"
        text = file.read_text()
        self.assertIn(old, text)
        file.write_text(text.replace(old, new))

    def contents(self):
        return {file.relative_to(self.path): file.read_bytes()
                for file in self.path.rglob("*") if file.is_file()}

    def test_new_baselines_come_with_a_line_that_says_why(self):
        self.assertIn("2 new, 0 changed, 0 removed, 0 as they were", self.first_output)
        self.assertIn("git diff", self.first_output)
        text = (self.made.parent / "CHANGES.md").read_text()
        self.assertTrue(text.startswith("# Changed baselines\n"))
        self.assertRegex(text.splitlines()[-1],
                         r"^- \d{4}-\d\d-\d\d, slipcheck \S+ \(\S+\), bullet \S+: 2 new "
                         r"\(roll-to-rest, symmetric-30cms\)\. Why: they \| are new$")

    def test_the_same_again_is_green_and_update_leaves_every_byte(self):
        result = self.held("--json", "-")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        report = json.loads(result.stdout)
        self.assertEqual((report["schema"], report["verdict"]), ("slipcheck-check/1", "unchanged"))
        for scene in report["scenes"]:
            self.assertEqual((scene["changes"], scene["drifted"]), ([], 0))
            self.assertGreater(scene["compared"], 100)
        before = self.contents()
        result = self.held("--update")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 as they were", result.stdout)
        self.assertEqual(self.contents(), before)

    def test_a_wrong_setting_is_red_with_scene_observable_old_and_new_value(self):
        junit, markdown = self.path / "check.xml", self.path / "check.md"
        result = self.held("--set", "rolling_friction_factor=2", "--junit", junit, "--markdown",
                           markdown, "--json", self.path / "check.json")
        self.assertEqual(result.returncode, 1, result.stderr)
        tests = {(test.get("classname"), test.get("name")): test
                 for test in xml.etree.ElementTree.parse(junit).iter("testcase")}
        self.assertIsNone(tests["roll-to-rest", "reference"].find("failure"))
        self.assertIsNone(tests["symmetric-30cms", RUN].find("failure"))
        failure = tests["roll-to-rest", RUN].find("failure")
        baseline = json.loads((self.baselines / "roll-to-rest.json").read_text())
        run = next(run for run in baseline["runs"]
                   if (run["precision"], run["profile"], run["rate"]) == ("double", "default", 240))
        old = run["observables"]["ball.stopping_time"]["median"]
        report = json.loads((self.path / "check.json").read_text())
        change = next(change for scene in report["scenes"] for change in scene["changes"]
                      if change["part"] == RUN and change["observable"] == "ball.stopping_time"
                      and change["statistic"] == "median")
        self.assertEqual(change["before"], old)
        # Twice the friction, half the time; what is left of a time step is less than a tenth.
        self.assertAlmostEqual(change["now"] / old, 0.5, delta=0.05)
        self.assertIn(f"roll-to-rest, {RUN}: ball.stopping_time median was {old} s, is "
                      f"{change['now']} s", failure.text)
        self.assertRegex(failure.get("message"),
                         rf"^roll-to-rest, {RUN}: ball\.\S+ \w+ was \S+ \w+, is \S+ \w+, allowed")
        self.assertIn("roll-to-rest", result.stdout)
        self.assertIn("ball.stopping_time", markdown.read_text())
        self.assertLessEqual(len(markdown.read_bytes()), 8000)

    def test_a_reference_that_moves_by_1e_8_is_red_and_by_1e_10_is_not(self):
        place = r'(?<="ball.stopping_time": \{"value":)[^,]+'
        text = (self.baselines / "roll-to-rest.json").read_text()
        old = float(re.search(place, text)[0])
        for shift, code in ((1e-10, 0), (1e-8, 1)):
            moved = repr(old * (1 + shift))
            # The first is the reference's; an engine's has a median first.
            (self.baselines / "roll-to-rest.json").write_text(re.sub(place, moved, text, count=1))
            result = self.held("--junit", self.path / "check.xml")
            self.assertEqual(result.returncode, code, result.stdout)
        tests = xml.etree.ElementTree.parse(self.path / "check.xml").iter("testcase")
        failures = [test for test in tests if test.find("failure") is not None]
        self.assertEqual([test.get("name") for test in failures], ["reference"])
        message = failures[0].find("failure").get("message")
        for part in ("roll-to-rest", "ball.stopping_time", moved, repr(old)):
            self.assertIn(part, message)
        before = (self.baselines / "roll-to-rest.json").read_text()
        result = self.held("--update")
        self.assertEqual(result.returncode, 0, result.stderr)
        after = (self.baselines / "roll-to-rest.json").read_text()
        self.assertNotEqual(before, after)
        reference = json.loads(after)["reference"]["observables"]
        self.assertEqual(reference["ball.stopping_time"]["value"], old)
        line = (self.path / "CHANGES.md").read_text().splitlines()[-1]
        self.assertIn("1 changed (roll-to-rest)", line)
        self.assertIn("ball.stopping_time value was", line)
        self.assertTrue(line.endswith("Why: to be told"), line)
        self.assertEqual(self.held("-q").returncode, 0)

    def test_another_engine_version_is_compared_and_marked(self):
        real = json.loads((self.baselines / "roll-to-rest.json").read_text())["runs"][0]["version"]
        self.edit("roll-to-rest", f'"version": "{real}"', '"version": "2.82"')
        mark = f"bullet 2.82, now {real}"
        junit, markdown = self.path / "check.xml", self.path / "check.md"
        result = self.held("--junit", junit, "--markdown", markdown, "--json", "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([mark], json.loads(result.stdout)["scenes"][0]["versions"])
        for file in (junit, markdown):
            self.assertIn(mark, file.read_text())
        self.assertIn(mark, self.held().stdout)

    def test_ensembles_of_another_size_need_new_baselines(self):
        arguments = [SLIPCHECK, "check", SCENES[0], "--baselines", self.baselines, "--phases", "2"]
        result = subprocess.run([*arguments, "--update"], capture_output=True, text=True,
                                timeout=100)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("0 new, 1 changed", result.stdout)
        self.assertEqual(subprocess.run([*arguments, "-q"], timeout=100).returncode, 0)

    def test_what_stands_alone_or_has_changed_is_red(self):
        (self.baselines / "symmetric-30cms.json").unlink()
        result = self.held("--all")
        self.assertEqual(result.returncode, 1)
        self.assertIn("it has no baseline", result.stdout)
        scene = self.path / "roll-to-rest.yaml"
        text = SCENES[0].read_text()
        scene.write_text(re.sub("limit: [^,}]*", "limit: 7777", text))
        self.assertNotEqual(scene.read_text(), text)
        result = self.check(scene, "--baselines", self.baselines)
        self.assertEqual(result.returncode, 1)
        self.assertIn("the scene is not that of the baseline", result.stdout)

    def test_comments_layout_and_titles_are_not_the_scene(self):
        scene = self.path / "roll-to-rest.yaml"
        text = "# another comment\n" + SCENES[0].read_text().replace("\n", "   # and more\n", 1)
        scene.write_text(re.sub("title: .*", "title: Another title", text))
        result = self.check(scene, "--baselines", self.baselines)
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_without_baselines_it_says_how_to_make_them_and_writes_its_files(self):
        none, markdown = self.path / "none", self.path / "check.md"
        result = self.check(SCENES[0], "--baselines", none, "--markdown", markdown)
        self.assertEqual(result.returncode, 1, result.stderr)
        line = f"slipcheck check {SCENES[0]} --baselines {none} --update makes them"
        self.assertIn(line, result.stdout)
        self.assertIn("there are no baselines yet", markdown.read_text())
        made = subprocess.run([SLIPCHECK, *line.split()[1:-2], "--phases", "4"], timeout=300,
                              capture_output=True)
        self.assertEqual(made.returncode, 0)
        self.assertEqual(self.check(SCENES[0], "--baselines", none).returncode, 0)

    def test_an_engine_that_fails_where_it_did_not_is_exit_3(self):
        scene = self.path / "ball.yaml"
        scene.write_text(FAULTY_SCENE)
        environment = dict(os.environ, SLIPCHECK_ENGINE_PATH=str(FAULTY))
        arguments = [scene, "--baselines", self.path / "faulty"]
        result = self.check(*arguments, "--update", env=environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.check(*arguments, env=environment).returncode, 0)
        result = self.check(*arguments, "--set", "fault=kill-at-step-10", "--junit",
                            self.path / "check.xml", env=environment)
        self.assertEqual(result.returncode, 3, result.stdout + result.stderr)
        self.assertIn("status was ok, is crashed", (self.path / "check.xml").read_text())

    def test_bad_input_is_exit_2_with_the_rule_and_writes_nothing(self):
        pipe = Path(tempfile.mkdtemp(dir=self.path.parent)) / "changes"  # that nobody writes to
        self.addCleanup(shutil.rmtree, pipe.parent)
        os.mkfifo(pipe)
        before = self.contents()
        outputs = ["--junit", self.path / "no.xml", "--json", self.path / "no.json"]
        for arguments, message in (
                (["--phases", "5"], "--phases: must be 4, as of "),
                (["--set", "rolling_friction_facto=2"],
                 "--set: rolling_friction_facto: is no setting of this engine (did you mean "
                 "rolling_friction_factor?)"),
                (["--set", "rolling_friction_factor=-1"],
                 "--set: rolling_friction_factor: must be a number >= 0"),
                (["--set", "erp"], "--set: must be name=value, got 'erp'"),
                (["--set", "erp=0.1", "--set", "erp=0.2"],
                 "--set: must name a setting once, got 'erp' again"),
                (["--set", "erp=0.1", "--update"], "--set: must not stand beside --update"),
                (["--why", "because"], "--why: must stand beside --update"),
                (["--markdown", self.path / "none/check.md"], "--markdown: its directory must"),
                (["--changes", pipe, "--update"], f"--changes: must be a regular file, got {pipe}"),
                ([self.path / "none.yaml"], "none.yaml")):
            with self.subTest(arguments):
                # The last --phases counts.
                command = [SLIPCHECK, "check", *SCENES, "--baselines", self.baselines, *outputs,
                           *([] if "--phases" in arguments else ["--phases", "4"]), *arguments]
                result = subprocess.run([*map(str, command)], capture_output=True, text=True,
                                        timeout=100)
                self.assertEqual(result.returncode, 2, result.stdout)
                self.assertIn(message, result.stderr)
                self.assertEqual(self.contents(), before)
        result = self.check(*SCENES, "--baselines", SCENES[0])
        self.assertEqual(result.returncode, 2)
        self.assertIn("--baselines: must be a directory, got ", result.stderr)
        self.edit("roll-to-rest", '"status": "ok"', '"status": "fine"')
        before = self.contents()
        result = self.held(*outputs)
        self.assertEqual(result.returncode, 2)
        self.assertIn("roll-to-rest.json: runs[0].status: must be one of ok,", result.stderr)
        self.assertEqual(self.contents(), before)

    def test_an_interrupted_check_writes_nothing(self):
        before = self.contents()
        process = subprocess.Popen(
            [SLIPCHECK, "check", SOURCE / "scenarios/ten-ball-break.yaml", "--phases", "2000",
             "--baselines", self.baselines, "--update", "--json", self.path / "check.json"],
            stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        while process.poll() is None and not has_child(process.pid):
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 130, process.stderr.read())
        process.stderr.close()
        process.stdout.close()
        self.assertEqual(self.contents(), before)


class Documentation(unittest.TestCase):
    """The lines of docs/ci.md, in a project laid out as it says."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        (self.path / "physics/scenes").mkdir(parents=True)
        shutil.copy(SCENES[0], self.path / "physics/scenes")
        self.text = (SOURCE / "docs/ci.md").read_text()
        self.environment = dict(os.environ, PATH=f"{SLIPCHECK.parent}:{os.environ['PATH']}",
                                GITHUB_STEP_SUMMARY=str(self.path / "summary.md"))

    def sh(self, line):
        return subprocess.run(["sh", "-c", line], cwd=self.path, env=self.environment, text=True,
                              capture_output=True, timeout=300)

    def blocks(self, language):
        return re.findall(rf"^```{language}\n(.*?)^```", self.text, re.S | re.M)

    def make_baselines(self):
        line = next(line for block in self.blocks("sh") for line in block.splitlines()
                    if "--update" in line)
        result = self.sh(line)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.path / "physics/baselines/roll-to-rest.json").exists())
        self.assertIn("friction now combined", (self.path / "physics/CHANGES.md").read_text())

    def test_shell_lines(self):
        self.make_baselines()
        lines = [line for block in self.blocks("sh") for line in block.splitlines()
                 if line.startswith("slipcheck check physics/") and "--update" not in line]
        self.assertEqual(len(lines), 2)
        for line in lines:
            result = self.sh(line)
            self.assertEqual(result.returncode, 1 if "--set" in line else 0, result.stderr)

    def test_github_action(self):
        """What the action runs, with what the documented job gives it."""
        self.make_baselines()
        job = next(block for block in self.blocks("yaml") if "uses: SLIPCHECK" in block)
        action = (SOURCE / "action.yml").read_text()
        given = dict(re.findall(r"^ +(packages|scenes|baselines|arguments): (.*)$", job, re.M))
        self.assertEqual(set(given), {"packages", "scenes", "baselines"})
        for name in [*given, "arguments"]:
            self.assertRegex(action, rf"(?m)^  {name}:$")
        step = action[action.index("- name: Check"):]
        script = textwrap.dedent(step[step.index("run: |") + 6:])
        self.environment |= {"SCENES": given["scenes"], "BASELINES": given["baselines"], "ARGUMENTS": "",
                             "GITHUB_OUTPUT": str(self.path / "outputs")}
        result = subprocess.run(["bash", "-ec", script], cwd=self.path, env=self.environment, text=True,
                                capture_output=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("nothing has moved", (self.path / "summary.md").read_text())
        outputs = dict(line.split("=", 1) for line in (self.path / "outputs").read_text().splitlines())
        xml.etree.ElementTree.parse(outputs["junit"])
        for file in outputs.values():
            self.addCleanup(shutil.rmtree, Path(file).parent, True)

    def test_gitlab_job(self):
        self.make_baselines()
        (job,) = [line for block in self.blocks("yaml") for line in re.findall(r"- (slipcheck check .*)", block)]
        self.assertEqual(self.sh(job).returncode, 0, job)
        xml.etree.ElementTree.parse(self.path / "check.xml")

    def test_ctest(self):
        self.make_baselines()
        (snippet,) = self.blocks("cmake")
        (self.path / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(game LANGUAGES NONE)\n"
            "enable_testing()\n" + snippet)
        (line,) = [line for block in self.blocks("sh") for line in block.splitlines()
                   if line.startswith("cmake ")]
        result = self.sh(line)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("100% tests passed, 0 tests failed out of 1", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
