#!/usr/bin/env python3
"""slipcheck sweep, merge and query as users run them: kills, resumes, shards, refusals.

usage: sweep_test.py SLIPCHECK SOURCE_DIR [sanitized]
"""
import contextlib
import csv
import io
import json
import os
import random
import re
import resource
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from sweep_store import contents, runs_in  # noqa: E402

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
SLOW = "sanitized" in sys.argv[3:]

SCENE = (SOURCE / "scenarios/symmetric-30cms.yaml").read_text().split("compare:")[0]
COMPARE = "compare: {tolerance: {sliding_time: 1 %, effective_restitution: 0.005}}\n"
BLOCK = """sweep:
  grid:
    engine: bullet
    rate: [60, 240]
    contacts.0.normal.restitution: {from: 0.3, to: 0.9, count: 10}
    settings.solver_iterations: [1, 10]
    phases: [4, 16]
"""
RUNS = 80

class Sweeping(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.path = Path(self.directory.name)
        self.file = self.written("s.yaml", SCENE + COMPARE + BLOCK)

    def tearDown(self):
        self.directory.cleanup()

    def written(self, name, text):
        (self.path / name).write_text(text)
        return self.path / name

    def run_it(self, *arguments, code=0, **options):
        done = subprocess.run([SLIPCHECK, *map(str, arguments)], capture_output=True, text=True,
                              timeout=600, **options)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done

    def sweep(self, store, *arguments, code=0, file=None, **options):
        return self.run_it("sweep", file or self.file, "-o", self.path / store, *arguments,
                           code=code, **options)

    def count(self, store):
        return runs_in(self.path / store)

    def files(self):
        return sorted(each.name for each in self.path.iterdir())

    def test_kills_at_random_moments_change_nothing(self):
        begin = time.monotonic()
        self.sweep("whole.db")
        whole = time.monotonic() - begin
        self.assertEqual(self.count("whole.db"), RUNS)
        chance = random.Random(int(os.environ.get("SLIPCHECK_SEED", "1")))
        kills, rounds = 0, 0
        while kills < 20:
            rounds += 1
            self.assertLess(rounds, 400)
            process = subprocess.Popen(
                [SLIPCHECK, "sweep", self.file, "-o", self.path / "killed.db", "--quiet"])
            try:
                process.wait(timeout=chance.uniform(0, whole / 6 + 0.05))
                # It came to its end: from the beginning again.
                self.assertEqual(process.returncode, 0)
                self.assertEqual(contents(self.path / "killed.db"),
                                 contents(self.path / "whole.db"))
                (self.path / "killed.db").unlink()
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                kills += 1
        self.sweep("killed.db")
        self.assertEqual(contents(self.path / "killed.db"), contents(self.path / "whole.db"))

    def test_nothing_is_made_twice(self):
        self.sweep("s.db", "--limit-time", "0.05" if not SLOW else "1", code=130)
        first = self.count("s.db")
        self.assertLess(first, RUNS)
        connection = sqlite3.connect(self.path / "s.db")
        before = dict(connection.execute("SELECT run, seconds FROM runs"))
        connection.close()
        self.sweep("s.db")
        connection = sqlite3.connect(self.path / "s.db")
        after = dict(connection.execute("SELECT run, seconds FROM runs"))
        connection.close()
        self.assertEqual(len(after), RUNS)
        for run, seconds in before.items():
            self.assertEqual(after[run], seconds, "made anew")
        said = self.sweep("s.db").stderr
        self.assertIn(f"{RUNS} of {RUNS} are in", said)

    def test_an_interrupt_keeps_what_is_done(self):
        text = SCENE + COMPARE + BLOCK.replace("[60, 240]", "[60, 240, 16000]").replace(
            "phases: [4, 16]", "phases: [64]")
        file = self.written("long.yaml", text)
        process = subprocess.Popen([SLIPCHECK, "sweep", file, "-o", self.path / "s.db"],
                                   stderr=subprocess.PIPE, text=True)
        while not (self.path / "s.db").exists() or runs_in(self.path / "s.db") == 0:
            self.assertIsNone(process.poll())
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("the same command goes on with them", said)
        kept = self.count("s.db")
        self.assertGreater(kept, 0)
        self.assertLess(kept, 60)
        connection = sqlite3.connect(self.path / "s.db")
        self.assertEqual(connection.execute("SELECT DISTINCT status FROM runs").fetchall(),
                         [("ok",)])
        connection.close()

    def test_a_full_disk_loses_no_run(self):
        self.sweep("whole.db")
        size = 60_000
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        done = self.sweep("s.db", code=4, preexec_fn=limit)
        self.assertIn("cannot be written", done.stderr)
        self.assertIn("goes on with it", done.stderr)
        self.assertLess(self.count("s.db"), RUNS)
        self.sweep("s.db")
        self.assertEqual(contents(self.path / "s.db"), contents(self.path / "whole.db"))

    def test_shards_together_are_the_sweep(self):
        self.sweep("whole.db")
        for k in range(1, 4):
            self.sweep(f"part-{k}.db", "--shard", f"{k}/3")
        parts = [self.path / f"part-{k}.db" for k in (2, 3, 1)]
        self.assertEqual(sum(self.count(part.name) for part in parts), RUNS)
        self.run_it("merge", self.path / "merged.db", *parts)
        self.assertEqual(contents(self.path / "merged.db"), contents(self.path / "whole.db"))
        again = self.run_it("merge", self.path / "merged.db", *parts).stdout
        self.assertIn("0 of them", again)
        self.assertEqual(contents(self.path / "merged.db"), contents(self.path / "whole.db"))
        self.sweep("merged.db")  # nothing is left to do

    def test_what_a_run_shows_is_what_slipcheck_run_shows(self):
        self.sweep("s.db")
        scene = SCENE.replace("restitution: 0.9", "restitution: 0.3") + COMPARE.replace(
            "{tol", "{engines: [{engine: bullet, rate: 240}], tol")
        result = json.loads(self.run_it(
            "run", self.written("one.yaml", scene), "--phases", 16, "--set", "solver_iterations=1",
            "--json", "-", code=1).stdout)
        run = result["runs"][0]["observables"]["i-j.effective_restitution"]
        rows = json.loads(self.run_it(
            "query", self.path / "s.db", "contacts.0.normal.restitution=0.3", "rate=240",
            "settings.solver_iterations=1", "phases=16", "--json", "-", "--columns",
            ",".join(["i-j.effective_restitution" + each for each in
                      ("", ".min", ".max", ".reference")])).stdout)["rows"]
        self.assertEqual(rows, [[run["median"], run["min"], run["max"],
                                 result["reference"]["observables"]["i-j.effective_restitution"]
                                 ["value"]]])

    def test_a_reference_alone(self):
        file = self.written("r.yaml", SCENE + COMPARE +
                            "sweep: {grid: {contacts.0.normal.restitution: [0.5, 0.7, 0.9]}}\n")
        self.sweep("r.db", file=file)
        rows = list(csv.DictReader(io.StringIO(self.run_it(
            "query", self.path / "r.db", "--csv", "-", "--columns",
            "contacts.0.normal.restitution,i-j.effective_restitution.reference").stdout)))
        self.assertEqual(len(rows), 3)
        for row in rows:  # e_eff of two that roll towards each other, as scenarios/symmetric says
            e_n = float(row["contacts.0.normal.restitution"])
            self.assertAlmostEqual(float(row["i-j.effective_restitution.reference"]),
                                   (2.5 * e_n - 1) / 3.5, places=10)

    def test_samples(self):
        for kind in ("latin_hypercube", "sobol"):
            file = self.written(f"{kind}.yaml", SCENE + COMPARE + f"""sweep:
  grid: {{engine: bullet, rate: 240, phases: 2}}
  {kind}: {{points: 12, ranges: {{"contacts[0].normal.restitution": [0.1, 1], settings.erp2: [0.1, 0.9]}}}}
""")
            self.sweep(f"{kind}.db", file=file)
            rows = json.loads(self.run_it("query", self.path / f"{kind}.db", "--json", "-",
                                          "--columns",
                                          "contacts.0.normal.restitution,settings.erp2").stdout)
            self.assertEqual(len(rows["rows"]), 12)
            for e_n, erp in rows["rows"]:
                self.assertTrue(0.1 <= e_n <= 1 and 0.1 <= erp <= 0.9)

    def test_a_dry_run_tells_and_writes_nothing(self):
        said = self.sweep("s.db", "--dry-run").stdout
        self.assertIn(f"{RUNS} runs of 10 scenes, {RUNS} to be made", said)
        self.assertRegex(said, r"about \d+ s, by \d+ that were tried")
        self.assertEqual(self.files(), ["s.yaml"])

    def test_retry_makes_failures_anew(self):
        self.sweep("s.db")
        connection = sqlite3.connect(self.path / "s.db")
        connection.execute("UPDATE runs SET status = 'crashed', reason = 'x' WHERE run < 5")
        connection.commit()
        connection.close()
        self.assertIn("5 crashed", self.sweep("s.db").stderr)
        self.assertNotIn("crashed", self.sweep("s.db", "--retry").stderr)

    def refused(self, text, *told):
        before = self.files()
        done = self.sweep("s.db", code=2, file=self.written("s.yaml", text))
        for each in told:
            self.assertIn(each, done.stderr)
        self.assertEqual(self.files(), before)

    def test_bad_sweeps_are_refused_and_nothing_is_written(self):
        scene = SCENE + COMPARE
        self.refused(scene + "sweep: {grid: {bodies.k.velocity.0: [1, 2]}}\n",
                     "s.yaml:", "bodies.k.velocity.0", "bodies has no item k")
        self.refused(scene + "sweep: {grid: {bodies.i.sphere.raduis: [1, 2]}}\n", "raduis",
                     "did you mean radius")
        self.refused(scene + "sweep: {grid: {}}\n", "at least one name")
        self.refused(scene + "sweep: {grid: {gravity: []}}\n", "must be a list of at least 1")
        self.refused(scene + "sweep: {grid: {gravity: {from: 1, to: 2, count: 1000000}, "
                     "contacts.0.normal.restitution: {from: 0, to: 1, count: 1000000}}}\n",
                     "at most 100000000 runs", "1e+12")
        self.refused(scene, "sweep: must be there")
        self.refused(scene + "sweep: {grid: {engine: bulet, rate: 60}}\n", "sweep.engine",
                     "did you mean bullet")
        self.refused(scene + "sweep: {grid: {engine: bullet, profile: tunde, rate: 60}}\n",
                     "sweep.profile", "tunde")
        self.refused(scene + "sweep: {grid: {engine: bullet, rate: 60, settings.epr: [1, 2]}}\n",
                     "sweep.settings.epr", "is no setting of this engine")
        self.refused(scene + "sweep: {grid: {engine: bullet, rate: 60, "
                     "settings.solver_iterations: [1.5]}}\n", "whole number", "got 1.5")
        self.refused(scene + "sweep: {grid: {engine: bullet, rate: -3}}\n", "got -3")

    def test_another_sweep_or_schema_or_a_second_writer_is_refused(self):
        self.sweep("s.db")
        before = (self.path / "s.db").read_bytes()
        other = self.written("t.yaml", SCENE + COMPARE + BLOCK.replace("240", "250"))
        self.assertIn("must be the store of this sweep",
                      self.sweep("s.db", code=2, file=other).stderr)
        self.sweep("t.db", file=other)
        self.assertIn("same sweep", self.run_it(
            "merge", self.path / "m.db", self.path / "s.db", self.path / "t.db", code=2).stderr)
        self.assertFalse((self.path / "m.db").exists())
        self.assertEqual((self.path / "s.db").read_bytes(), before)

        self.written("no.db", "this is no store, though it is long enough to be one" * 100)
        self.assertIn("must be a store of slipcheck sweep", self.sweep("no.db", code=2).stderr)
        self.assertIn("must be a store of slipcheck sweep",
                      self.run_it("query", self.path / "no.db", code=2).stderr)

        connection = sqlite3.connect(self.path / "t.db")
        connection.execute("PRAGMA user_version = 99")
        connection.close()
        self.assertIn("schema 1, got 99", self.sweep("t.db", code=2, file=other).stderr)

        long = self.written("u.yaml", SCENE + COMPARE + BLOCK.replace("[60, 240]", "[16000]")
                            .replace("[4, 16]", "[1000]"))
        process = subprocess.Popen([SLIPCHECK, "sweep", long, "-o", self.path / "u.db", "--quiet"])
        try:
            while not (self.path / "u.db").exists():
                time.sleep(0.02)
            time.sleep(0.2)
            self.assertIn("one process at a time",
                          self.sweep("u.db", code=2, file=long).stderr)
        finally:
            process.terminate()
            process.wait()

    def test_a_folder_that_cannot_be_written_is_refused(self):
        self.assertIn("must", self.run_it("sweep", self.file, "-o", "/proc/s.db", code=2).stderr)
        self.assertIn("directory must exist",
                      self.run_it("sweep", self.file, "-o", self.path / "no/s.db", code=2).stderr)

    def test_bad_options(self):
        for shard in ("0/4", "5/4", "4", "a/b", "1/0"):
            self.assertIn("--shard: must be i/n",
                          self.sweep("s.db", "--shard", shard, code=2).stderr)
        self.assertEqual(self.files(), ["s.yaml"])
        self.sweep("s.db")
        self.assertIn("did you mean rate?",
                      self.run_it("query", self.path / "s.db", "rat>3", code=2).stderr)

    def test_a_page_and_charts_of_a_store(self):
        self.sweep("s.db")
        store, page, folder = self.path / "s.db", self.path / "s.html", self.path / "charts"
        drawn = self.run_it("query", store, "rate=240", "--html", page, "--svg", folder)
        self.assertEqual(drawn.stdout, "")
        text = page.read_text()
        self.assertIn("40 runs of symmetric-30cms; i-j.effective_restitution.error [tolerances]: ", text)
        self.assertIn("40 runs</summary>", text)
        self.assertEqual(text.count("<svg"), 3)
        self.assertNotIn("http-equiv=\"refresh\"", text)
        self.assertNotIn("<script", text)
        for name in ("surface", "scatter", "parallel"):
            self.assertTrue((folder / f"{name}.svg").exists(), name)
        # The rate does not vary among these runs.
        effects = text[:text.index('id="surface"')]
        self.assertIn("contacts.0.normal.restitution", effects)
        self.assertNotIn("<th scope=\"row\">rate", effects)

        # The median of the worst errors, from the store by other means.
        with contextlib.closing(sqlite3.connect(store)) as connection:
            errors = sorted(error / tolerance for error, tolerance in connection.execute(
                "SELECT error, tolerance FROM results WHERE observable = 'i-j.effective_restitution' AND rate = 240"))
        told = float(re.search(r"\[tolerances\]: ([0-9.e+-]+) in the median", text).group(1))
        self.assertAlmostEqual(told / ((errors[19] + errors[20]) / 2), 1, delta=1e-3)  # four digits

        for arguments, why in ((("rate=7",), "must find a run"), (("--of", "status"), "must be a column with numbers"),
                               (("--long",), "excludes")):
            refused = self.run_it("query", store, *arguments, "--html", self.path / "no.html", code=2)
            self.assertIn(why, refused.stderr)
        self.assertFalse((self.path / "no.html").exists())
        refused = self.run_it("query", store, "--of", "rate", code=2)
        self.assertIn("--of: must stand beside --html or --svg", refused.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
