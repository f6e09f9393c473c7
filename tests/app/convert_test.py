#!/usr/bin/env python3
"""slipcheck convert: units, both outputs, and what is refused. The formulas are in tests/convert.

usage: convert_test.py SLIPCHECK
"""
import json
import math
import subprocess
import sys
import unittest

SLIPCHECK = sys.argv[1]


def convert(*arguments):
    return subprocess.run([SLIPCHECK, "convert", *arguments], capture_output=True, text=True,
                          timeout=60)


def values(*arguments):
    result = convert(*arguments, "--json", "-")
    assert result.returncode == 0, result.stderr
    return {(row["of"], row["name"]): row["value"] for row in json.loads(result.stdout)["rows"]}


class Convert(unittest.TestCase):
    def test_a_contact_in_all_its_forms(self):
        # k = 3700 N/m and c = 7.4 N s/m on 370 g: omega0 = 100 1/s, gamma = 20 1/s.
        forms = [["--stiffness", "3.7 kN/m", "--damping", "7.4 N s/m"],
                 ["--solref=-1e4,-20"], ["--solref", "0.1,0.1"]]
        tables = [values("contact", *form, "--mass", "370 g") for form in forms]
        omega = math.sqrt(1e4 - 100)
        e = math.exp(-20 * math.atan(omega / 10) / omega)
        expected = {("contact", "e"): e, ("spring", "k"): 3700,
                    ("spring", "c"): 7.4, ("mujoco", "solref timeconst"): 0.1,
                    ("mujoco", "solref dampratio"): 0.1,
                    ("mujoco", "solref -stiffness"): -1e4, ("ode", "soft_erp"): 1 / 3,
                    ("ode", "soft_cfm"): 1 / 11.1}
        again = values("contact", "--restitution", repr(e), "--stiffness", "3700 N/m", "--mass",
                       "0.37")
        for table in (*tables, again):
            for key, value in expected.items():
                self.assertAlmostEqual(table[key] / value, 1, delta=1e-9, msg=key)

    def test_what_mujoco_raises_is_told(self):
        raised = convert("contact", "--solref", "0.001,0.5", "--time-step", "1 ms").stdout
        left = convert("contact", "--solref", "0.002,0.5", "--time-step", "1 ms").stdout
        self.assertIn("RAISED to two steps", raised)
        self.assertNotIn("RAISED", left)
        self.assertIn("MuJoCo documentation", left)

    def test_two_spheres_have_a_reduced_mass(self):
        table = values("contact", "--restitution", "0.8", "--collision-time", "1 ms", "--mass",
                       "3 g", "--other-mass", "6 g")
        self.assertAlmostEqual(table["contact", "m"], 0.002, delta=1e-12)
        self.assertAlmostEqual(table["contact", "t_col"], 1e-3, delta=1e-12)
        self.assertAlmostEqual(table["contact", "e"], 0.8, delta=1e-12)

    def test_rolling_friction(self):
        table = values("rolling", "--radius", "1 cm", "--coefficient", "2 %")
        self.assertAlmostEqual(table["bullet", "setRollingFriction"], 2.8e-4, delta=1e-15)
        back = values("rolling", "--radius", "0.01", "--length", "0.28 mm")
        self.assertAlmostEqual(back["scene", "rolling"], 0.02, delta=1e-14)

    def test_pairs(self):
        table = values("pair", "--first", "0.2", "--second", "0.8")
        expected = {"bullet": 0.16, "dart": 0.2, "jolt": 0.4, "mujoco": 0.8, "physx": 0.5,
                    "rapier": 0.5, "simbody": 0.32}
        self.assertEqual({of for of, _ in table}, set(expected))
        for engine, value in expected.items():
            self.assertAlmostEqual(table[engine, "of the pair"], value, delta=1e-12)
        both = values("pair", "--quantity", "restitution", "--pair", "0.64")
        self.assertAlmostEqual(both["bullet", "of both bodies"], 0.8, delta=1e-12)
        self.assertIsNone(both["mujoco", "of a body"])
        other = values("pair", "--pair", "0.5", "--first", "0.3")
        self.assertIsNone(other["dart", "of the other"])
        self.assertAlmostEqual(other["rapier", "of the other"], 0.7, delta=1e-12)

    def test_bad_input_is_refused(self):
        for arguments, words in [
                (["contact"], "must be given"),
                (["contact", "--restitution", "0.8"], "must be given"),
                (["contact", "--restitution", "1.2", "--stiffness", "1e5"], "--restitution: must be"),
                (["contact", "--solref", "0.1,-1"], "--solref: must be"),
                (["contact", "--solref", "0.1"], "--solref: must be two numbers"),
                (["contact", "--stiffness", "5 kg", "--damping", "1"], "--stiffness"),
                (["rolling", "--radius", "-1 mm", "--coefficient", "0.1"], "--radius: must be > 0 m"),
                (["rolling", "--radius", "1 mm"], "one of"),
                (["pair", "--second", "0.3"], "must be given"),
                ([], "")]:
            result = convert(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(words, result.stderr + result.stdout)
            self.assertNotIn("nan", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
