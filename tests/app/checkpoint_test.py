#!/usr/bin/env python3
"""A run that is killed at any moment goes on from its checkpoint, and ends with the same bytes.

usage: checkpoint_test.py SLIPCHECK SOURCE_DIR [sanitized]

SLIPCHECK_KILLS: moments of each scene at which it is killed, 3 if not given, 2 under sanitizers.
"""
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SLIPCHECK = sys.argv[1]
SANITIZED = "sanitized" in sys.argv[3:]
KILLS = int(os.environ.get("SLIPCHECK_KILLS", "2" if SANITIZED else "3"))

SCENE = """slipcheck: 1
name: {name}
title: Balls that collide for some seconds
gravity: 9.81
materials: {{m: {{density: 1000}}}}
contacts:
  - {{between: [m, m], normal: {{model: linear, restitution: 0.8, collision_time: 1e-3}},
     tangential: {tangential}}}
  - {{between: [m, substrate], friction: 0.1}}
substrate: {{periodic: [1, 1]{confined}}}
fill: {{prefix: g, count: {count}, material: m, radius: {radius}, area: [0, 0, 1, 1], speed: 1, seed: 3}}
run: {{until: {until}}}
compare: {{reference: {solver}, engines: [], tolerance: {{final_position: 1 %}}}}
"""
HARD = """slipcheck: 1
name: grains
title: A ball that slides
gravity: 9.81
materials: {m: {density: 1000}}
contacts:
  - {between: [m, substrate], friction: 0.1}
substrate: {}
bodies:
  - {name: i, material: m, sphere: {radius: 0.02}, position: [0, 0], velocity: [1, 0]}
run: {until: 0.1}
compare: {engines: []}
"""
VISCOUS = "{model: viscous, damping_ratio: 0.5, friction: 0.3}"
SPRING = "{model: spring, stiffness_ratio: 0.286, friction: 0.3}"
SHARE = 0.16 if SANITIZED else 0.8
SCENES = {
    # In islands; by neighbours of unlike radii; in contacts that remember.
    "grains": SCENE.format(name="grains", tangential=VISCOUS, confined=", confined: true", count=60,
                           radius=0.02, until=0.15 * SHARE, solver="steps"),
    "unlike": SCENE.format(name="unlike", tangential=VISCOUS, confined="", count=60,
                           radius="{uniform: [0.01, 0.02]}", until=0.1 * SHARE, solver="steps"),
    "pile": SCENE.format(name="pile", tangential=SPRING, confined="", count=60, radius=0.02,
                         until=0.1 * SHARE, solver="contact"),
}


def comparable(text):
    """What a run says, but for when it was and how long it took."""
    text = re.sub(r'"cpu_seconds": [^,\n]*', '"cpu_seconds": 0', text)
    return re.sub(r'"date": "[^"]*"', '"date": ""', text)


class Checkpoints(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.path = Path(self.directory.name)
        for name, text in SCENES.items():
            (self.path / f"{name}.yaml").write_text(text)

    def tearDown(self):
        self.directory.cleanup()

    def command(self, name, *more, limit=600):
        return [SLIPCHECK, "run", f"{name}.yaml", "--json", "out.json", "--quiet", "--time-limit",
                str(limit), *more]

    def run_to_end(self, name, *more, limit=600):
        done = subprocess.run(self.command(name, *more, limit=limit), cwd=self.path,
                              capture_output=True, text=True)
        return done.returncode, done.stderr

    def refusal(self, name, *more):
        (self.path / "out.json").unlink(missing_ok=True)
        code, said = self.run_to_end(name, *more)
        self.assertEqual(code, 2, said)
        self.assertFalse((self.path / "out.json").exists())
        return said

    def kill_once(self, name, after):
        """Starts it, kills it; whether it was still at work."""
        process = subprocess.Popen(
            self.command(name, "--checkpoint", "kept", "--checkpoint-every", "0.01", "--resume"),
            cwd=self.path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            # A busy machine may start nothing for long: something is to be there to go on from.
            begin = time.monotonic()
            while (process.poll() is None and time.monotonic() - begin < 60
                   and not (self.path / "kept" / f"{name}.checkpoint").exists()):
                time.sleep(0.001)
            process.wait(after)
            return False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            return True

    def test_kills_change_no_byte(self):
        random.seed(2026)
        for name in SCENES:
            with self.subTest(scene=name):
                begin = time.monotonic()
                self.assertEqual(self.run_to_end(name)[0], 0)
                took = time.monotonic() - begin
                whole = (self.path / "out.json").read_text()
                (self.path / "out.json").unlink()
                self.assertGreater(json.loads(whole)["reference"]["collisions"], 0)
                kills, went_on = 0, 0
                while kills < KILLS:
                    went_on += (self.path / "kept" / f"{name}.checkpoint").exists()
                    # The whole way through on the average, in case a piece takes all of it.
                    if not self.kill_once(name, random.uniform(0.01, 2 * took / KILLS)):
                        (self.path / "out.json").unlink()
                        continue
                    kills += 1
                self.assertGreater(went_on, 0)
                code, said = self.run_to_end(name, "--checkpoint", "kept", "--resume")
                self.assertEqual(code, 0, said)
                self.assertEqual(comparable((self.path / "out.json").read_text()),
                                 comparable(whole))
                self.assertFalse((self.path / "kept" / f"{name}.checkpoint").exists())
                self.assertEqual(list((self.path / "kept").glob("*.checkpoint")), [])

    def keep_something(self, name):
        kept = self.path / "kept" / f"{name}.checkpoint"
        # Out of time is an end that keeps what there is.
        code, said = self.run_to_end(name, "--checkpoint", "kept", "--checkpoint-every", "0",
                                     limit=3)
        self.assertTrue(kept.exists(), said)
        self.assertIn("--resume goes on from there", said)
        self.assertNotEqual(code, 0)
        return kept

    def test_refuses_what_is_not_its_own(self):
        for name, text in SCENES.items():
            (self.path / f"{name}.yaml").write_text(re.sub(r"until: [\d.]+", "until: 50", text))
        kept = self.keep_something("pile")
        whole = kept.read_bytes()
        resume = ("--checkpoint", "kept", "--resume")
        self.assertIn("must not be there yet; --resume goes on from it",
                      self.refusal("pile", "--checkpoint", "kept"))
        self.assertIn("--resume: needs --checkpoint", self.refusal("pile", "--resume"))
        self.assertIn("of another --general", self.refusal("pile", *resume, "--general"))
        for damage, told in {
                whole[:-1]: "is damaged: must hold",
                whole[:-1] + bytes([whole[-1] ^ 1]): "is damaged: its bytes are not those",
                b"": "must be a checkpoint, whose first line begins with slipcheck-checkpoint/1",
                whole[5:]: "must be a checkpoint",
                whole.replace(b"+", b"+other-", 1): "only the same build can go on with it",
        }.items():
            kept.write_bytes(damage)
            self.assertIn(told, self.refusal("pile", *resume))
        kept.write_bytes(whole)
        (self.path / "pile.yaml").write_text(
            (self.path / "pile.yaml").read_text().replace("speed: 1,", "speed: 1.1,"))
        self.assertIn("is of another scene than pile is now", self.refusal("pile", *resume))

    def test_samples_and_trajectory_go_on(self):
        options = ("--samples", "20", "--trajectory", "xyz")
        self.assertEqual(self.run_to_end("grains", "--assembly", "whole", *options)[0], 0)
        many = ("--assembly", "pieces", *options, "--checkpoint", "kept", "--checkpoint-every",
                "0.01", "--resume")
        kept = self.path / "kept" / "grains.checkpoint"
        for after in (0.05, 0.2):
            process = subprocess.Popen(self.command("grains", *many), cwd=self.path)
            begin = time.monotonic()
            while process.poll() is None and not kept.exists() and time.monotonic() - begin < 60:
                time.sleep(0.001)
            time.sleep(after)
            process.kill()
            process.wait()
        self.assertEqual(self.run_to_end("grains", *many)[0], 0)
        for name in ("grains.series.csv", "grains.distributions.csv", "grains.xyz"):
            self.assertEqual((self.path / "pieces" / name).read_bytes(),
                             (self.path / "whole" / name).read_bytes(), name)
        rows = (self.path / "whole" / "grains.series.csv").read_text().splitlines()
        self.assertEqual(rows[0], "scene,quantity,unit,time,value")
        self.assertEqual(sum(",kinetic_energy,J," in row for row in rows), 20)
        frames = (self.path / "whole" / "grains.xyz").read_text()
        self.assertEqual(frames.count("Properties="), 20)
        self.assertEqual(len(frames.splitlines()), 20 * 62)
        self.assertIn("--trajectory: needs --assembly",
                      self.refusal("grains", "--trajectory", "xyz"))

    def test_says_what_cannot_be_kept(self):
        (self.path / "grains.yaml").write_text(HARD)
        code, said = self.run_to_end("grains", "--checkpoint", "kept")
        self.assertEqual(code, 0, said)
        told = json.loads((self.path / "out.json").read_text())["reference"]["warnings"]
        self.assertTrue(any("no state was kept on the way" in each for each in told), told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
