#!/usr/bin/env python3
"""Installs the build into a folder and uses it from there.

usage: install_test.py BUILD_DIR SOURCE_DIR
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

BUILD, SOURCE = Path(sys.argv[1]).absolute(), Path(sys.argv[2]).absolute()
# Nothing of the caller's: no engine of npm, no path to engines.
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "LANG": "C.UTF-8"}


def run(*words, **options):
    options = {"cwd": "/", "env": ENVIRONMENT, **options}
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=600, **options)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        first = Path(cls.folder.name, "first")
        done = run("cmake", "--install", BUILD, "--prefix", first)
        assert done.returncode == 0, done.stderr
        # Wherever it is moved, it finds its files.
        cls.prefix = Path(cls.folder.name, "second place")
        first.rename(cls.prefix)
        cls.program = cls.prefix / "bin/slipcheck"

    def test_runs_a_bundled_scene_in_bullet_from_where_it_is(self):
        listed = json.loads(run(self.program, "list", "scenarios", "--json").stdout)
        files = {each["name"]: Path("/", each["file"]).resolve() for each in listed}
        scene = files["symmetric-30cms"]
        self.assertEqual(scene, self.prefix / "share/slipcheck/scenarios/symmetric-30cms.yaml")
        done = run(self.program, "run", scene, "--phases", "8", "--json", "-")
        self.assertEqual(done.returncode, 1, done.stderr)  # Bullet deviates
        result = json.loads(done.stdout)
        # K: e_eff = (A e_n - 1)/(1 + A) with A = 5/2.
        value = result["reference"]["observables"]["i-j.effective_restitution"]["value"]
        self.assertAlmostEqual(value, (2.5 * 0.9 - 1) / 3.5, 14)
        self.assertEqual({run["status"] for run in result["runs"]}, {"ok"})
        self.assertTrue((scene.parent / "schema.json").is_file())

    def test_engines_profiles_and_those_of_npm_are_there(self):
        engines = json.loads(run(self.program, "engines", "list", "--json").stdout)
        bullet = [each for each in engines if each["engine"] == "bullet"]
        self.assertEqual({each["precision"] for each in bullet}, {"single", "double"})
        for each in bullet:
            self.assertIn("tuned", each["profiles"])
        self.assertIn("rapier", {each["engine"] for each in engines})

    def test_holds_scenes_against_the_baselines_it_brings(self):
        done = run(self.program, "check", self.prefix / "share/slipcheck/scenarios/roll-to-rest.yaml")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_nothing_names_the_source_tree(self):
        for file in (self.prefix / "share").rglob("*"):
            if file.is_file() and not file.is_symlink():
                self.assertNotIn(str(SOURCE).encode(), file.read_bytes(), file)
        for file in (self.prefix / "lib/cmake").rglob("*.cmake") if (self.prefix / "lib/cmake").is_dir() else ():
            self.assertNotIn(str(SOURCE), file.read_text(), file)

    def test_a_project_of_its_own_builds_against_it(self):
        build = Path(self.folder.name, "example")
        source = self.prefix / "share/doc/slipcheck/docs/example-library"
        done = run("cmake", "-S", source, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn(str(SOURCE), (build / "CMakeCache.txt").read_text())
        done = run("cmake", "--build", build)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        scene = self.prefix / "share/slipcheck/scenarios/symmetric-30cms.yaml"
        done = run(build / "effective_restitution", scene)
        self.assertEqual(done.returncode, 0, done.stderr)
        name, _, numbers = done.stdout.partition(" = ")
        self.assertEqual(name, "i-j.effective_restitution")
        self.assertAlmostEqual(float(numbers.split()[0]), (2.5 * 0.9 - 1) / 3.5, 14)
        self.assertEqual(run(build / "effective_restitution", "/nonexistent.yaml").returncode, 2)

    @unittest.skipUnless(shutil.which("man"), "there is no man to read manual pages")
    def test_manual_pages_are_read_without_a_warning(self):
        pages = sorted((self.prefix / "share/man/man1").glob("*.1"))
        names = {page.stem for page in pages}
        self.assertLessEqual({"slipcheck", "slipcheck-run", "slipcheck-check", "slipcheck-engines"}, names)
        for page in pages:
            done = run("man", "--warnings", "-E", "UTF-8", "-l", page, env={**ENVIRONMENT, "MANWIDTH": "100"})
            self.assertEqual((done.returncode, done.stderr), (0, ""), page)
        done = run("man", "-E", "UTF-8", "-l", self.prefix / "share/man/man1/slipcheck-run.1", env={**ENVIRONMENT, "MANWIDTH": "100"})
        for part in ("NAME", "SYNOPSIS", "--phases UINT", "Else 32.", "EXAMPLES", "slipcheck run scene.yaml --set erp2=0.4"):
            self.assertIn(part, done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
