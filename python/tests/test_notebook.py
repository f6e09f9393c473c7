"""The notebook of the lottery runs, and draws what it says."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import matplotlib
except ImportError:
    matplotlib = None

FOLDER = Path(__file__).resolve().parent.parent


@unittest.skipUnless(matplotlib, "there is no matplotlib")
class Notebook(unittest.TestCase):
    def test_lottery(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, FOLDER / "run_notebook.py", FOLDER / "lottery.ipynb", folder],
                                  capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stderr)
            picture = Path(folder, "lottery.png").read_bytes()
        self.assertTrue(picture.startswith(b"\x89PNG"))
        self.assertGreater(len(picture), 20_000)

    def test_is_a_notebook(self):
        try:
            import nbformat
        except ImportError:
            self.skipTest("there is no nbformat")
        nbformat.validate(nbformat.read(FOLDER / "lottery.ipynb", 4))


if __name__ == "__main__":
    unittest.main()
