#!/usr/bin/env python3
"""The release script, in a repository of its own: everything that names the version, and what it refuses.

usage: release_test.py SOURCE_DIR
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
FILES = ["CHANGELOG.md", "CMakeLists.txt", "docs/python.md", "packaging/conda/meta.yaml", "packaging/release",
         "packaging/vcpkg/vcpkg.json", "python/pyproject.toml", "python/slipcheck/__init__.py"]


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        for file in FILES:
            (self.path / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / file, self.path / file)
        self.write("CHANGELOG.md", "# Changes\n\n## Unreleased\n\n- A pair of balls.\n\n## 0.0.1, 2020-01-01\n\n- None.\n")
        self.git("init", "--quiet")
        self.git("config", "user.name", "Nobody")
        self.git("config", "user.email", "nobody@localhost")
        self.commit("all")

    def git(self, *words):
        return subprocess.run(["git", *words], cwd=self.path, check=True, capture_output=True, text=True).stdout

    def commit(self, message):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", message)

    def write(self, file, text):
        (self.path / file).write_text(text, encoding="utf-8")

    def read(self, file):
        return (self.path / file).read_text(encoding="utf-8")

    def release(self, *words):
        return subprocess.run([self.path / "packaging/release", *words], capture_output=True, text=True)

    def test_every_file_names_the_new_version(self):
        made = self.release("12.34.56", "--no-build")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("project(slipcheck VERSION 12.34.56 ", self.read("CMakeLists.txt"))
        self.assertIn('\nversion = "12.34.56"\n', self.read("python/pyproject.toml"))
        self.assertIn('\n__version__ = "12.34.56"\n', self.read("python/slipcheck/__init__.py"))
        self.assertIn('"version": "12.34.56"', self.read("packaging/vcpkg/vcpkg.json"))
        self.assertIn('{% set version = "12.34.56" %}', self.read("packaging/conda/meta.yaml"))
        self.assertIn("slipcheck-12.34.56-*.whl", self.read("docs/python.md"))
        self.assertRegex(self.read("CHANGELOG.md"), r"^# Changes\n\n## Unreleased\n\n## 12\.34\.56, \d{4}-\d\d-\d\d\n\n"
                                                    r"- A pair of balls\.\n\n## 0\.0\.1, ")
        self.assertEqual(self.git("status", "--porcelain"), "")
        self.assertEqual(self.git("describe").strip(), "v12.34.56")
        self.assertEqual(self.git("log", "-1", "--format=%s").strip(), "Release 12.34.56")
        # Nothing is new since.
        self.refused("12.34.57", "must say what is new")

    def refused(self, version, rule):
        before = self.git("rev-parse", "HEAD"), self.git("tag"), self.git("status", "--porcelain")
        made = self.release(version, "--no-build")
        self.assertEqual(made.returncode, 2, made.stdout)
        self.assertIn(rule, made.stderr)
        self.assertEqual((self.git("rev-parse", "HEAD"), self.git("tag"), self.git("status", "--porcelain")), before)

    def test_refuses_what_is_no_later_version(self):
        for version, rule in (("1.2", "must be three numbers"), ("1.2.03", "must be three numbers"),
                              ("0.0.1", "must be later than ")):
            with self.subTest(version):
                self.refused(version, rule)

    def test_refuses_a_tree_with_changes(self):
        self.write("README.md", "new")
        self.refused("9.0.0", "the tree must be clean")

    def test_refuses_a_tag_that_is_there(self):
        self.git("tag", "v9.0.0")
        self.refused("9.0.0", "the tag v9.0.0 must not be there yet")

    def test_refuses_files_of_two_versions(self):
        self.write("packaging/vcpkg/vcpkg.json", self.read("packaging/vcpkg/vcpkg.json").replace('"version": "', '"version": "7.'))
        self.commit("two versions")
        self.refused("9.0.0", "the files must name one version")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
