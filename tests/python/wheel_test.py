#!/usr/bin/env python3
"""Builds sdist and wheel by their standard backend, against the installed libraries, and uses the wheel in an environment of its own.

usage: wheel_test.py BUILD_DIR SOURCE_DIR [pure]

pure: the build has no position-independent libraries (SLIPCHECK_PYTHON_MODULE), so that no module can be built against them.
"""
import os
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from pathlib import Path

BUILD, SOURCE = Path(sys.argv[1]).absolute(), Path(sys.argv[2]).absolute()
PYTHON = "/usr/bin/python3"
USE = """
import slipcheck, slipcheck.physics
print(slipcheck.__file__)
scene = slipcheck.Scene("{scene}")
print(scene.solve()["i-j.effective_restitution"])
print(slipcheck.physics.effective_restitution(0.9))
"""


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=800, **options)
    assert done.returncode == 0, (words, done.stdout + done.stderr)
    return done.stdout


class Wheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        self.environment = {"PATH": "/usr/bin:/bin", "HOME": folder.name, "LANG": "C.UTF-8",
                            **{key: value for key, value in os.environ.items() if key.startswith(("CCACHE_", "CMAKE_CXX_COMP"))}}

    def pip(self, python, *words, **more):
        # No index is asked: what it needs is Debian's.
        return run(python, "-m", "pip", "--disable-pip-version-check", *words, "--no-index", "--no-build-isolation",
                   "--no-deps", env={**self.environment, **more}, cwd=self.path)

    def sdist(self):
        """The backend's sdist, of a copy: it writes beside what it packs."""
        tree = self.path / "tree"
        run("cp", "-r", SOURCE / "python", tree)
        run(PYTHON, "-c", "import setuptools.build_meta as b; b.build_sdist('..')", cwd=tree,
            env={**self.environment, "SLIPCHECK_PURE": "1"})
        return next(self.path.glob("slipcheck-*.tar.gz"))

    @unittest.skipIf("pure" in sys.argv[3:], "SLIPCHECK_PYTHON_MODULE is OFF")
    def test_compiled_wheel_of_the_sdist_in_a_fresh_environment(self):
        sdist = self.sdist()
        with tarfile.open(sdist) as archive:
            names = {name.partition("/")[2] for name in archive.getnames()}
        self.assertLessEqual({"CMakeLists.txt", "src/module.cpp", "slipcheck/py.typed", "slipcheck/_reference.pyi"}, names)
        prefix = self.path / "prefix"
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "dev")
        self.pip(PYTHON, "wheel", sdist, "-w", self.path, CMAKE_PREFIX_PATH=str(prefix))
        wheel = next(self.path.glob("slipcheck-*-linux_*.whl"))
        with zipfile.ZipFile(wheel) as archive:
            self.assertTrue(any(name.startswith("slipcheck/_reference.") and name.endswith(".so") for name in archive.namelist()))
        # The libraries are in it: they need not be there any more.
        run("rm", "-r", prefix)
        run(PYTHON, "-m", "venv", "--system-site-packages", self.path / "venv")
        python = self.path / "venv/bin/python"
        self.pip(python, "install", wheel)
        place, e_eff, closed = run(python, "-c", USE.format(scene=SOURCE / "scenarios/symmetric-30cms.yaml"), cwd="/",
                                   env=self.environment).split()
        self.assertTrue(place.startswith(str(self.path / "venv")), place)
        self.assertAlmostEqual(float(e_eff), (2.5 * 0.9 - 1) / 3.5, 14)
        self.assertAlmostEqual(float(e_eff), float(closed), 14)

    def test_pure_wheel_says_what_it_has_not(self):
        self.pip(PYTHON, "wheel", self.sdist(), "-w", self.path, SLIPCHECK_PURE="1")
        wheel = next(self.path.glob("slipcheck-*-none-any.whl"))
        code = "import slipcheck\ntry:\n  slipcheck.Scene\nexcept ImportError as error:\n  print(error)"
        said = run(PYTHON, "-c", code, env={**self.environment, "PYTHONPATH": str(wheel)}, cwd="/")
        self.assertIn("slipcheck.reference needs the package's compiled module", said)

    def test_versions_agree(self):
        import re
        texts = {name: re.search(pattern, (SOURCE / name).read_text()).group(1) for name, pattern in {
            "CMakeLists.txt": r"project\(slipcheck VERSION ([0-9.]+)", "python/pyproject.toml": r'(?m)^version = "([0-9.]+)"',
            "python/slipcheck/__init__.py": r'__version__ = "([0-9.]+)"'}.items()}
        self.assertEqual(len(set(texts.values())), 1, texts)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
