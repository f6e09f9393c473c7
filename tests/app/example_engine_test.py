#!/usr/bin/env python3
"""The example engine converges to the reference to first order in the step.

usage: example_engine_test.py SLIPCHECK SOURCE_DIR
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SLIPCHECK, SOURCE = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).absolute()
FOLDER = SOURCE / "docs/example-engine"
COARSE, FINE = 500, 4000
# What the end of a step decides, or two errors of opposite sign, need not fall evenly.
LEAST_GAIN = 4  # of 8
ROUND_OFF = 1e-9


def with_example(scene, rates, profile="default"):
    """A bundled scene's text with the example engine in place of Bullet."""
    text = (SOURCE / "scenarios" / f"{scene}.yaml").read_text()
    text = re.sub(r"    - \{engine: bullet.*\n", "", text)
    engine = f"    - {{engine: example, profile: {profile}, rate: {rates}}}\n"
    return re.sub(r"  engines:.*\n", "  engines:\n" + engine, text)


def run(text, *options):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.yaml"
        file.write_text(text)
        result = subprocess.run([SLIPCHECK, "run", str(file), "--json", "-", *options],
                                capture_output=True, text=True, timeout=600,
                                env=dict(os.environ, SLIPCHECK_ENGINE_PATH=str(FOLDER)))
    assert result.returncode in (0, 1), result.stderr
    return json.loads(result.stdout)


class ExampleEngine(unittest.TestCase):
    def expect_first_order(self, scene, observables, largest):
        """`largest`: error at the fine rate, relative or of a restitution absolute."""
        result = run(with_example(scene, [COARSE, FINE]), "--phases", "8")
        coarse, fine = result["runs"]
        for run_ in (coarse, fine):
            self.assertEqual(run_["status"], "ok")
            self.assertEqual(run_["not_represented"], [])
        for name in observables:
            with self.subTest(f"{scene} {name}"):
                before, after = (abs(r["errors"][name]["max"]) for r in (coarse, fine))
                self.assertLess(after, largest)
                if before > ROUND_OFF:
                    self.assertGreater(before / after, LEAST_GAIN)

    # Semi-implicit Euler is off by a dt²/2 each step, v dt/2 over a slide that ends at v = 0: 31.2 mm at
    # 0.5 m/s, dt = 0.25 ms, 0.06 %. Velocities of a slide with constant friction have no error.
    def test_slide_to_roll(self):
        self.expect_first_order("slide-to-roll",
                                ["ball.sliding_time", "ball.sliding_distance",
                                 "ball.rolling_velocity"], 1e-3)

    def test_roll_to_rest(self):
        self.expect_first_order("roll-to-rest",
                                ["ball.stopping_time", "ball.stopping_distance"], 1e-3)

    # The step of the collision has the friction of rolling or of sliding: (1 + A) μ g dt in the slip,
    # 1.2 mm/s of 30 cm/s.
    def test_two_that_meet(self):
        self.expect_first_order("symmetric-30cms",
                                ["i-j.effective_restitution", "i.sliding_time",
                                 "i.sliding_distance", "i.rolling_velocity"], 3e-2)

    # The rebound has the velocity at the start of its step, up to g dt = 2.5 mm/s of 79 cm/s.
    def test_bounce(self):
        self.expect_first_order("bouncing-ball",
                                ["ball-substrate.restitution", "ball.lift_off_speed",
                                 "ball.jump_height"], 1e-2)

    def test_slopes_belts_and_spins(self):
        for scene, observables in {
                "slope-rolls": ["ball.final_position", "ball.final_velocity"],
                "slope-holds": ["ball.stopping_time", "ball.stopping_distance"],
                "belt-starts": ["ball.final_position"],
                "spin-to-rest": ["ball.spin_stopping_time"]}.items():
            self.expect_first_order(scene, observables, 1e-2)

    # Four inner steps at a quarter of the rate are the same steps.
    def test_inner_steps_are_steps(self):
        text = with_example("symmetric-30cms", 1000)
        one = run(text, "--phases", "1")["runs"][0]
        text = with_example("symmetric-30cms", 250, "fine")
        four = run(text, "--phases", "1")["runs"][0]
        error = lambda r: r["errors"]["i-j.effective_restitution"]["max"]
        self.assertAlmostEqual(error(one), error(four), delta=1e-3)

    def test_the_tutorials_commands_work_as_they_stand(self):
        text = (SOURCE / "docs/your-own-engine.md").read_text()
        script = "\n".join(re.findall(r"```sh\n(.*?)```", text, re.S))
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "build").mkdir()
            (Path(folder) / "build/release").symlink_to(Path(SLIPCHECK).parent)
            for name in ("docs", "scenarios"):
                (Path(folder) / name).symlink_to(SOURCE / name)
            result = subprocess.run(["bash", "-c", script], cwd=folder, capture_output=True,
                                    text=True, timeout=600)
        # A slow machine says after half a minute how far it has come.
        told = [line for line in result.stderr.splitlines()
                if line and "debug build" not in line.lower()
                and not re.match(r"\w+ \d+/\d+ +\d", line)]
        self.assertEqual(told, [])
        self.assertRegex(result.stdout, r"mine +double +1\.0 +default")
        for words in ("48 passed, 0 failed, 3 not judged", "✗  FAILED",
                      "mine 1.0 double, profile default, 1000 Hz", "order 0.9"):
            self.assertIn(words, result.stdout)

    def test_refusals_and_what_is_not_represented_are_told(self):
        box = run(with_example("box-one-ball", 1000))["runs"][0]
        self.assertEqual((box["status"], box["reason"]), ("skipped", "example: it has a plane, no box"))
        text = with_example("symmetric-30cms", 1000)
        lacks = run(text, "--phases", "1", "--set", "static_friction=false")["runs"][0]
        self.assertEqual(lacks["not_represented"],
                         ["static friction (one coefficient for sticking and sliding)"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
