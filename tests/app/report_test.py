#!/usr/bin/env python3
"""Runs `slipcheck report` and the outputs that it shares with `slipcheck run` as a user does.

usage: report_test.py SLIPCHECK SOURCE_DIR [unscripted]
"""
import base64
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib
from pathlib import Path

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
SCENES = SOURCE / "scenarios"


def run(*arguments, **options):
    return subprocess.run([SLIPCHECK, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600, **options)


def page_data(page):
    if "unscripted" in sys.argv[3:]:
        raise unittest.SkipTest("the program is built without the page's script")
    packed = re.search(r'id="slipcheck-data">([^<]*)<', page.read_text()).group(1)
    return json.loads(zlib.decompress(base64.b64decode(packed)))


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.runs = cls.folder / "runs"
        done = run("run", SCENES / "roll-to-rest.yaml", SCENES / "symmetric-30cms.yaml", "--phases",
                   "4", "--out", cls.runs)
        assert done.returncode == 1, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)

    def test_the_page_is_that_of_the_run(self):
        page = self.path / "page.html"
        result = run("report", self.runs, "-o", page)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, f"{page}\n")
        data, of_run = page_data(page), page_data(self.runs / "report.html")
        # Motions are kept with nine digits.
        for one, other in zip(data["scenes"], of_run["scenes"]):
            motion, of_motion = one.pop("motion"), other.pop("motion")
            self.assertEqual([(m["run"], m["role"], m["phase"]) for m in motion["runs"]],
                             [(m["run"], m["role"], m["phase"]) for m in of_motion["runs"]])
        self.assertEqual(data, of_run)
        left_out = re.compile(r"<div><dt>(command|date)</dt><dd>[^<]*</dd></div>\n|"
                              '(?<="slipcheck-data">)[^<]*')
        self.assertEqual(left_out.sub("", page.read_text()),
                         left_out.sub("", (self.runs / "report.html").read_text()))

    def test_what_has_moved_since_older_results_stands_first(self):
        older = self.path / "older"
        older.mkdir()
        for file in self.runs.glob("*.json"):
            (older / file.name).write_text(file.read_text())
        page, summary = self.path / "page.html", self.path / "summary.md"
        same = run("report", self.runs, "--against", older, "-o", page, "--markdown", summary)
        self.assertEqual(same.returncode, 0, same.stderr)
        self.assertRegex(page.read_text(), r'<section id="moved">[^§]*: 0 of \d+ values in')

        # One value of one run is moved by three tolerances of 0.5 %, 0.015, in all phases.
        file = older / "symmetric-30cms.json"
        result = json.loads(file.read_text())
        [run_of] = [r for r in result["runs"] if r["profile"] == "tuned" and r["rate"] == 240]
        value = run_of["observables"]["i-j.effective_restitution"]
        for key in ("median", "min", "max"):
            value[key] += 0.015
        value["values"] = [one + 0.015 for one in value["values"]]
        file.write_text(json.dumps(result))
        moved = run("report", self.runs, "--against", older, "-o", page, "--markdown", summary)
        self.assertEqual(moved.returncode, 0, moved.stderr)
        text = page.read_text()
        section = text[text.index('<section id="moved">'):]
        section = section[:section.index("</section>")]
        self.assertRegex(section, r": 1 of \d+ values in")
        self.assertIn("bullet double tuned 240 Hz", section)
        self.assertIn('data-value="3"', section)
        self.assertLess(text.index('<section id="moved">'), text.index('id="index"'))
        self.assertIn("### What has moved", summary.read_text())
        missing = run("report", self.runs, "--against", self.path / "nowhere", "-o", page)
        self.assertEqual(missing.returncode, 2)

    def test_what_has_moved_since_the_baselines_stands_first(self):
        results, baselines, page = self.path / "16", self.path / "baselines", self.path / "page.html"
        run("run", SCENES / "symmetric-30cms.yaml", "--phases", "16", "--out", results, "--quiet")
        kept = run("check", SCENES / "symmetric-30cms.yaml", "--baselines", baselines, "--update")
        self.assertEqual(kept.returncode, 0, kept.stderr)
        same = run("report", results, "--baselines", baselines, "-o", page)
        self.assertEqual(same.returncode, 0, same.stderr)
        self.assertRegex(page.read_text(), r'<section id="moved">[^§]*: nothing has moved; \d+ values in')

        # The median of one run is moved by three times what it may.
        file = baselines / "symmetric-30cms.json"
        baseline = json.loads(file.read_text())
        [kept_run] = [r for r in baseline["runs"] if r["profile"] == "tuned" and r["rate"] == 240]
        kept_run["observables"]["i-j.effective_restitution"]["median"] += 0.015
        file.write_text(json.dumps(baseline))
        moved = run("report", results, "--baselines", baselines, "-o", page)
        self.assertEqual(moved.returncode, 0, moved.stderr)
        checked = self.path / "checked.html"
        check = run("check", SCENES / "symmetric-30cms.yaml", "--baselines", baselines, "--html", checked)
        self.assertEqual(check.returncode, 1, check.stderr)
        for text in (page.read_text(), checked.read_text()):
            section = text[text.index('<section id="moved">'):]
            section = section[:section.index("</section>")]
            self.assertIn("1 of 1 scene has moved: 1 change", section)
            self.assertIn("bullet double tuned 240 Hz", section)
            self.assertLess(text.index('<section id="moved">'), text.index('id="index"'))

        for arguments, why in (((self.runs, "--baselines", baselines), "must have 16 phases"),
                               ((results, "--baselines", self.path / "none"), "holds none of these"),
                               ((results, "--baselines", baselines, "--against", results), "excludes")):
            result = run("report", *arguments, "-o", self.path / "no.html")
            self.assertEqual(result.returncode, 2, why)
            self.assertIn(why, result.stderr)
            self.assertFalse((self.path / "no.html").exists())

    def test_without_its_script_the_page_has_its_tables(self):
        page = self.path / "page.html"
        run("report", self.runs, "-o", page, "--without-script")
        text = page.read_text()
        self.assertNotIn("<script", text)
        self.assertNotIn("script-src", text)
        self.assertIn("default-src 'none'", text)
        self.assertGreater(text.count("<table"), 10)

    def test_every_format(self):
        at = self.path.joinpath
        result = run("report", self.runs, "-o", at("p.html"), "--csv", at("r.csv"), "--phases-csv",
                     at("p.csv"), "--markdown", at("s.md"), "--junit", at("j.xml"), "--xyz",
                     at("xyz"), "--vtk", at("vtk"), "--svg", at("svg"))
        self.assertEqual(result.returncode, 0, result.stderr)
        results = {name: json.loads((self.runs / f"{name}.json").read_text())
                   for name in ("roll-to-rest", "symmetric-30cms")}

        rows = list(csv.DictReader(at("r.csv").read_text().splitlines()))
        for row in rows:
            if not row["max_error"]:
                continue
            one = [r for r in results[row["scene"]]["runs"]
                   if (r["engine"], r["precision"], r["profile"], r["rate"]) ==
                   (row["engine"], row["precision"], row["profile"], float(row["rate"]))]
            self.assertEqual(float(row["max_error"]),
                             one[0]["errors"][row["observable"]]["max"])
        self.assertEqual({row["scene"] for row in rows}, set(results))
        with open(at("p.csv"), newline="") as table:
            self.assertEqual({row["phase"] for row in csv.DictReader(table)
                              if row["scene"] == "symmetric-30cms"}, {"0", "1", "2", "3"})

        suites = xml.etree.ElementTree.parse(at("j.xml")).getroot()
        cases = list(suites.iter("testcase"))
        runs = [r for result in results.values() for r in result["runs"]]
        self.assertEqual(len(cases), len(runs))
        deviating = [r for r in runs if any(not e["within"] for e in r["errors"].values())]
        self.assertEqual(len(list(suites.iter("failure"))), len(deviating))
        self.assertIn("j.rolling_velocity", at("s.md").read_text())

        motion = json.loads((self.runs / "symmetric-30cms.motion.json").read_text())
        lines = at("xyz/symmetric-30cms-reference.xyz").read_text().splitlines()
        self.assertEqual(len(lines), len(motion["reference"]["time"]) * (2 + 2))
        first = [float(number) for number in lines[2].split()[1:4]]
        for written, kept in zip(first, motion["reference"]["position"][0][:3]):
            self.assertAlmostEqual(written, kept, delta=1e-8)
        collection = xml.etree.ElementTree.parse(at("vtk/symmetric-30cms-reference.pvd"))
        files = [data.get("file") for data in collection.iter("DataSet")]
        self.assertEqual(len(files), len(motion["reference"]["time"]))
        for file in files:
            piece = next(xml.etree.ElementTree.parse(at("vtk", file)).iter("Piece"))
            self.assertEqual(piece.get("NumberOfPoints"), "2")
        charts = sorted(at("svg").glob("*.svg"))
        self.assertTrue(any("effective_restitution" in chart.name for chart in charts))
        for chart in charts:
            xml.etree.ElementTree.parse(chart)
            self.assertTrue(chart.with_suffix(".gp").exists())

    def test_studies_stand_on_the_same_page(self):
        scene = SCENES / "symmetric-30cms.yaml"
        common = ["--engines", "bullet", "--profiles", "default,tuned", "--precisions", "double", "--rates", "240,1000",
                  "--phases", "2"]
        precision, stability = self.path / "precision", self.path / "stability"
        self.assertEqual(run("precision", scene, *common, "--iterations", "50", "--repeats", "1",
                             "--out", precision).returncode, 0)
        self.assertEqual(run("stability", scene, *common, "--out", stability).returncode, 1)
        page = self.path / "page.html"
        result = run("report", self.runs, precision, stability, "-o", page, "--svg",
                     self.path / "svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        data = page_data(page)
        study = json.loads((precision / "precision.json").read_text())["scenes"][0]["curves"]
        self.assertEqual([scene["name"] for scene in data["precision"]], ["symmetric-30cms"])
        work = data["precision"][0]["charts"][0]["panels"][0]
        shown = {curve["label"]: curve["x"] for curve in work["curves"]}
        for curve in study:
            if curve["kind"] == "engine" and not curve.get("iterations"):
                self.assertEqual(shown[curve["method"]],
                                 [float(f"{point['cost']['cpu_per_simulated_second']:.6g}")
                                  for point in curve["points"]])
        text = page.read_text()
        self.assertIn("Error against run time", text)
        self.assertIn("Where it gets stiff", text)
        self.assertTrue(list((self.path / "svg").glob("precision-*.svg")))

    def test_what_cannot_be_read_is_told_and_nothing_is_written(self):
        page = self.path / "page.html"
        empty = self.path / "empty"
        empty.mkdir()
        broken = self.path / "broken.json"
        broken.write_text("{\n  \"schema\": \n")
        newer = self.path / "newer.json"
        newer.write_text('{"schema": "slipcheck-result/2"}')
        wrong = self.path / "wrong.json"
        text = (self.runs / "symmetric-30cms.json").read_text()
        wrong.write_text(text.replace('"rate": 240.0', '"rate": "fast"', 1))
        for source, said in ((self.path / "nowhere", "nowhere"), (empty, "holds no result"),
                             (broken, "broken.json"), (newer, "slipcheck-result/2"),
                             (wrong, '"fast"')):
            result = run("report", source, "-o", page)
            self.assertEqual(result.returncode, 2, (source, result.stderr))
            self.assertIn(said, result.stderr)
            self.assertFalse(page.exists())
        twice = run("report", self.runs, self.runs, "-o", page)
        self.assertEqual(twice.returncode, 2)
        self.assertIn("the scene roll-to-rest is in", twice.stderr)
        self.assertEqual(run("report", self.runs).returncode, 2)
        self.assertEqual(run("report", self.runs, "-o", self.path / "no" / "p.html").returncode, 2)

    def test_without_gnuplot_it_says_so_and_leaves_no_chart(self):
        nothing = self.path / "nothing"
        nothing.mkdir()
        result = run("report", self.runs, "-o", self.path / "p.html", "--svg", self.path / "svg",
                     env=dict(os.environ, PATH=str(nothing)))
        self.assertEqual(result.returncode, 4)
        self.assertIn("gnuplot", result.stderr)
        self.assertFalse(list(self.path.glob("svg/*")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
