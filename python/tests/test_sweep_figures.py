"""The figures and summaries of the bundled sweeps (results/sweep_figures.py), of small ones."""
import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import slipcheck

SOURCE = Path(os.environ["SLIPCHECK_SOURCE"])
E_EFF = "i-j.effective_restitution"
SMALLER = {
    "lottery-bullet": [(r"restitution: \[.*\]", "restitution: [0.5, 0.9]"), (r"iterations: \[.*\]", "iterations: [1, 10]"),
                       (r"rate: \[.*\]", "rate: [240, 1000]")],
    "lottery-engines": [(r"engine: \[[^]]*\]", "engine: bullet"), (r"restitution: \[.*\]", "restitution: [0.5, 0.9]"),
                        (r"rate: \[.*\]", "rate: [60, 240]")],
    "tuning-bullet": [(r"rate: \[.*\]", "rate: [240, 1000]"), (r"at_contacts: \[.*\]", "at_contacts: [0, 16]"),
                      (r"erp2: \[.*\]", "erp2: [0, 0.8]")],
}


class OfBundledSweeps(unittest.TestCase):
    def test_figures_and_summaries(self):
        self.assertEqual(sorted(file.stem for file in (SOURCE / "scenarios/sweeps").glob("*.yaml")), sorted(SMALLER))
        with tempfile.TemporaryDirectory() as folder:
            path, out = Path(folder), Path(folder) / "out"
            for name, changes in SMALLER.items():
                text = (SOURCE / f"scenarios/sweeps/{name}.yaml").read_text()
                for old, new in [*changes, (r"phases: 32", "phases: 4")]:
                    text, count = re.subn(old, new, text, flags=re.DOTALL if "[^]]" in old else 0)
                    self.assertEqual(count, 1, old)
                (path / f"{name}.yaml").write_text(text)
                subprocess.run([slipcheck.program_path(), "sweep", path / f"{name}.yaml", "-o", path / f"{name}.db", "--quiet"], check=True)
            environment = {**os.environ, "PYTHONPATH": str(Path(slipcheck.__file__).parent.parent), "MPLCONFIGDIR": folder}
            command = [sys.executable, SOURCE / "results/sweep_figures.py", path, out]
            subprocess.run(command, check=True, env=environment)
            first = {file.name: file.read_bytes() for file in out.iterdir()}
            self.assertEqual(sorted(first), sorted(["README.md", *(name + end for name in SMALLER for end in (".csv", ".svg"))]))
            subprocess.run(command, check=True, env=environment)
            self.assertEqual({file.name: file.read_bytes() for file in out.iterdir()}, first, "the same numbers, other bytes")

            text = (out / "README.md").read_text()
            with slipcheck.Store(path / "lottery-bullet.db") as store:
                table = store.table([E_EFF]).set_index("run").value
            with open(out / "lottery-bullet.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len(rows), 8)
            worst = 0
            for row in rows:
                # K: e_eff = (A e_n - 1)/(1 + A), A = 5/2.
                right = (2.5 * float(row["contacts.0.normal.restitution"]) - 1) / 3.5
                error = max(abs(value - right) for value in table.loc[[int(row["run"])]])
                self.assertAlmostEqual(float(row["right"]), right, 8)
                self.assertAlmostEqual(float(row["error"]), error, 8)
                worst = max(worst, error)
            self.assertIn(f"by {worst:.3g} at most", text)
            self.assertIn("8 ensembles, 32 runs, e_n from 0.5 to 0.9, 240 to 1000 Hz, 1 to 10 iterations", text)


if __name__ == "__main__":
    unittest.main()
