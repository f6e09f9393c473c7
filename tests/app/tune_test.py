#!/usr/bin/env python3
"""Runs `slipcheck tune` as a user does.

usage: tune_test.py SLIPCHECK SOURCE_DIR [sanitized]
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
SCENES = SOURCE / "scenarios"
SANITIZED = "sanitized" in sys.argv[3:]  # one evaluation takes a second
SYMMETRIC = SCENES / "symmetric-30cms.yaml"
QUICK = ["--engine", "bullet", "--rates", "240", "--phases", "4", "--final-phases", "8"]


def run(*arguments, **options):
    return subprocess.run([SLIPCHECK, "tune", *map(str, arguments)], capture_output=True, text=True,
                          timeout=600, **options)


class Tune(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name)
        self.profile = self.path / "fitted.yaml"

    def tuning(self, *arguments):
        result = run(*arguments, *QUICK, "-o", self.profile, "--json", self.path / "out.json")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return result, json.loads((self.path / "out.json").read_text())

    def test_the_profile_is_better_than_the_start_and_runs(self):
        # Of few settings: with all of them a shipped profile is hard to beat.
        result, report = self.tuning(SYMMETRIC, "--held-out", SCENES / "asymmetric.yaml",
                                     "--budget", "25", "--settings",
                                     "erp2,solver_iterations,sor,split_impulse_threshold")
        self.assertEqual(report["schema"], "slipcheck-tuning/1")
        self.assertTrue(report["improved"])
        self.assertLess(report["chosen"]["training"]["worst"],
                        report["start"]["training"]["worst"])
        self.assertIn("held out", result.stdout)
        self.assertIn("Accuracy against time", result.stdout)
        text = self.profile.read_text()
        self.assertIn("name: fitted", text)
        self.assertIn(report["scenes"][0]["sha256"], text)
        self.assertNotIn(str(self.path), text)
        # What tune found is what run shows: the same 8 phases at the same rate.
        scene = self.path / "scene.yaml"
        lines = SYMMETRIC.read_text().splitlines()
        at = next(k for k, line in enumerate(lines) if line.strip() == "engines:")
        rest = [line for line in lines[at + 1:] if "{engine:" not in line]
        engine = "    - {engine: bullet, precision: double, profile: ./fitted.yaml, rate: 240}"
        scene.write_text("\n".join(lines[:at + 1] + [engine] + rest) + "\n")
        shown = subprocess.run([SLIPCHECK, "run", scene, "--phases", "8", "--json", "-"],
                               capture_output=True, text=True, timeout=600)
        errors = json.loads(shown.stdout)["runs"][0]["errors"]
        worst = max(e["max"] / e["tolerance"] for e in errors.values() if e.get("tolerance"))
        self.assertAlmostEqual(worst, report["chosen"]["training"]["worst"], delta=1e-9 * worst)

    def test_goes_on_after_an_interruption_and_loses_nothing(self):
        budget, early = (12, 5) if SANITIZED else (40, 10)
        arguments = [SYMMETRIC, "--budget", budget]
        journal = self.path / "fitted.yaml.journal"
        process = subprocess.Popen([SLIPCHECK, "tune", *map(str, arguments), *QUICK, "-o",
                                    str(self.profile)], stderr=subprocess.PIPE, text=True)
        while process.poll() is None and (not journal.exists()
                                          or journal.read_text().count("\n") < early):
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("goes on there", errors)
        self.assertFalse(self.profile.exists())
        before = journal.read_text()
        self.assertGreaterEqual(before.count("\n"), early)
        _, first = self.tuning(*arguments)
        lines = journal.read_text().splitlines(keepends=True)
        self.assertTrue("".join(lines).startswith(before))
        # No run twice, nor a third time when everything is there; CPU times included.
        questions = [line.split('"answer"')[0] for line in lines]
        self.assertEqual(len(questions), len(set(questions)))
        _, again = self.tuning(*arguments)
        self.assertEqual(again, first)
        self.assertEqual(journal.read_text(), "".join(lines))

    def test_only_the_named_settings_change(self):
        # The message to a wrong name tells the right ones.
        refusal = run(SYMMETRIC, *QUICK, "-o", self.profile, "--settings", "nonsense").stderr
        names = refusal[refusal.index("(") + 1:refusal.index(")")].split(", ")
        self.assertGreater(len(names), 1)
        name = names[0]
        _, report = self.tuning(SYMMETRIC, "--settings", name)
        self.assertLessEqual(set(report["chosen"]["settings"]), {name})

    @unittest.skipIf(SANITIZED, "of engines, whose processes have no sanitizer")
    def test_every_engine_that_is_there_can_be_tuned(self):
        listed = subprocess.run([SLIPCHECK, "list", "engines", "--json"], capture_output=True, text=True, check=True)
        engines = {each["engine"] for each in json.loads(listed.stdout) if each["status"] == "ok"}
        self.assertIn("bullet", engines)
        for engine in sorted(engines):
            with self.subTest(engine):  # without --precision, of which some have one alone
                result = run(SYMMETRIC, "--engine", engine, "--rates", "240", "--phases", "2", "--final-phases", "2",
                             "--budget", "2", "-o", self.profile, "--json", self.path / "out.json")
                self.assertIn(result.returncode, (0, 1), result.stderr)
                report = json.loads((self.path / "out.json").read_text())
                self.assertEqual(report["chosen"]["training"]["failed"], 0)
                self.assertLessEqual(report["chosen"]["training"]["worst"], report["start"]["training"]["worst"])
                Path(f"{self.profile}.journal").unlink()

    def test_quiet_says_nothing(self):
        result = run(SYMMETRIC, *QUICK, "--budget", "0", "-o", self.profile, "--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))
        self.assertTrue(self.profile.exists())

    def test_without_an_improvement_the_start_is_written_and_said_so(self):
        result, report = self.tuning(SYMMETRIC, "--budget", "0")
        # Of the profiles that are shipped one is the best for this scene, and it is said which.
        best = report["no_better_than"]
        self.assertIn(f"nothing that was tried is better than {best}", result.stderr)
        self.assertIn(f"no_better_than: \"{best}\"", self.profile.read_text())
        self.assertFalse(report["improved"])
        shipped = (SOURCE / "bullet_backend" / "profiles" / f"{best}.yaml").read_text()
        for name, value in report["chosen"]["settings"].items():
            self.assertIn(f"{name}:", shipped)
        self.assertLessEqual(report["chosen"]["training"]["worst"],
                             report["start"]["training"]["worst"])

    def test_the_same_seed_finds_the_same_profile(self):
        profiles = set()
        budget, workers = (4, (1, 3)) if SANITIZED else (8, (1, 2, 3))
        for count in workers:
            for old in self.path.iterdir():
                old.unlink()
            self.tuning(SYMMETRIC, "--budget", budget, "--workers", count)
            profiles.add(self.profile.read_text())
        self.assertEqual(len(profiles), 1, profiles)

    def test_it_says_what_keeps_a_scene_failing(self):
        # Bullet's spinning friction needs rolling friction: the ball spins for ever.
        result = run(SCENES / "bullet-facts" / "spin-gate.yaml", *QUICK, "--start", "naive", "--settings", "sor", "--budget",
                     "0", "--observables", "spin_stopping_time", "-o", self.profile)
        self.assertEqual(result.returncode, 1, result.stderr)
        for text in (result.stdout, result.stderr, self.profile.read_text()):
            self.assertIn(".spin_stopping_time fails in all phases", text)
            self.assertNotIn("of phases fail", text)

    def test_bad_options_are_exit_2_with_rule_and_value_and_write_nothing(self):
        out = ["-o", self.profile]
        bare = self.path / "bare.yaml"
        lines = SYMMETRIC.read_text().splitlines()
        bare.write_text("\n".join(line for line in lines if "tolerance:" not in line) + "\n")
        other = self.path / "notes.txt"
        other.write_text("something else\n")
        for arguments, rule in (
                ([SYMMETRIC, *out], "--engine is required"),
                ([SYMMETRIC, *out, "--engine", "bulet"], "got bulet"),
                ([SYMMETRIC, *out, *QUICK, "--start", "nonsense"], "got nonsense"),
                ([SYMMETRIC, *out, *QUICK, "--start", self.path / "none.yaml"], "none.yaml"),
                ([SYMMETRIC, *out, *QUICK, "--settings", "nonsense"], "got nonsense"),
                ([SYMMETRIC, *out, *QUICK, "--within", "-1%"], "must be a share > 0"),
                ([SYMMETRIC, *out, *QUICK, "--within", "5 mm"], "got 5 mm"),
                ([SYMMETRIC, *out, *QUICK, "--observables", "nonsense"], "got nonsense"),
                ([SYMMETRIC, *out, *QUICK, "--phases", "0"], "--phases"),
                ([SYMMETRIC, *out, *QUICK, "--rates", "0"], "--rates"),
                ([SYMMETRIC, *out, *QUICK, "--journal", other], "must be a journal"),
                ([SYMMETRIC, *QUICK, "-o", self.path / "Bad Name.yaml"], "of a-z, 0-9 and -"),
                ([SYMMETRIC, *QUICK, "-o", self.path / "none" / "a.yaml"], "directory must exist"),
                ([bare, *out, *QUICK], "must have a tolerance"),
                ([SYMMETRIC, *out, *QUICK, "--held-out", SYMMETRIC], "must be unique")):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(rule, result.stderr)
                self.assertEqual(result.stdout, "")
        self.assertEqual(sorted(p.name for p in self.path.iterdir()), ["bare.yaml", "notes.txt"])
        self.assertEqual(other.read_text(), "something else\n")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
