#!/usr/bin/env python3
"""Every fault of a worker is found by the check that is meant for it, and good workers pass all.

usage: conformance_test.py SLIPCHECK SOURCE_DIR
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
EXAMPLE = SOURCE / "docs/example-engine/slipcheck-engine-example-double"
FAULTY = Path(SLIPCHECK).parent / "faulty/slipcheck-engine-faulty-double"

# The example engine, but for one thing.
WORKER = """#!/usr/bin/env python3
import importlib.machinery, importlib.util, os, sys, threading, time
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("example", {example!r})
example = importlib.util.module_from_spec(importlib.util.spec_from_loader("example", loader))
loader.exec_module(example)
Worker, World, Body = example.Worker, example.World, example.Body


def around(owner, name, wrap):
    old = getattr(owner, name)
    setattr(owner, name, lambda *arguments: wrap(old, *arguments))


{fault}
code = example.main()
{after}
sys.exit(code)
"""


def in_step(code):
    """A change after each inner step of a world w."""
    return f"""
def wrap(old, w):
    old(w)
    {code}
around(World, "take_inner_step", wrap)
"""


def in_request(handler, code):
    """A change before a request r of a worker w."""
    return f"""
def wrap(old, w, r):
    {code}
    return old(w, r)
around(Worker, {handler!r}, wrap)
"""


# A worker that takes many bodies.
MANY = """
import struct
def hello(old, w, r):
    return dict(old(w, r), takes=["many"])
around(Worker, "hello", hello)
def configure(old, w, r):
    packed = r["scene"].pop("packed_bodies", None)
    if packed is not None:
        r["scene"]["bodies"] = [
            {"radius": radius, "mass": mass, "shape_factor": q, "material": material}
            for radius, mass, q, material in struct.iter_unpack("<dddI", packed)]
    return old(w, r)
around(Worker, "configure", configure)
def answer(old, w, r):
    if r["type"] != "skip":
        return old(w, r)
    frames = w.step(dict(r))
    last = frames["states"][-72 * frames["bodies"]:]
    return dict(frames, count=1, states=last, touch_counts=bytes(4), touches=b"")
around(Worker, "answer", answer)
"""

# Check: the fault that it is meant for.
FAULTS = {
    "greeting": "example.PROTOCOL = 1",
    "settings table": "example.SETTINGS[0]['shipped'] = -1.0",
    "nothing unasked": """
example.os.dup2 = lambda *ignored: None
def wrap(old, w, r):
    threading.Timer(0.003, lambda: os.write(1, b"done")).start()
    return old(w, r)
around(Worker, "start", wrap)
""",
    "unknown request": """
def wrap(old, w, r):
    return {"type": "started"} if r["type"].startswith("no_such") else old(w, r)
around(Worker, "answer", wrap)
""",
    "unknown keys": in_request("hello", "assert len(r) == 2"),
    "numbers of any width": in_request("configure", "assert isinstance(r['scene']['gravity'], float)"),
    "requests out of order": """
around(Worker, "start", lambda old, w, r: {"type": "started"} if w.scene is None else old(w, r))
""",
    "quit": """
def wrap(old, data):
    if b"quit" in data: os._exit(3)
    return old(data)
around(example, "from_cbor", wrap)
""",
    "unknown setting": """
around(example, "settings_in_force", lambda old, chosen: old(
    {name: chosen[name] for name in chosen if any(s["name"] == name for s in example.SETTINGS)}))
""",
    "values outside": """
def wrap(old, chosen):
    old({name: s["shipped"] for name in chosen for s in example.SETTINGS if s["name"] == name})
    return old({})
around(example, "settings_in_force", wrap)
""",
    "candidates": in_request("configure", "assert r['settings'].get('substeps') != 8"),
    "shipped values": """
around(example, "settings_in_force", lambda old, chosen: old({"substeps": 2, **chosen}))
""",
    "settings forgotten": """
kept = {}
def wrap(old, chosen):
    old(chosen)
    kept.update(chosen)
    return old(kept)
around(example, "settings_in_force", wrap)
""",
    "frames": in_request("step", "r['count'] = max(1, r['count'] - 1)"),
    "fresh start": """
worlds = []
def wrap(old, w, *arguments):
    old(w, *arguments)
    worlds.append(w)
    w.bodies[0].velocity = example.add(w.bodies[0].velocity, (1e-12 * len(worlds), 0, 0))
around(World, "__init__", wrap)
""",
    "another process": in_step("w.bodies[0].velocity = example.add(w.bodies[0].velocity, (1e-12, 0, 0), os.getpid())"),
    "steps at once": in_request("step", "w.world.bodies[0].spin = (0.0, 0.0, 1e-9 + w.world.bodies[0].spin[2])"),
    "several scenes": """
largest = [0]
def wrap(old, w, *arguments):
    old(w, *arguments)
    largest[0] = max(largest[0], len(w.bodies))
    w.bodies[0].mass *= 1 + 1e-9 * largest[0]
around(World, "__init__", wrap)
""",
    "long reply": in_request("step", "assert r['count'] < 1000"),
    "cpu_seconds": """
clock = time.process_time
example.time.process_time = lambda: 1000 * clock()
""",
    "time": """
clock = time.process_time
example.time.process_time = lambda: 1e-6 * clock()
""",
    "states that blew up": in_step("if w.bodies[0].velocity[0] != w.bodies[0].velocity[0]: os.abort()"),
    "scene: open box": in_request("configure", "if 'box' in r['scene']: os.abort()"),
    "scene: 400 bodies": in_request("configure", "if len(r['scene']['bodies']) > 100: os.abort()"),
    "scene: periodic plane": """
def refuse(scene):
    if any(scene["periodic"]): raise example.Refused("")
example.refuse_what_cannot_be_run = refuse
""",
    # It says that it takes surfaces, and goes on with the plane z = 0.
    "scene: slope without a substrate": """
def wrap(old, w, r):
    return {**old(w, r), "takes": ["surfaces"]}
around(Worker, "hello", wrap)
""",
    "skip": MANY.replace("w.step(dict(r))", "w.step(dict(r, count=1))"),
    "packed bodies": MANY.replace('"material": material', '"material": 0'),
    # It says that it takes them, and goes on with the hard contacts.
    "contacts that remember": """
def wrap(old, w, r):
    return {**old(w, r), "takes": ["memory"]}
around(Worker, "hello", wrap)
""",
    "free fall": in_step("for b in w.bodies: b.velocity = example.add(b.velocity, b.velocity, -0.002)"),
    "gravity along the plane": in_request("configure", "r['scene']['downhill'] = [0.0, 0.0]"),
    "rest stays": in_step("for b in w.bodies: b.position = example.add(b.position, (0, 0, -1e-6))"),
    "rolling goes on": """
def wrap(old, b, *arguments):
    old(b, *arguments)
    b.spin = tuple(-x for x in b.spin)
around(Body, "__init__", wrap)
""",
    "sliding slows down": in_request(
        "configure", "for s in r['scene']['substrate']: s['kinetic_friction'] *= 1.2"),
    "rebound": "example.restitution_at = lambda law, speed: 2.0",
    "touches in flight": in_step("w.touches[0, example.SUBSTRATE] = 1.0"),
    "touches at rest": in_step("for pair in w.touches: w.touches[pair] /= w.inner_step"),
    "touches of a collision": in_step("w.touches.pop((0, 1), None)"),
    "clock": in_step("w.begin = 0.0"),
}


def conformance(worker, *arguments, **environment):
    result = subprocess.run([SLIPCHECK, "conformance", str(worker), "--json", "-", *arguments],
                            capture_output=True, text=True, timeout=600,
                            env=dict(os.environ, **environment))
    report = json.loads(result.stdout)["workers"][0] if result.stdout else {}
    return result, {check["name"]: check for check in report.get("checks", [])}


class Conformance(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.worker = Path(folder.name) / "worker"

    def write(self, fault, after=""):
        self.worker.write_text(WORKER.format(example=str(EXAMPLE), fault=fault, after=after))
        self.worker.chmod(0o755)

    def expect_failed(self, name, *arguments):
        result, checks = conformance(self.worker, "--only", name, *arguments)
        self.assertEqual(result.returncode, 1, name)
        self.assertEqual(checks[name]["verdict"], "failed", name)
        self.assertTrue(checks[name]["why"] and checks[name]["mend"], name)

    def test_good_workers_pass_all(self):
        self.write(MANY)
        for worker in (EXAMPLE, self.worker, "bullet"):
            result, checks = conformance(worker)
            self.assertEqual(result.returncode, 0, result.stdout)
            not_passed = {name: check["verdict"] for name, check in checks.items()
                          if check["verdict"] != "passed"}
            many = {} if worker == self.worker else {"skip": "not judged", "packed bodies": "not judged"}
            self.assertEqual(not_passed, {**many, "contacts that remember": "not judged"})

    def test_lammps_takes_many_and_what_remembers(self):
        result, checks = conformance("lammps", "--only", "skip,packed bodies,contacts that remember")
        if result.returncode == 2:
            self.skipTest("no LAMMPS here")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual({check["verdict"] for check in checks.values()}, {"passed"})

    def test_each_fault_is_found_by_its_check(self):
        for name, fault in FAULTS.items():
            with self.subTest(name):
                self.write(fault)
                self.expect_failed(name)

    def test_a_worker_that_stays_is_found(self):
        self.write("", after="time.sleep(60)")
        self.expect_failed("end of input")

    def test_every_check_has_a_fault(self):
        _, checks = conformance(EXAMPLE, "--only", "greeting")
        names = {check for check in conformance("/bin/false")[1]}
        self.assertTrue(names > set(checks))
        others = {name for name in names if name.startswith("scene: ")}
        self.assertEqual(names - others - {"end of input"}, set(FAULTS) - others)

    def test_the_faulty_engine(self):
        reasons = {
            "abort": "killed by signal 6", "crash": "killed by signal 11",
            "close-pipe": "closed its pipe", "exit-code": "exited with code 3: no fun",
            "half-a-reply": "no reply within 2 s", "hang": "no reply within 2 s",
            "huge-length": "a message of 4294967295 bytes", "throw": "the engine is unwell",
            "more-than-asked": "more than one reply", "rubbish": "the CBOR item ends early",
            "wrong-reply": "not the reply asked for", "kill-at-step-10": "killed by signal 9"}
        for fault, reason in reasons.items():
            with self.subTest(fault):
                result, checks = conformance(FAULTY, "--only", "frames", "--reply-limit", "2",
                                             SLIPCHECK_FAULT=fault)
                self.assertEqual(result.returncode, 1)
                self.assertIn(reason, checks["frames"]["why"])
        _, checks = conformance(FAULTY)
        failed = {name for name, check in checks.items() if check["verdict"] == "failed"}
        self.assertEqual(failed, {
            "free fall", "gravity along the plane", "sliding slows down", "rebound",
            "touches in flight", "touches at rest", "touches of a collision", "clock"})
        _, checks = conformance(FAULTY, "--only", "frames", SLIPCHECK_FAULT="refuse")
        self.assertEqual(checks["frames"]["verdict"], "not judged")

    def test_text_on_the_reply_stream_is_recognised(self):
        self.write('os.write(1, b"Hello from the engine\\n")')
        _, checks = conformance(self.worker, "--only", "greeting")
        self.assertIn('a text that begins "Hell"', checks["greeting"]["why"])

    def test_what_cannot_start(self):
        self.worker.write_text("#!/usr/bin/env python3\nimport no_such_module\n")
        self.worker.chmod(0o755)
        result, _ = conformance(self.worker)
        self.assertEqual(result.returncode, 3)
        self.assertIn("no_such_module", result.stdout)
        self.worker.chmod(0o644)
        for worker in (self.worker, "no-such-engine", self.worker.parent / "nothing"):
            self.assertEqual(conformance(worker)[0].returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
