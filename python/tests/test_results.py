"""Runs the program and holds tables against the files they come from."""
import json
import math
import os
import tempfile
import unittest
from pathlib import Path

import slipcheck

SOURCE = Path(os.environ["SLIPCHECK_SOURCE"])
SCENE = SOURCE / "scenarios/symmetric-30cms.yaml"
E_EFF = "i-j.effective_restitution"


class OfTheProgram(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.results = slipcheck.run(SCENE, phases=8, engines="bullet", precision="double", profiles=["default", "tuned"],
                                    rates=[240, 1000])

    def test_long_table(self):
        table = self.results.table()
        self.assertEqual(list(table.columns), ["scene", "engine", "version", "precision", "profile", "rate", "scale", "phase",
                                               "observable", "value"])
        seen = table[(table.observable == E_EFF) & (table.engine == "bullet")]
        self.assertEqual(len(seen), 2 * 2 * 8)
        self.assertEqual(set(seen.phase), set(range(8)))
        reference = table[(table.observable == E_EFF) & (table.engine == "reference")]
        # K: e_eff = (A e_n - 1)/(1 + A), A = 5/2.
        self.assertAlmostEqual(reference.value.item(), (2.5 * 0.9 - 1) / 3.5, 14)
        # The lottery: default settings scatter, tuned ones do not (README).
        spread = seen.groupby(["profile", "rate"]).value.agg(lambda values: values.max() - values.min())
        self.assertGreater(spread["default", 240.0], 0.05)
        self.assertLess(spread["tuned", 240.0], 1e-5)

    def test_table_has_every_number_of_the_file(self):
        table = self.results.table()
        for run in self.results.scenes[0]["runs"]:
            rows = table[(table.engine == run["engine"]) & (table.profile == run["profile"]) & (table.rate == run["rate"])]
            for observable, seen in run["observables"].items():
                values = list(rows[rows.observable == observable].value)
                expected = seen.get("values", [seen["median"]])
                self.assertEqual([None if math.isnan(value) else value for value in values], expected)

    def test_dataset_runs_errors_reference_and_verdict(self):
        data = self.results.dataset()
        self.assertEqual(data[E_EFF].dims, ("run", "phase"))
        self.assertEqual(data[E_EFF].shape, (4, 8))
        self.assertEqual(set(data.profile.values), {"default", "tuned"})
        self.assertAlmostEqual(data[E_EFF].attrs["reference"], (2.5 * 0.9 - 1) / 3.5, 14)
        runs = self.results.runs()
        self.assertEqual(list(runs.status), ["ok"] * 4)
        self.assertTrue((runs.cpu_seconds > 0).all())
        errors = self.results.errors()
        row = errors[(errors.observable == E_EFF) & (errors.profile == "default") & (errors.rate == 240)]
        self.assertTrue(row.absolute.item())
        worst = max(abs(value - data[E_EFF].attrs["reference"])
                    for value in data[E_EFF].values[[run["profile"] == "default" and run["rate"] == 240
                                                     for run in self.results.scenes[0]["runs"]]][0])
        self.assertAlmostEqual(row["max"].item(), worst, 14)
        self.assertEqual(self.results.verdicts, {"symmetric-30cms": "deviates"})
        closed = self.results.reference().set_index("observable").closed_form[E_EFF]
        self.assertAlmostEqual(closed, (2.5 * 0.9 - 1) / 3.5, 14)

    def test_scenes_as_dicts_and_the_program_s_own_words(self):
        scene = {"slipcheck": 1, "name": "slide", "title": "A ball slides", "gravity": "981 cm/s^2", "materials": {"steel": {"density": "7.85 g/cm^3"}},
                 "contacts": [{"between": ["steel", "substrate"], "friction": {"static": 0.5, "kinetic": 0.1}}],
                 "substrate": {}, "run": {"until": "rolling", "limit": 5},
                 "bodies": [{"name": "ball", "material": "steel", "sphere": {"radius": "2 mm"}, "position": [0, 0],
                             "velocity": [0.5, 0]}], "compare": {"engines": []}}
        found = slipcheck.run(scene).reference().set_index("observable").value
        # K (44) from pure sliding: v^s = A v/(1 + A) = 5/7 v, t^s = v/((1 + A) mu g).
        self.assertAlmostEqual(found["ball.rolling_velocity"], 0.5 * 5 / 7, 13)
        self.assertAlmostEqual(found["ball.sliding_time"], 0.5 / (3.5 * 0.1 * 9.81), 13)
        scene["bodies"][0]["sphere"]["radius"] = -1
        with self.assertRaises(slipcheck.ProgramError) as refused:
            slipcheck.run(scene)
        self.assertEqual(refused.exception.exit_code, 2)
        self.assertIn("bodies[0].sphere.radius: must be > 0", str(refused.exception))


class OfFiles(unittest.TestCase):
    def test_nulls_folders_and_strangers(self):
        scene = {"schema": "slipcheck-result/1", "slipcheck": {"version": "1"}, "scenario": {"name": "s"}, "verdict": "failed",
                 "reference": {"solver": "event", "observables": {"i.x": {"value": None, "uncertainty": None, "reason": "…"}}},
                 "runs": [{"engine": "e", "version": "1", "precision": "single", "profile": "p", "rate": 60.0, "status": "timed_out",
                           "reason": "10 s", "cpu_seconds": None, "nulls": {"cpu_seconds": "infinite"}, "observables":
                           {"i.x": {"median": 1, "values": [1.0, None, None], "nulls": {"values[2]": "minus_infinite"}}}}]}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder)
            (path / "s.json").write_text(json.dumps(scene))
            (path / "s.motion.json").write_text('{"schema": "slipcheck-motion/1"}')
            results = slipcheck.Results.read(path)
            (path / "t.json").write_text('{"schema": "slipcheck-result/2"}')
            with self.assertRaisesRegex(ValueError, "t.json: schema: must be slipcheck-result/1"):
                slipcheck.Results.read(path / "t.json")
        self.assertEqual(len(results), 1)
        self.assertEqual(results.runs().cpu_seconds.item(), math.inf)
        values = list(results.table().value)
        self.assertTrue(math.isnan(values[0]) and math.isnan(values[2]))
        self.assertEqual((values[1], values[3]), (1.0, -math.inf))
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(ValueError, "must hold result files"):
            slipcheck.Results.read(folder)


if __name__ == "__main__":
    unittest.main()
