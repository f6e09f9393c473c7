#!/usr/bin/env python3
"""Recipes of vcpkg and conda, as far as they can be judged without either: what is in them and that it is the project's.

usage: recipes_test.py SOURCE_DIR
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1]).absolute()
PROJECT = (SOURCE / "CMakeLists.txt").read_text()
VERSION = re.search(r"project\(slipcheck VERSION ([0-9.]+)", PROJECT).group(1)
# What vcpkg's own scripts would do, told instead.
TOLD = """
function(vcpkg_cmake_configure)
  cmake_parse_arguments(arg "" "SOURCE_PATH" "OPTIONS" ${ARGN})
  message(STATUS "configure|${arg_SOURCE_PATH}|${arg_OPTIONS}|${arg_UNPARSED_ARGUMENTS}")
endfunction()
function(vcpkg_cmake_install)
  message(STATUS "install|${ARGN}")
endfunction()
function(vcpkg_cmake_config_fixup)
  message(STATUS "fixup|${ARGN}")
endfunction()
function(vcpkg_install_copyright)
  message(STATUS "copyright|${ARGN}")
endfunction()
"""


def known_options(text):
    """Cache variables that the project has, beside CMake's own."""
    files = [SOURCE / "CMakeLists.txt", *(SOURCE / "cmake").glob("*.cmake"), *(SOURCE / "core").rglob("CMakeLists.txt")]
    content = "\n".join(file.read_text() for file in files)
    known = set(re.findall(r"option\((\w+)", content)) | set(re.findall(r"set\((\w+) [^)]*?CACHE", content))
    return known | {"BUILD_TESTING", "CMAKE_BUILD_TYPE"}, set(re.findall(r"-D(\w+)=", text))


class Vcpkg(unittest.TestCase):
    def test_manifest(self):
        text = (SOURCE / "packaging/vcpkg/vcpkg.json").read_text()
        manifest = json.loads(text)
        self.assertEqual((manifest["name"], manifest["version"], manifest["license"]), ("slipcheck", VERSION, "BSD-3-Clause"))
        names = [each if isinstance(each, str) else each["name"] for each in manifest["dependencies"]]
        self.assertEqual(names, sorted(names))
        for name in names:
            self.assertRegex(name, r"^[a-z0-9]+(-[a-z0-9]+)*$")
        self.assertEqual(text, json.dumps(manifest, indent=2) + "\n")  # as `vcpkg format-manifest` has it

    def test_port(self):
        port = SOURCE / "packaging/vcpkg/portfile.cmake"
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder, "port.cmake")
            script.write_text(f"cmake_minimum_required(VERSION 3.25)\n{TOLD}set(CURRENT_PACKAGES_DIR {folder}/packages)\ninclude({port})\n")
            done = subprocess.run(["cmake", "-P", script], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        told = dict(line[3:].split("|", 1) for line in done.stdout.splitlines())
        source, options, rest = told["configure"].split("|")
        self.assertEqual(Path(source), SOURCE)
        self.assertEqual(rest, "")
        self.assertIn("-DSLIPCHECK_PROGRAM=OFF", options)
        known, used = known_options(options)
        self.assertLessEqual(used, known)
        self.assertIn("lib/cmake/slipcheck", told["fixup"])
        self.assertTrue(Path(told["copyright"].split(";")[-1]).is_file())


class Conda(unittest.TestCase):
    def test_recipe(self):
        try:
            import jinja2
            import yaml
        except ImportError as missing:
            self.skipTest(str(missing))
        text = (SOURCE / "packaging/conda/meta.yaml").read_text()
        recipe = yaml.safe_load(jinja2.Template(text, undefined=jinja2.StrictUndefined).render(compiler=lambda of: f"{of}-compiler"))
        self.assertEqual(recipe["package"], {"name": "slipcheck", "version": VERSION})
        folder = SOURCE / "packaging/conda"
        self.assertEqual((folder / recipe["source"]["path"]).resolve(), SOURCE)
        self.assertTrue((SOURCE / recipe["about"]["license_file"]).is_file())
        self.assertLessEqual(set(recipe), {"package", "source", "build", "requirements", "test", "about"})
        self.assertEqual(set(recipe["requirements"]), {"build", "host"})
        self.assertEqual(recipe["requirements"]["host"], sorted(recipe["requirements"]["host"]))
        known, used = known_options("\n".join(recipe["build"]["script"]))
        self.assertLessEqual(used, known)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
