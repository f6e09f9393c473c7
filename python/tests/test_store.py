"""Makes a store with the program and holds its tables against those of runs, and against closed forms."""
import math
import os
import sqlite3
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy
import slipcheck

SOURCE = Path(os.environ["SLIPCHECK_SOURCE"])
SCENE = (SOURCE / "scenarios/symmetric-30cms.yaml").read_text().split("compare:")[0]
COMPARE = "compare: {tolerance: {sliding_time: 1 %, effective_restitution: 0.005}}\n"
E_EFF = "i-j.effective_restitution"
E_N = "contacts.0.normal.restitution"
KEYS = ["scene", "engine", "version", "precision", "profile", "rate", "scale", "phase", "observable", "value"]


def effective(e_n):
    """K: e_eff = (A e_n - 1)/(1 + A), A = 5/2."""
    return (2.5 * e_n - 1) / 3.5


class OfASweep(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        file = cls.path / "s.yaml"
        file.write_text(SCENE + COMPARE + f"sweep:\n  grid:\n    engine: bullet\n    rate: [240, 1000]\n    {E_N}: [0.5, 0.9]\n"
                        "    settings.solver_iterations: [1, 10]\n    phases: 4\n")
        subprocess.run([slipcheck.program_path(), "sweep", file, "-o", cls.path / "s.db", "--quiet"], check=True)
        cls.store = slipcheck.Store(cls.path / "s.db")

    @classmethod
    def tearDownClass(cls):
        cls.store.close()
        cls.folder.cleanup()

    def test_what_there_is(self):
        self.assertEqual((len(self.store), self.store.size, self.store.name), (8, 8, "symmetric-30cms"))
        self.assertIn("sweep:", self.store.text)
        kinds = self.store.parameters().set_index("name").kind
        self.assertEqual(kinds[E_N], "scene")
        self.assertEqual(kinds["settings.solver_iterations"], "setting")
        runs = self.store.runs()
        self.assertEqual(set(runs.status), {"ok"})
        self.assertTrue((runs.cpu_seconds > 0).all())
        self.assertIn(E_EFF, self.store.observables())

    def test_the_long_table_is_that_of_runs(self):
        table = self.store.table()
        self.assertEqual(list(table.columns), ["run", *KEYS[:7], E_N, "settings.solver_iterations", *KEYS[7:]])
        for e_n in (0.5, 0.9):
            text = SCENE.replace("restitution: 0.9", f"restitution: {e_n}") + COMPARE
            (self.path / "one.yaml").write_text(text)
            results = slipcheck.run(self.path / "one.yaml", phases=4, engines="bullet", precision="double", profiles=["default"],
                                    rates=[240, 1000], settings={"solver_iterations": 10})
            expected = results.table()
            expected = expected[(expected.engine == "bullet") & expected.phase.notna()].sort_values(["rate", "observable", "phase"])
            ours = table[(table[E_N] == e_n) & (table["settings.solver_iterations"] == 10) & table.phase.notna()]
            ours = ours.sort_values(["rate", "observable", "phase"])
            self.assertEqual(len(ours), len(expected))
            for key in KEYS:
                self.assertEqual(list(ours[key].astype(str)), list(expected[key].astype(str)), key)

    def test_references_are_those_of_distinct_scenes(self):
        table = self.store.table([E_EFF])
        reference = table[table.engine == "reference"].set_index(E_N)
        self.assertEqual(sorted(reference.index), [0.5, 0.9])
        for e_n in (0.5, 0.9):
            self.assertAlmostEqual(reference.value[e_n], effective(e_n), 14)
        self.assertTrue(reference.run.isna().all())
        closed = self.store.reference([E_EFF])
        self.assertEqual(len(closed), 2)
        numpy.testing.assert_allclose(closed.closed_form, closed.value, atol=1e-14)

    def test_some_of_it(self):
        table = self.store.table([E_EFF], {"rate": 240, E_N: [0.9]})
        self.assertEqual(set(table[table.engine == "bullet"].rate), {240.0})
        self.assertEqual(len(table[table.engine == "bullet"]), 2 * 4)
        self.assertEqual(list(table[table.engine == "reference"][E_N]), [0.9])
        with self.assertRaisesRegex(ValueError, "where: must name a column of runs .*, got 'speed'"):
            self.store.runs({"speed": 1})
        self.assertEqual(len(self.store.table(where={"rate": 7})), 0)

    def test_errors_are_of_the_worst_phase(self):
        table = self.store.table([E_EFF], {"engine": "bullet"})
        errors = self.store.errors()
        errors = errors[errors.observable == E_EFF].set_index("run")
        self.assertEqual(len(errors), 8)
        for run, values in table[table.engine == "bullet"].groupby("run"):
            right = effective(errors[E_N][run])
            self.assertAlmostEqual(errors["max"][run], (values.value - right).abs().max(), 13)
            self.assertEqual(errors.tolerance[run], 0.005)
            self.assertEqual(errors.verdict[run], "within" if errors["max"][run] <= 0.005 else "deviates")

    def test_a_grid(self):
        data = self.store.grid(E_EFF)
        self.assertEqual(dict(data.sizes), {"rate": 2, E_N: 2, "settings.solver_iterations": 2})
        self.assertEqual(data.rate.attrs["units"], "Hz")
        for e_n in (0.5, 0.9):
            numpy.testing.assert_allclose(data.reference.sel({E_N: e_n}), effective(e_n), atol=1e-14)
        runs = self.store.runs().join(self.store.table([E_EFF]).groupby("run").value.agg(["median", "max"]))
        for _, run in runs.iterrows():
            cell = data.sel({"rate": run.rate, E_N: run[E_N], "settings.solver_iterations": run["settings.solver_iterations"]})
            self.assertAlmostEqual(cell["median"].item(), run["median"], 14)
            self.assertAlmostEqual(cell["max"].item(), run["max"], 14)
        self.assertEqual(dict(self.store.grid(E_EFF, {"rate": 240, E_N: 0.5}).sizes), {"settings.solver_iterations": 2})
        with self.assertRaisesRegex(ValueError, "observable: must be one of .*, got 'nonsense'"):
            self.store.grid("nonsense")

    def test_strangers_are_refused(self):
        with self.assertRaises(FileNotFoundError):
            slipcheck.Store(self.path / "none.db")
        (self.path / "text.db").write_text("no data base, but long enough to be looked at" * 100)
        with self.assertRaisesRegex(ValueError, "text.db: must be a store of slipcheck sweep"):
            slipcheck.Store(self.path / "text.db")
        other = sqlite3.connect(self.path / "other.db")
        other.execute(f"PRAGMA application_id = {0x534C4950}")
        other.execute("PRAGMA user_version = 99")
        other.close()
        with self.assertRaisesRegex(ValueError, "must be a store of schema 1, got 99"):
            slipcheck.Store(self.path / "other.db")


class OfSamples(unittest.TestCase):
    def test_samples_are_no_grid_and_are_in_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            file, path = Path(folder) / "s.yaml", Path(folder) / "s.db"
            file.write_text(SCENE + COMPARE + "sweep:\n  sobol:\n    points: 16\n    ranges:\n"
                            f"      {E_N}: [0.5, 0.9]\n      gravity: [500, 1500]\n")
            subprocess.run([slipcheck.program_path(), "sweep", file, "-o", path, "--quiet"], check=True)
            with slipcheck.Store(path) as store:
                with self.assertRaisesRegex(ValueError, "grid: must have about as many runs as combinations"):
                    store.grid(E_EFF)
                table = store.table([E_EFF])
        self.assertEqual(len(table), 16)
        self.assertTrue(((table.gravity >= 5) & (table.gravity <= 15)).all())
        for e_n, value in zip(table[E_N], table.value):
            self.assertTrue(math.isclose(value, effective(e_n), abs_tol=1e-13))


if __name__ == "__main__":
    unittest.main()
