#!/usr/bin/env python3
"""BULLET_ROOT: the worker of that build's precision is compiled and linked with it, the other one with the system's.

usage: bullet_test.py SOURCE_DIR
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).absolute()


def run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300)


def of_system(module, variable):
    return run("pkg-config", f"--variable={variable}", module).stdout.strip()


class OwnBullet(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)

    def root(self, module):
        """The system's Bullet as `cmake --install` of Bullet leaves one, in its precision."""
        root = self.path / "own"
        (root / "lib/pkgconfig").mkdir(parents=True)
        (root / "include").mkdir()
        (root / "include/bullet").symlink_to(of_system(module, "includedir"))
        for library in Path(of_system(module, "libdir")).glob("lib*.so*"):
            if re.match("lib(Bullet|LinearMath)", library.name):
                (root / "lib" / library.name).symlink_to(library)
        libraries = run("pkg-config", "--libs-only-l", module).stdout.strip()
        double = "-DBT_USE_DOUBLE_PRECISION" if module == "bullet-float64" else ""
        (root / "lib/pkgconfig/bullet.pc").write_text(
            f"Name: bullet\nDescription: own\nVersion: 3.99\nRequires:\nLibs: -L{root}/lib {libraries}\n"
            f"Cflags: {double} -I{root}/include/bullet -I{root}/include\n")
        return root

    def configure(self, root):
        return run("cmake", "-S", SOURCE, "-B", self.path / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
                   "-DSLIPCHECK_PAGE_SCRIPT=OFF", "-DSLIPCHECK_PYTHON_MODULE=OFF", f"-DBULLET_ROOT={root}")

    def commands(self, precision):
        return run("ninja", "-C", self.path / "build", "-t", "commands", f"slipcheck-engine-bullet-{precision}").stdout.splitlines()

    def check(self, module, own, others):
        root = self.root(module)
        done = self.configure(root)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"-- Bullet of BULLET_ROOT: 3.99, {own.upper()} precision", done.stdout)
        link = self.commands(own)[-1]
        self.assertIn(f"{root}/lib/libBulletDynamics", link)
        self.assertIn(f"-Wl,-rpath,{root}/lib", link)
        compiled = [line for line in self.commands(own) if f"slipcheck_bullet_{own}.dir" in line and " -c " in line]
        self.assertTrue(compiled)
        for line in compiled:
            self.assertIn(f"{root}/include/bullet", line)
            self.assertEqual("-DBT_USE_DOUBLE_PRECISION" in line, own == "double")
        self.assertNotIn(str(root), "\n".join(self.commands(others)))
        install = (self.path / "build/bullet_backend/cmake_install.cmake").read_text()
        self.assertIn(f'RPATH "{root}/lib"', install)

    def test_in_double_precision(self):
        self.check("bullet-float64", "double", "single")

    def test_in_single_precision(self):
        self.check("bullet", "single", "double")

    def test_a_place_without_bullet_is_refused(self):
        done = self.configure(self.path)
        self.assertNotEqual(done.returncode, 0)
        text = " ".join(done.stderr.split())
        self.assertIn(f"BULLET_ROOT: must be where Bullet is installed, with lib/pkgconfig/bullet.pc, got {self.path}", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
