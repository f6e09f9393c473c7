#!/usr/bin/env python3
"""What shells complete after `slipcheck`, asked of the shells themselves.

usage: shell_test.py SLIPCHECK
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SLIPCHECK = os.path.abspath(sys.argv[1])


def run(*words, **options):
    return subprocess.run(words, capture_output=True, text=True, timeout=60, **options)


def script(shell):
    done = run(SLIPCHECK, "completion", shell)
    assert done.returncode == 0, done.stderr
    return done.stdout


def commands():
    """All commands by the program's own help."""
    lines = run(SLIPCHECK, "--help").stdout.partition("\nSubcommands:\n")[2].split("\n\n")[0].splitlines()
    return {line.split()[0] for line in lines if line.startswith("  ") and not line.startswith("   ")}


class Bash(unittest.TestCase):
    def complete(self, *words):
        quoted = " ".join(f"'{word}'" for word in words)
        done = run("bash", "--norc", "-c", f"{script('bash')}\nCOMP_WORDS=({quoted}) COMP_CWORD={len(words) - 1}\n_slipcheck\n"
                   'printf "%s\\n" "${COMPREPLY[@]}"')
        self.assertEqual(done.stderr, "")
        return set(done.stdout.split())

    def test_commands_options_and_values(self):
        self.assertLessEqual(commands(), self.complete("slipcheck", ""))
        self.assertGreater(len(commands()), 15)
        self.assertEqual(self.complete("slipcheck", "vers"), {"versions"})
        self.assertEqual(self.complete("slipcheck", "run", "--pha"), {"--phases", "--phases-csv"})
        self.assertEqual(self.complete("slipcheck", "run", "x.yaml", "--precision", ""), {"single", "double"})
        self.assertEqual(self.complete("slipcheck", "engines", ""), {"add", "remove", "list", "-h", "--help"})
        self.assertEqual(self.complete("slipcheck", "engines", "list", "--j"), {"--json"})
        self.assertIn("scenarios", self.complete("slipcheck", "list", ""))
        # Of these files are the shell's own answer.
        self.assertEqual(self.complete("slipcheck", "run", "--json", ""), set())


@unittest.skipUnless(shutil.which("fish"), "there is no fish")
class Fish(unittest.TestCase):
    def complete(self, line):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "slipcheck.fish")
            file.write_text(script("fish"))
            done = run("fish", "--no-config", "-c", f"source {file}; complete -C '{line}'",
                       env={**os.environ, "HOME": folder}, cwd=folder)
        self.assertEqual(done.stderr, "")
        return {each.split("\t")[0] for each in done.stdout.splitlines()}

    def test_commands_options_and_values(self):
        self.assertLessEqual(commands(), self.complete("slipcheck "))
        self.assertEqual(self.complete("slipcheck run --pha"), {"--phases", "--phases-csv"})
        self.assertEqual(self.complete("slipcheck run --precision "), {"single", "double"})
        self.assertEqual(self.complete("slipcheck engines "), {"add", "remove", "list"})


@unittest.skipUnless(shutil.which("zsh"), "there is no zsh")
class Zsh(unittest.TestCase):
    def test_loads_and_has_a_function_for_each_command(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "_slipcheck").write_text(script("zsh"))
            done = run("zsh", "-f", "-c", f"fpath=({folder} $fpath); autoload -U compinit; compinit -u -D; "
                       "print ${_comps[slipcheck]}; autoload +X _slipcheck; whence -w _slipcheck; "
                       f"zsh -n {folder}/_slipcheck", env={**os.environ, "HOME": folder})
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout.split("\n")[:2], ["_slipcheck", "_slipcheck: function"])
        text = script("zsh")
        for command in commands():
            self.assertIn(f"_slipcheck_{command}() {{", text)


class Manual(unittest.TestCase):
    def test_prints_writes_and_refuses(self):
        page = run(SLIPCHECK, "manual", "run").stdout
        self.assertTrue(page.startswith('.TH "SLIPCHECK\\-RUN" 1'))
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run(SLIPCHECK, "manual", "--out", folder + "/man").returncode, 0)
            self.assertEqual(Path(folder, "man/slipcheck-run.1").read_text(), page)
            self.assertEqual({file.stem for file in Path(folder, "man").iterdir()},
                             {"slipcheck"} | {f"slipcheck-{name}" for name in commands()})
        done = run(SLIPCHECK, "manual", "fly")
        self.assertEqual((done.returncode, done.stderr), (2, "slipcheck: COMMAND: must be a command of slipcheck, got fly\n"))
        self.assertEqual(run(SLIPCHECK, "completion", "tcsh").returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
