#!/usr/bin/env python3
"""Draws all figures once and holds their numbers against closed forms derived here.

usage: figures_test.py SLIPCHECK
"""
import csv
import math
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from random import Random

SLIPCHECK = sys.argv[1]
NAMES = ["K5", "K6", "K7", "K8", "K9", "K10", "K11", "collision-course", "slide-course",
         "spin-exchange", "rolling-restitution", "rolling-gas", "B1", "B2",
         "L2", "L3", "L4", "L5", "L6", "L7", "L8", "L9", "L10", "L11", "L12", "L13",
         "box-energy-ratio", "soft-box-convergence"]
SVG = "{http://www.w3.org/2000/svg}"

# Kondic's spheres, in SI: A = m R²/I, friction, gravity, restitution, radius, duration of the
# collision at v_rel = 10 cm/s.
A, MU_S, MU_K, G, E_N, R, T_COL = 2.5, 0.5, 0.1, 9.81, 0.9, 2e-3, 2.55e-5
GAMMA = -2 * math.log(E_N) / T_COL
OMEGA0 = math.hypot(math.pi / T_COL, GAMMA / 2)
C = math.pi * A * (GAMMA / 2) / (2 * OMEGA0)
SHARE = (1 - math.exp(-2 * C)) / 2
V_I = 10.0  # cm/s, of the asymmetric collisions


def t_col(v):
    """In s at v_rel in cm/s: App. B, in proportion to v^(−1/5)."""
    return T_COL * (v / 10)**-0.2


def free_contact(e, v):
    """ω0, ω and γ_N of the collision at v_rel [cm/s]."""
    gamma = -2 * math.log(e) / t_col(v)
    omega = math.pi / t_col(v)
    return math.hypot(omega, gamma / 2), omega, gamma


def slid(v_m, v_p, c):
    """t^s [s], s [cm], ΔE [cm²/s²], Δp [cm/s] of sphere i: half the sum of both speeds stays, the
    difference turns round by e_n, its surface keeps v_i less c of the sum; then it slides."""
    v_i, v_j = (v_p + v_m) / 2, (v_p - v_m) / 2
    after = (v_i + v_j) / 2 - E_N * (v_i - v_j) / 2
    slip = after - (v_i - c * v_p)
    time = abs(slip) / (100 * (1 + A) * MU_K * G)
    rolling = after - math.copysign(100 * MU_K * G * time, slip)
    return time, (after + rolling) / 2 * time, after**2 - rolling**2, after - rolling


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name) / "new" / "figures"
        cls.result = subprocess.run([SLIPCHECK, "figures", cls.path], capture_output=True, text=True,
                                    timeout=880)
        cls.tables = {}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def table(self, name):
        """Columns by header; None for what is not finite."""
        if name not in self.tables:
            with open(self.path / f"{name}.csv", newline="", encoding="utf-8") as file:
                header, *rows = csv.reader(file)
            self.assertEqual(len(set(header)), len(header))
            for row in rows:
                self.assertEqual(len(row), len(header))
            self.tables[name] = {
                title: [float(row[k]) if row[k] else None for row in rows]
                for k, title in enumerate(header)}
        return self.tables[name]

    def rows(self, name, *columns):
        table = self.table(name)
        return zip(*(table[column] for column in columns))

    def test_files(self):
        self.assertEqual(self.result.returncode, 0)
        # Nothing but how far it is, which a slow machine says every half minute.
        self.assertRegex(self.result.stderr, r"\A(drawing \d+/\d+  \d+ (s|min)(, about [^\n]* left)?\n)*\Z")
        self.assertEqual(self.result.stdout, f"{self.path}/index.html\n")
        self.assertEqual({file.name for file in self.path.iterdir()},
                         {f"{name}.{kind}" for name in NAMES for kind in ("svg", "csv")}
                         | {"index.html", "stated.csv", "figures.md"})

    def test_svg_is_well_formed_and_complete_in_itself(self):
        for name in NAMES:
            text = (self.path / f"{name}.svg").read_text()
            root = ElementTree.fromstring(text)
            self.assertEqual(root.tag, SVG + "svg")
            self.assertEqual(root.get("viewBox"), f"0 0 {root.get('width')} {root.get('height')}")
            for tag in ("title", "desc"):
                self.assertGreater(len(root.findtext(SVG + tag)), 10, name)
            ids = [element.get("id") for element in root.iter() if element.get("id")]
            self.assertEqual(len(set(ids)), len(ids))
            self.assertTrue(all(each.startswith(name + "-") for each in ids))
            for element in root.iter():
                for key, value in element.attrib.items():
                    self.assertNotRegex(value, r"(?i)\b(nan|inf)\b", f"{name} {key}")
                self.assertNotIn(element.tag, (SVG + "script", SVG + "image", SVG + "style"))
            self.assertFalse(set(re.findall(r"https?://[^\"]*", text))
                             - {SVG[1:-1], "http://www.w3.org/1999/xlink"})
            # Labels with units, and something drawn in every panel.
            texts = ["".join(element.itertext()) for element in root.iter(SVG + "text")]
            self.assertTrue(any("[" in text for text in texts), name)
            drawn = [group for group in root.iter(SVG + "g") if "_plot_" in group.get("id", "")
                     if any(group.find(".//" + SVG + tag) is not None
                            for tag in ("path", "use", "polygon"))]
            self.assertGreater(len(drawn), 1, name)

    def test_asymmetric_figures_show_every_way_to_reckon_the_spins(self):
        for name in ("spin-exchange", "rolling-restitution"):
            text = "".join(ElementTree.parse(self.path / f"{name}.svg").getroot().itertext())
            for label in ("C = 0", f"first order, C = {C:.3f}", f"= {SHARE:.3f}", "Coulomb",
                          "held on the plane", "free to jump"):
                self.assertIn(label, text)

    def test_page_holds_all_figures(self):
        text = (self.path / "index.html").read_text()
        root = ElementTree.fromstring(text)
        self.assertEqual(len(list(root.iter("svg"))), len(NAMES))
        ids = [element.get("id") for element in root.iter() if element.get("id")]
        self.assertEqual(len(set(ids)), len(ids))
        for link in (element.get("href") for element in root.iter("a")):
            if link.startswith("#"):
                self.assertIn(link[1:], ids)
            else:
                self.assertTrue((self.path / link).exists(), link)
        self.assertEqual(len(list(root.iter("figcaption"))), len(NAMES))
        self.assertIn("Nothing is tuned", text)

    def test_every_column_has_its_unit_and_numbers(self):
        for name in NAMES:
            for title, values in self.table(name).items():
                self.assertRegex(title, r" \[[^\]]+\]$")
                self.assertTrue(any(value is not None for value in values), title)

    def statement(self, figure, start):
        """The one of the figure that begins so; its numbers and whether it agrees."""
        with open(self.path / "stated.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file)
                    if row["figure"] == figure and row["claim"].startswith(start)]
        self.assertEqual(len(rows), 1, (figure, start))
        return {key: float(rows[0][key]) if rows[0][key] else None
                for key in ("low", "high", "measured", "error")} | {"agrees": rows[0]["agrees"]}

    def assert_stated(self, figure, start, expected, relative, agrees):
        """Measured is what the test derives, to the part of it that is left out there."""
        row = self.statement(figure, start)
        self.assertTrue(math.isclose(row["measured"], expected, rel_tol=relative), (start, row))
        self.assertEqual(row["agrees"], agrees, (start, row))

    def test_every_statement_is_judged_by_its_own_numbers(self):
        with open(self.path / "stated.csv", newline="", encoding="utf-8") as file:
            header, *rows = csv.reader(file)
        self.assertEqual(header, ["figure", "claim", "stated", "low", "high", "measured", "error",
                                  "agrees", "remark"])
        self.assertGreater(len(rows), 60)
        for row in rows:
            self.assertEqual(len(row), len(header))
            figure, claim, stated, low, high, measured, error, agrees, remark = row
            self.assertIn(figure, NAMES)
            self.assertTrue(claim and stated)
            self.assertIn(agrees, ("yes", "no"))
            low = float(low) if low else -math.inf
            high = float(high) if high else math.inf
            self.assertTrue(low <= high and float(error) >= 0, row)
            inside = measured and low <= float(measured) + float(error) and \
                float(measured) - float(error) <= high
            self.assertEqual(agrees, "yes" if inside else "no", row)
            self.assertTrue(agrees == "yes" or remark, row)  # why not
        self.assertEqual(len({(row[0], row[1]) for row in rows}), len(rows))

    def test_page_of_statements_has_them_all(self):
        text = (self.path / "figures.md").read_text()
        self.assertEqual([line[3:].split(":")[0] for line in text.splitlines()
                          if line.startswith("## ")], NAMES)
        with open(self.path / "stated.csv", newline="", encoding="utf-8") as file:
            self.assertEqual(sum(text.count(f"| {word} |") for word in ("yes", "no")),
                             len(list(csv.reader(file))) - 1)

    def test_k5_compression(self):
        for e in (1, 0.9, 0.8, 0.7):
            for v, closed, printed in self.rows(
                    "K5", "v_rel [cm/s]", f"x_max closed form e_n = {e:g} [-]",
                    f"x_max of (39) as printed e_n = {e:g} [-]"):
                # x = (v/(2R ω)) e^(−γt/2) sin ωt is deepest at tan ωt = 2ω/γ.
                omega0, omega, gamma = free_contact(e, v)
                t = math.atan2(2 * omega, gamma) / omega
                deepest = v / 100 / (2 * R * omega) * math.exp(-gamma / 2 * t) * math.sin(omega * t)
                self.assertTrue(math.isclose(closed, deepest, rel_tol=1e-9), (e, v))
                first = v / 100 / (2 * R * omega0) * (1 - math.pi / 2 * gamma / omega0)
                self.assertTrue(math.isclose(printed, first, rel_tol=1e-9), (e, v))
            for v, seen, residual in self.rows(
                    "K5", "v_rel of points [cm/s]", f"x_max reference e_n = {e:g} [-]",
                    f"x_max residual e_n = {e:g} [-]"):
                if v is None:
                    continue
                # App. D: the substrate's friction presses them together, 2 μ_k g/(v ω0) of it.
                omega0, _, _ = free_contact(e, v)
                self.assertAlmostEqual(residual / seen, 0,
                                       delta=1.1 * 2 * MU_K * G / (v / 100 * omega0))
        for v, seen, time in self.rows("K5", "v_rel of points [cm/s]", "x_min reference e_n = 1 [-]",
                                       "t_min reference e_n = 1 [s]"):
            if v is None:
                continue
            # F_N = m R ω0² x is then (1+A) μ_s m g, of spheres that come at v to (ω0 t)²/6.
            omega0, _, _ = free_contact(1, v)
            onset = (1 + A) * MU_S * G / (R * omega0**2)
            self.assertTrue(math.isclose(seen, onset, rel_tol=1e-6), v)
            t_min = 2 * R * onset / (v / 100)
            self.assertTrue(math.isclose(time, t_min, rel_tol=(omega0 * t_min)**2), v)

    def test_k5_statements(self):
        omega0, _, gamma = free_contact(1, 10)
        left_out = 0.01  # App. D at 10 cm/s: 0.0016
        self.assert_stated("K5", "x_max^0", 0.1 / (2 * R * omega0), left_out, "yes")
        damped0, _, gamma = free_contact(E_N, 10)
        self.assert_stated("K5", "x_max/x_max^0", 1 - math.pi / 4 * gamma / damped0,
                           (gamma / damped0)**2, "no")
        self.assert_stated("K5", "power of v_rel in x_max", 0.8, 0.005, "yes")
        # In diameters (1+A) μ_s g/(R ω0²), twice what is printed, and 2R/v_rel times that in time.
        onset = (1 + A) * MU_S * G / (R * omega0**2)
        self.assert_stated("K5", "x_min^0 at", onset, 1e-3, "no")
        self.assert_stated("K5", "power of v_rel in x_min^0", -0.4, 1e-3, "yes")
        self.assert_stated("K5", "t_min^0 at", 2 * R * onset / 0.1, 1e-3, "yes")
        self.assert_stated("K5", "t_min^0/t_col", 2 * R * onset / 0.1 / T_COL, 1e-3, "no")
        self.assert_stated("K5", "v^b", 2 * R * onset * omega0 * 100, 1e-3, "yes")
        self.assert_stated("K5", "v^c", 2 * (1 + A) * MU_S * G / gamma * 100, 1e-9, "no")
        self.assert_stated("K5", "E_ps/E_col", 4 * MU_S * G / (omega0 * 0.1), left_out, "yes")
        # Hertz: t_c = 2.9432 (m_eff/k)^(2/5) v^(−1/5), k = (4/5)(4/3) E* √R_eff, R_eff = R/2.
        modulus = 2.06e11 / (2 * (1 - 0.28**2))
        mass = 7850 * 4 / 3 * math.pi * R**3
        for speed, claim in ((0.1, "t_col at 10 cm/s"), (1, "t_col at 100 cm/s")):
            time = 2.9432 * (mass / 2 / (0.8 * 4 / 3 * modulus * math.sqrt(R / 2)))**0.4 * speed**-0.2
            self.assert_stated("K5", claim, time, 1e-4, "no")
        self.assert_stated("K5", "power of v_0 in t_col", -0.2, 1e-6, "yes")
        self.assert_stated("K5", "power of R in t_col", 1, 1e-6, "yes")

    def test_k6_meets_the_closed_forms_to_t_col_over_t_s(self):
        for v, t, t_closed, s, s_closed in self.rows(
                "K6", "v_rel [cm/s]", "t^s reference [s]", "t^s closed form [s]",
                "s reference [cm]", "s closed form [cm]"):
            slide = (1 + E_N) * v / 100 / (2 * (1 + A) * MU_K * G)
            way = (v / 100)**2 * (1 + E_N) * (E_N - 1 + 2 * E_N * A) / (
                8 * MU_K * G * (1 + A)**2) * 100
            self.assertTrue(math.isclose(t_closed, slide, rel_tol=1e-10))
            self.assertTrue(math.isclose(s_closed, way, rel_tol=1e-10))
            self.assertTrue(math.isclose(t, slide, rel_tol=t_col(v) / slide), v)
            self.assertTrue(math.isclose(s, way, rel_tol=t_col(v) / slide), v)
        self.assertEqual(min(self.table("K6")["v_rel [cm/s]"]), 1)
        self.assertEqual(max(self.table("K6")["v_rel [cm/s]"]), 100)
        slide, way, _, _ = slid(-10, 0, 0)
        left_out = T_COL / slide
        self.assert_stated("K6", "t^s", slide, left_out, "yes")
        self.assert_stated("K6", "s at", way, left_out, "yes")
        self.assert_stated("K6", "|v^s|/v^0", (A * E_N - 1) / (1 + A), 2 * left_out, "yes")
        self.assert_stated("K6", "e_n below", 1 / A, 5 * left_out, "yes")

    def test_k7_losses(self):
        def losses(e):
            """Of v² and v of each: by the slide, which ends at (Ae − 1)/(1 + A), and before it."""
            end = (A * e - 1) / (1 + A)
            return e**2 - end**2, e - end, 1 - e**2, 1 - e

        columns = ("dE_slip", "dp_slip", "dE_col/dE_slip", "dp_col/dp_slip")
        # What the substrate does during the collision: g t_col/v_rel = 0.0025 of the speeds.
        left_out = 2 * G * T_COL / 0.1
        for kind, at, tolerance in (("closed form", "e_n [-]", 1e-9),
                                    ("reference", "e_n of points [-]", left_out)):
            for e, *values in self.rows("K7", at, *(f"{name} {kind} [-]" for name in columns)):
                if e is None:
                    continue
                energy, momentum, collision, parting = losses(e)
                for value, expected in zip(values, (energy, momentum, collision / energy,
                                                    parting / momentum)):
                    self.assertAlmostEqual(value, expected, delta=tolerance * (1 + expected))
        self.assert_stated("K7", "ΔE_slip for", 40 / 49, left_out, "yes")
        self.assert_stated("K7", "Δp_slip for", 4 / 7, left_out, "yes")
        # (47) = 1 at ((1+A)² + 1)/((1+A)² + 1 + 2A), (49) = 1 at A/(2+A).
        self.assert_stated("K7", "e_n at which collision", 53 / 73, left_out, "yes")
        self.assert_stated("K7", "e_n at which they", 5 / 9, left_out, "yes")

    def test_k8_to_k11_closed_forms_and_integrated_spheres(self):
        names = (("K8", "t^s", "s"), ("K9", "|s|", "cm"), ("K10", "ΔE", "cm²/s²"),
                 ("K11", "Δp", "cm/s"))
        for k, (figure, symbol, unit) in enumerate(names):
            drawn = 0
            for v_m, v_p, value in self.rows(figure, "v_m [cm/s]", "v_p [cm/s]",
                                             f"{symbol} closed form [{unit}]"):
                if value is None:
                    self.assertGreater(abs(v_p), 2 * abs(v_m))
                    continue
                expected = slid(v_m, v_p, C)[k]
                self.assertAlmostEqual(value, abs(expected) if k == 1 else expected,
                                       delta=1e-9 * v_m**2)
                drawn += 1
            self.assertGreater(drawn, 1000)
        points = {}
        for figure, symbol, unit in names:
            for v_m, v_p, value in self.rows(figure, "v_m of points [cm/s]", "v_p of points [cm/s]",
                                             f"{symbol} reference [{unit}]"):
                if v_m is not None:
                    points.setdefault((v_m, v_p), []).append(value)
        self.assertGreater(len(points), 30)
        epsilon = GAMMA / OMEGA0
        for (v_m, v_p), (time, way, energy, momentum) in points.items():
            slip = 100 * (1 + A) * MU_K * G * time
            # As in spin-exchange; Coulomb's cap takes O(ε²) of the sum, App. E.
            most = 1.01 * (1 + A) * MU_K * (100 * G * t_col(-v_m) + SHARE * abs(v_p) / A)
            self.assertAlmostEqual(slip, -(1 + E_N) / 2 * v_m + SHARE * v_p,
                                   delta=most + epsilon**2 * abs(v_p))
            # What a slide is, whatever came before, to the integration's 1e-9.
            self.assertAlmostEqual(momentum, slip / (1 + A), delta=1e-6)
            self.assertAlmostEqual(way, abs(energy) * time / (2 * momentum), delta=1e-6)

    def test_k8_to_k11_statements(self):
        # The extreme sphere's slip is ½(1+e) ± c of |v_m|, c from 0.1 to C: 2c/(1+e).
        for figure, claim, agrees in (("K8", "change of t^s", "yes"), ("K11", "change of Δp", "yes")):
            self.assert_stated(figure, claim, 2 * SHARE / (1 + E_N), 0.15, agrees)
        for figure, claim, index in (("K9", "change of s", 1), ("K10", "change of ΔE", 2)):
            change = max(abs(slid(-10, v_p, SHARE)[index] / slid(-10, 0, 0)[index] - 1)
                         for v_p in (-10, 10))
            self.assert_stated(figure, claim, change, 0.05, "yes")
        self.assert_stated("K9", "v_i/v_j for which s_i = 0, elastic", -6, 0.01, "yes")
        # Where the slide ends at −v^f, i.e. 2(1+A) v^f = u: v_p [(1+A) − c] = v_m [e(1+A) − ½(1+e)].
        share = (E_N * (1 + A) - (1 + E_N) / 2) / ((1 + A) - SHARE)
        ratio = (share + 1) / (share - 1)
        self.assert_stated("K9", "v_i/v_j for which s_i = 0, e_n", ratio, 0.02, "no")
        self.assert_stated("K10", "the same by (62)", slid(-10, 10, SHARE)[2], 0.02, "no")
        pair = sum(slid(-10, v_p, SHARE)[2] for v_p in (-10, 10)) / 100
        self.assert_stated("K10", "ΔE of both", pair, 0.03, "no")
        smooth = sum(slid(-10, v_p, 0)[2] for v_p in (-10, 10)) / 100
        self.assert_stated("K10", "what the rubbing adds", pair - smooth, 0.2, "no")
        self.assert_stated("K10", "loss of a symmetric", 2, 0.005, "yes")
        for start in ("Δp over", "the same, symmetric", "the same, i at rest"):
            self.assert_stated("K11", start, 1, G * T_COL / 0.1, "yes")

    def test_collision_course_free_contact_and_onset_of_sliding(self):
        rows = list(self.rows("collision-course", "t/t_col [-]", "overlap reference [µm]", "v_i reference [cm/s]",
                              "RΩ_i reference [cm/s]"))
        omega = math.pi / T_COL
        # App. D: the substrate's friction presses the spheres together with a = 2 μ_k g. To the
        # overlap it adds (a/ω0²)(1 − cos ω0 t), to v_i up to a/(2 ω0), to R Ω_i −A μ_k g t.
        for share, overlap, v, surface in rows:
            t = share * T_COL
            if share < 1:
                decay = math.exp(-GAMMA / 2 * t)
                free = 0.1 / omega * decay * math.sin(omega * t) / 1e-6
                rate = 10 * decay * (math.cos(omega * t) - GAMMA / 2 / omega * math.sin(omega * t))
            else:
                free, rate = 0, -E_N * 10
            self.assertAlmostEqual(overlap, free, delta=4 * MU_K * G / OMEGA0**2 / 1e-6)
            self.assertAlmostEqual(v, rate / 2, delta=1.1 * MU_K * G / OMEGA0 * 100)
            self.assertAlmostEqual(surface, 5 - 100 * A * MU_K * G * t, delta=1e-9)
        # t_min = 2 (1+A) μ_s g/(v_rel ω0²), e_n = 1: 22.6 ns, between two of the points.
        t_min = 2 * (1 + A) * MU_S * G / (0.1 * (math.pi / T_COL)**2) * 1e9
        self.assertAlmostEqual(t_min, 22.6, delta=0.05)
        for t, slip in self.rows("collision-course", "t [ns]", "u_i reference e_n = 1 [cm/s]"):
            if t < t_min:
                self.assertAlmostEqual(slip, 0, delta=1e-12)
            else:
                self.assertLess(slip, -1e-7)

    def test_slide_course_slides_for_its_time_and_rolls_on(self):
        slide = (1 + E_N) * 0.1 / (2 * (1 + A) * MU_K * G) * 1e3
        e_eff = (A * E_N - 1) / (1 + A)
        # t_col/t^s of the speed: the closed forms take the collision as an instant.
        tolerance = 5 * T_COL * 1e3 / slide
        for t, v, slip in self.rows("slide-course", "t [ms]", "v_i reference [cm/s]", "u_i reference [cm/s]"):
            if t < 0:
                self.assertAlmostEqual(v, 5, delta=1e-9)
                self.assertAlmostEqual(slip, 0, delta=1e-9)
            elif t > slide + 1e3 * T_COL:
                self.assertAlmostEqual(v, -5 * e_eff, delta=tolerance)
                self.assertAlmostEqual(slip, 0, delta=1e-9)
            else:
                self.assertAlmostEqual(slip, -(1 + E_N) * 5 * (1 - t / slide), delta=tolerance)

    def test_spin_exchange_slip_by_each_spin_exchange_and_the_integrated_one(self):
        for body, sign in (("i", -1), ("j", 1)):
            for ratio, none, first, exponential, cap, held, free in self.rows(
                    "spin-exchange", "v_j/v_i [-]", *(f"u^f_{body} {way} [cm/s]" for way in (
                        "C = 0", "first order", "exponential", "with cap", "reference held",
                        "reference free"))):
                smooth = sign * (1 + E_N) / 2 * V_I * (1 - ratio)
                turned = V_I * (1 + ratio)
                self.assertAlmostEqual(none, smooth, delta=1e-9)
                self.assertAlmostEqual(first, smooth + C * turned, delta=1e-9)
                self.assertAlmostEqual(exponential, smooth + SHARE * turned, delta=1e-9)
                # C takes π/ω0 for t_col, which is longer by γ_N²/(8 ω0²) of itself.
                longer = (GAMMA / OMEGA0)**2 / 8 * SHARE * turned
                self.assertLessEqual(cap, exponential + 1.01 * longer)
                # The substrate's friction in the collision, on weight and rubbing: at most
                # (1+A) μ_k (g t_col + ∫F_R dt/m) with ∫F_R dt = SHARE turned m/A. Tenfold
                # second order, 1 %.
                most = 1.01 * (1 + A) * MU_K * (100 * G * t_col(V_I * (1 - ratio)) + SHARE * turned / A)
                self.assertAlmostEqual(held, cap, delta=most)
                self.assertAlmostEqual(free, cap, delta=most)
        # Between "with the cap" and nothing: what physics-notes.md measures for a target at rest.
        table = self.table("spin-exchange")
        at_rest = min(range(len(table["v_j/v_i [-]"])), key=lambda n: abs(table["v_j/v_i [-]"][n]))
        self.assertAlmostEqual(table["c_i with cap [-]"][at_rest], 0.113, delta=0.0015)

    def test_rolling_restitution_effective_restitution(self):
        expected = (A * E_N - 1) / (1 + A)
        for ratio, closed, pressed, free in self.rows(
                "rolling-restitution", "v_j/v_i [-]", "e_eff closed form [-]",
                "e_eff with friction on the pressed sphere [-]", "e_eff reference free [-]"):
            self.assertAlmostEqual(closed, expected, delta=1e-11)
            if ratio <= 0.5:
                # Second order of the friction, a tenth of the first, and t_col/t^s.
                slide = (1 + E_N) * V_I / 100 * (1 - ratio) / (2 * (1 + A) * MU_K * G)
                self.assertAlmostEqual(free, pressed,
                                       delta=0.1 * (pressed - closed)
                                       + t_col(V_I * (1 - ratio)) / slide)

    def test_rolling_gas(self):
        isolated = (A * E_N - 1) / (1 + A)
        points = list(self.rows("rolling-gas", "area fraction [-]", "l/s [-]", "e_eff [-]",
                                "e_eff standard error [-]", "e right after the collision [-]"))
        self.assertGreater(len(points), 15)
        for fraction, ratio, effective, error, after in points:
            self.assertAlmostEqual(after, E_N, delta=1e-9)
            # Between both limits, but for the scatter.
            self.assertGreater(effective, isolated - 4 * error)
            self.assertLess(effective, E_N)
            if ratio < 0.1:  # the next collision comes before a tenth of the slide
                self.assertGreater(effective, E_N - 0.02)
            if ratio > 25 and fraction < 0.1:  # few are interrupted: 5 % of them, by at most e_n
                self.assertLess(effective, isolated + 0.05 + 4 * error)
        # One curve for all densities: near l = s, where it is straight over ln(l/s) but for its
        # curvature, a line through all points leaves each within its error. What curvature and
        # the range of l/s within one point add is small beside the 0.54 between both limits.
        middle = [(math.log(r), e, err) for _, r, e, err, _ in points if 0.5 < r < 2.5]
        self.assertGreaterEqual(len(middle), 4)
        x_mean = sum(x for x, _, _ in middle) / len(middle)
        e_mean = sum(e for _, e, _ in middle) / len(middle)
        slope = (sum((x - x_mean) * (e - e_mean) for x, e, _ in middle)
                 / sum((x - x_mean)**2 for x, _, _ in middle))
        self.assertLess(slope, 0)
        for x, effective, error in middle:
            self.assertAlmostEqual(effective, e_mean + slope * (x - x_mean),
                                   delta=0.05 * (E_N - isolated) + 3 * error)

    @staticmethod
    def viscous_restitution(damping, compact):
        """ẍ = −(x + Dẋ)^(3/2), B (25), until the force ends, or −√x (x + (3/2) Dẋ), (24), until the
        overlap does; from x = 0, ẋ = 1."""
        def rate(x, w):
            if compact:
                return w, -max(x + damping * w, 0.0)**1.5
            return w, -math.sqrt(max(x, 0.0)) * (x + 1.5 * damping * w)

        x, w, h = 0.0, 1.0, 4e-3
        while True:
            a = rate(x, w)
            b = rate(x + h / 2 * a[0], w + h / 2 * a[1])
            c = rate(x + h / 2 * b[0], w + h / 2 * b[1])
            d = rate(x + h * c[0], w + h * c[1])
            x += h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
            w += h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
            if w < 0 and (x + damping * w <= 0 if compact else x <= 0):
                return -w

    @staticmethod
    def ice_damping(time, speed, pair=False):
        """A/T of ice with R = 1 cm at v [cm/s], with L = v T and T⁻² = (ρ/m_eff) √L."""
        radius = 0.01
        mass = 1000 * 4 / 3 * math.pi * radius**3
        stiffness = 2 * 1e10 * math.sqrt(radius) / (3 * (1 - 0.3**2)) / mass
        if pair:
            stiffness *= math.sqrt(2)  # √R_eff falls by √2, m_eff by 2
        return time * (stiffness * math.sqrt(speed / 100))**0.4

    def test_b1_power_law_fit_and_series(self):
        speeds = self.table("B1")["v [cm/s]"]
        data = self.table("B1")["eps^N power law [-]"]
        curve = self.table("B1")["eps^N (24) even in v [-]"]
        measured = [k for k, value in enumerate(data) if value is not None]
        self.assertAlmostEqual(speeds[measured[0]], 0.015, delta=1e-9)
        self.assertAlmostEqual(speeds[measured[-1]], 5, delta=1e-9)
        for k in measured:
            self.assertTrue(math.isclose(data[k], 0.32 * speeds[k]**-0.234, rel_tol=1e-9))
        # 1 − ε in proportion to v^(1/5) at small dissipation, to the second order x ~ 1e-2.
        slope = (math.log((1 - curve[1]) / (1 - curve[0])) / math.log(speeds[1] / speeds[0]))
        self.assertAlmostEqual(slope, 0.2, delta=0.2 * (1 - curve[1]))
        for k, second in enumerate(self.table("B1")["eps^N series second order [-]"]):
            # The next term of the series is of the order x³.
            if 1 - curve[k] < 0.1:
                self.assertAlmostEqual(curve[k], second, delta=(1 - curve[k])**3)

    def test_b1_curves_are_those_of_an_independent_integration(self):
        speeds = self.table("B1")["v [cm/s]"]
        for law in ("(25)", "(24)"):
            compact = law == "(25)"
            time, pair_time = self.table("B1")[f"A of {law} wall, pair [s]"][:2]
            curve = self.table("B1")[f"eps^N {law} even in v [-]"]
            for wanted in (0.05, 1.0, 5.0):
                k = min(range(len(speeds)), key=lambda n: abs(math.log(speeds[n] / wanted)))
                found = self.viscous_restitution(self.ice_damping(time, speeds[k]), compact)
                # One step of 4e-3 at the end, where the force is next to nothing.
                self.assertAlmostEqual(curve[k], found, delta=1e-3)
                again = self.viscous_restitution(self.ice_damping(pair_time, speeds[k], True), compact)
                self.assertAlmostEqual(again, found, delta=1e-3)

            # No A nearby follows the measurement better, evenly over 0.015 to 5 cm/s.
            def misses(factor):
                sum_of_squares = 0
                for n in range(41):
                    v = 0.015 + (5 - 0.015) * n / 40
                    damping = self.ice_damping(factor * time, v)
                    sum_of_squares += (self.viscous_restitution(damping, compact)
                                       - 0.32 * v**-0.234)**2
                return sum_of_squares

            self.assertLess(misses(1), min(misses(0.95), misses(1.05)))

    def test_b1_statements(self):
        # (25) loses a third at 0.015 cm/s: 1 − ε ∝ v^(1/5) cannot follow v^−0.234 there.
        self.assertEqual(self.statement("B1", "largest deviation")["agrees"], "no")
        self.assertEqual(self.statement("B1", "greatest rise")["agrees"], "yes")
        # 2 ∫ dx/√(1 − x^(5/2)) from 0 to 1, (4/5) B(2/5, 1/2).
        beta = math.gamma(0.4) * math.gamma(0.5) / math.gamma(0.9)
        self.assert_stated("B1", "t_c", 0.8 * beta, 1e-6, "yes")

    def test_b2_slides_at_small_normal_speed(self):
        table = self.table("B2")
        points = list(zip(table["g_N [cm/s]"], table["g_T [cm/s]"]))
        corner = min(points, key=lambda point: (point[0], -point[1]))  # slow g_N, fast g_T
        for size, friction in (("1e-07 R_eff", math.sqrt(5e-4)),
                               ("1e-07 R_eff in cm", math.sqrt(5e-8))):
            seen = dict(zip(points, table[f"eps^T {size} [-]"]))
            sliding = dict(zip(points, table[f"eps^T sliding limit {size} [-]"]))
            # Hundreds of asperities break: half of μ F_N to 2 %; ε^N of slow ice is 0.5 to 1.
            most = 0.5 * friction * 2 * 3.5 * corner[0] / corner[1]
            self.assertTrue(0.7 * most < 1 - sliding[corner] < most)
            self.assertAlmostEqual(seen[corner], sliding[corner], delta=0.02 * most)
        for column in table:
            if "passive" in column:
                for value in table[column]:
                    self.assertTrue(value is None or abs(value) <= 1 + 1e-6)

    def bent(self, relative, g_n, g_t):
        """ε^T and the deepest bend [m] of an asperity that never breaks, speeds in cm/s: B (25), (35),
        (37) written out in SI, by small steps of the fourth order."""
        time = self.table("B1")["A of (25) wall, pair [s]"][1]
        mass = 1000 * 4 / 3 * math.pi * 0.01**3 / 2
        modulus = 2 * 1e10 * math.sqrt(0.005) / (3 * (1 - 0.3**2))
        size = relative * 0.005
        friction = math.sqrt(size / 1e-6)

        def rate(x, w, bend, slip):
            normal = modulus * max(x + time * w, 0.0)**1.5
            return w, -normal / mass, slip, -friction * normal * bend / size / (2 / 7 * mass)

        state, h, deepest = (0.0, g_n / 100, 0.0, g_t / 100), 2e-8, 0
        while state[1] > 0 or state[0] + time * state[1] > 0:
            a = rate(*state)
            b = rate(*(y + h / 2 * dy for y, dy in zip(state, a)))
            c = rate(*(y + h / 2 * dy for y, dy in zip(state, b)))
            d = rate(*(y + h * dy for y, dy in zip(state, c)))
            state = tuple(y + h / 6 * (p + 2 * q + 2 * r + t)
                          for y, p, q, r, t in zip(state, a, b, c, d))
            deepest = max(deepest, abs(state[2]))
        return state[3] / (g_t / 100), deepest

    def test_b2_bend_that_does_not_break_is_that_of_an_independent_integration(self):
        table = self.table("B2")
        points = list(zip(table["g_N [cm/s]"], table["g_T [cm/s]"]))
        for relative in (2e-4, 1e-3):
            for wanted in ((2, 0.4), (4, 0.4), (10, 0.6)):
                k = min(range(len(points)), key=lambda n: math.dist(points[n], wanted))
                self.assertLess(math.dist(points[k], wanted), 1e-9)
                turned, deepest = self.bent(relative, *wanted)
                self.assertLess(deepest, relative * 0.005)
                self.assertAlmostEqual(table[f"eps^T {relative:g} R_eff [-]"][k], turned, delta=2e-4)

    def test_b2_asperities_break_where_the_bend_is_their_size(self):
        expected = {}
        for relative in (2e-4, 1e-3):
            for g_n, seen in self.rows("B2", "g_N of g_T_cr [cm/s]",
                                       f"g_T_cr {relative:g} R_eff [cm/s]"):
                if g_n is None:
                    continue
                # Linear in g^T. The program looks every 1.5 %; what breaks at the very end, where
                # F_N vanishes, changes ε^T only a little further on.
                expected[relative, g_n] = 0.1 * relative * 0.005 / self.bent(relative, g_n, 0.1)[1]
                self.assertTrue(0.999 < seen / expected[relative, g_n] < 1.03, (relative, g_n))
        speeds = (0.5, 1, 2, 5, 10)
        for relative, panel in ((2e-4, "(b)"), (1e-3, "(c)")):
            grows = all(expected[relative, a] < expected[relative, b]
                        for a, b in zip(speeds, speeds[1:]))
            self.assertEqual(self.statement("B2", panel + ": least power")["agrees"],
                             "yes" if grows else "no")

    def test_b2_statements(self):
        for start, agrees in (("(a)-(c)", "yes"), ("(a): least ε^T, μ by cm", "yes"),
                              ("(b): share", "yes"), ("(c): share", "yes"),
                              ("(b), (c): least", "yes"), ("(c): least ε^T", "yes")):
            self.assertEqual(self.statement("B2", start)["agrees"], agrees, start)
        # μ = 0.022: sliding with half of it, at g^N/g^T = 50 half of 50 · 0.022 · 3.5 · (1 + ε^N)/2.
        self.assertEqual(self.statement("B2", "(a): least ε^T, μ by µm")["agrees"], "no")
        # Smooth: what sliding with half of μ = 2.2e-4 takes.
        self.assert_stated("B2", "ε^T of the smoothest", 1 - 0.5 * math.sqrt(5e-8) * 1.5 * 3.5, 2e-3,
                           "no")

    def stated(self, figure):
        """What the paper says of a figure, by claim; None for what is not finite."""
        with open(self.path / "stated.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["figure"] == figure]
        for row in rows:
            for key in ("low", "high", "measured", "error"):
                row[key] = float(row[key]) if row[key] else None
        self.assertEqual(len({row["claim"] for row in rows}), len(rows))
        return {row["claim"]: row for row in rows}

    def test_l_statements_agree_but_where_the_paper_contradicts_itself_or_the_run(self):
        # Figs. 4 and 5: digits that contradict the paper's own formula. Fig. 7: the factor 2 is of
        # both V in the text, where an independent program has 3.2 ± 0.1 at 1.57 m/s; what it says
        # of 40 Hz, K/R as with the others and K/H above 2g, no run shows.
        no = {
            "L4": {"how many of the 24 slide"},
            "L5": {"−tan γ0 with μ = 0.5"},
            "L7": {"H at μ = 0 over that at μ = 20, V = 1.57 m/s, f = 100 Hz [-]",
                   "K/R over (15), mean over the runs with V = 0.314 m/s, f = 40 Hz [-]",
                   "largest K/R over smallest at one μ, for all V and f [-]",
                   "largest K/H over 2g, V = 0.314 m/s, f = 40 Hz [-]"}}
        for number in range(2, 14):
            rows = self.stated(f"L{number}")
            self.assertGreater(len(rows), 0)
            self.assertEqual({claim for claim, row in rows.items() if row["agrees"] == "no"},
                             no.get(f"L{number}", set()))

    def test_l2_slides_or_sticks(self):
        # Rounding of the 50 mm coordinates turns the 1 mm line of centres by 1e-14, and more the
        # more grazing the spheres meet.
        for mu, beta in ((0.1, 0.4), (0.25, 0.4), (0.25, 0)):
            of = f"mu = {mu:g}, beta0 = {beta:g}"
            for before, angle, after, restitution in self.rows(
                    "L2", "Psi_1 [-]", "gamma [rad]", f"Psi_2 event driven {of} [-]",
                    f"beta event driven {of} [-]"):
                sliding = before - 3.5 * 1.9 * mu
                self.assertAlmostEqual(after, max(sliding, -beta * before), delta=1e-11)
                if before > 0:
                    self.assertAlmostEqual(math.tan(angle), -before, delta=1e-9)
                    coulomb = -1 - 3.5 * mu * 1.9 / math.tan(angle)
                    self.assertAlmostEqual(restitution, min(beta, coulomb), delta=1e-9)

    def test_l3_l4_wall(self):
        # Of a solid sphere, R = 0.5 mm, per mass: P_n = (1+e) v_n; sticking wants
        # P_t = (1+β0) v_t/(1 + 1/q), which Coulomb caps; ω = P_t/(q R).
        radius, q, v_n = 0.5e-3, 0.4, 0.5
        for name, sets in (("L3", [(f"mu = {mu:g}", mu, 0.5) for mu in (0.2, 0.5, 10000)]),
                           ("L4", [(f"beta0 = {beta:g}", 0.5, beta) for beta in (-0.5, 0, 0.5)])):
            for of, mu, beta in sets:
                for v_t, psi, slip, spin in self.rows(
                        name, "v_t [m/s]", "Psi_1 [-]", f"Psi_2 {of} [-]", f"omega {of} [rad/s]"):
                    impulse = min((1 + beta) * v_t / (1 + 1 / q), mu * 1.9 * v_n)
                    self.assertAlmostEqual(psi, v_t / v_n, delta=1e-12)
                    self.assertAlmostEqual(spin, impulse / (q * radius), delta=1e-8)
                    after = (v_t - impulse - radius * spin) / v_n
                    self.assertAlmostEqual(slip, after, delta=1e-9)
        self.assertAlmostEqual(max(self.table("L3")["omega mu = 0.2 [rad/s]"]), 950, delta=1e-8)
        for claim, printed in (("−0.5", 6.65), ("0", 3.325), ("0.5", 2.2167)):
            row = self.stated("L4")[f"−tan γ0 with β0 = {claim.replace('−', '-')}"]
            self.assertAlmostEqual(row["measured"], printed, delta=5e-5)

    def test_l5_l6_pairs(self):
        # As above with the reduced mass ½: each sphere gets P_t, and both spins count.
        radius, q = 0.5e-3, 0.4
        for name, sets in (("L5", [(f"mu = {mu:g}", 0.9, mu) for mu in (0, 0.2, 0.5)]),
                           ("L6", [(f"e = {e:g}", e, 0.2) for e in (0.2, 0.6, 0.99)])):
            for of, e, mu in sets:
                for offset, psi, slip, spin, away in self.rows(
                        name, "b_0/d [-]", "Psi_1 [-]", f"Psi_2 {of} [-]", f"omega {of} [rad/s]",
                        f"speed of separation {of} [m/s]"):
                    u_n, u_t = math.sqrt(1 - offset**2), offset
                    impulse = min(0.5 * 1.5 * u_t / (1 + 1 / q), mu * 0.5 * (1 + e) * u_n)
                    self.assertAlmostEqual(psi, u_t / u_n, delta=1e-11)
                    self.assertAlmostEqual(spin, impulse / (q * radius), delta=1e-8)
                    after = (u_t - 2 * impulse - 2 * radius * spin) / u_n
                    self.assertAlmostEqual(slip, after, delta=1e-9)
                    self.assertAlmostEqual(away, e * u_n, delta=1e-11)
        self.assertAlmostEqual(self.stated("L5")["−tan γ0 with μ = 0.5"]["measured"], 2.2167,
                               delta=5e-5)

    def test_l7_l8_l9_energies(self):
        for name, column, law in (
                ("L7", "mu [-]", lambda mu: (5 + 1 / mu) / 1.5 if mu > 0 else None),
                ("L8", "beta0 [-]", lambda beta: 10 / (1 + beta) if beta > -1 else None),
                ("L9", "q [-]", lambda q: 2 / q + 4)):
            for value, by_15 in self.rows(name, column, "K/R (15) [-]"):
                expected = law(value)
                if expected is None:
                    self.assertIsNone(by_15)
                else:
                    self.assertAlmostEqual(by_15, expected, delta=1e-9 * expected)
            for title, values in self.table(name).items():
                if title.startswith("K/R V"):
                    for by_15, ratio, error in self.rows(name, "K/R (15) [-]", title,
                                                         f"standard error of {title}"):
                        if by_15 is None:
                            self.assertIsNone(ratio)
                        else:  # the paper: low by 1.3 ± 0.2 in the mean; single ones 0.9 to 2
                            self.assertTrue(0.85 < (ratio + 3 * error) / by_15, (title, by_15))
                            self.assertTrue((ratio - 3 * error) / by_15 < 2.2, (title, by_15))
                if title.startswith("H V"):
                    self.assertTrue(all(value > 0 for value in values))

    def test_l7_is_that_of_an_independent_program(self):
        """A program written apart from this one, of 50 spheres with the same parameters, gave
        139.7 ± 4.9 mm without friction and 43.9 ± 1.1 mm with μ = 20, V = 1.57 m/s."""
        rows = {mu: (height, error) for mu, height, error in self.rows(
            "L7", "mu [-]", "H V = 1.57 f = 100 [mm]", "standard error of H V = 1.57 f = 100 [mm]")}
        for mu, height, error in ((0, 139.7, 4.9), (20, 43.9, 1.1)):
            self.assertAlmostEqual(rows[mu][0], height, delta=4 * math.hypot(error, rows[mu][1]))

    def test_box_energy_ratio(self):
        for mu, beta, q, smooth, error, rough, by_15, chaos, sticking in self.rows(
                "box-energy-ratio", "mu [-]", "beta0 [-]", "q [-]", "K/R smooth walls [-]",
                "standard error of K/R smooth walls [-]", "K/R rough walls [-]", "K/R (15) [-]",
                "K/R molecular chaos [-]", "K/R molecular chaos, all stick [-]"):
            printed = (2 / q + 1 / mu) / (1 + beta)
            limit = 2 / q * (1 + 2 * q - beta) / (1 + beta)
            self.assertAlmostEqual(by_15, printed, delta=1e-9 * printed)
            self.assertAlmostEqual(sticking, limit, delta=1e-9 * limit)
            # Slip at β0 = 0 only lengthens the way to equal energies: with sticking it is
            # shortest, to the quadrature's 1e-3.
            if beta == 0:
                self.assertGreater(chaos, limit * 0.999)
            # Correlations and unequal temperatures of both directions, which the mean field
            # leaves out, are of the order 1 − e = 0.1.
            self.assertAlmostEqual(smooth, chaos, delta=0.1 * chaos + 3 * error)
            # The paper finds (15) low by 1.3 ± 0.2; over these wider ranges 0.92 to 1.62.
            self.assertTrue(0.85 < smooth / by_15 < 1.75, (mu, beta, q))
            self.assertTrue(0.85 < rough / by_15 < 1.75, (mu, beta, q))

    def test_molecular_chaos_keeps_the_spins(self):
        """Two spheres with Maxwellian velocities and spins at the K/R of the table, in proportion
        to their approach: L (5)-(12) written out for both leaves the sum of their spins' squares
        where it is, to four standard errors of the sampling."""
        random = Random(1995)
        e = 0.9
        for mu, beta, q, ratio in self.rows("box-energy-ratio", "mu [-]", "beta0 [-]", "q [-]",
                                            "K/R molecular chaos [-]"):
            spin = math.sqrt(2 / (q * ratio))  # R ω, where each component of v has deviation 1
            gains, weights = [], []
            for _ in range(10000):
                approach = random.gauss(0, 1) - random.gauss(0, 1)
                first, second = random.gauss(0, spin), random.gauss(0, spin)
                slip = random.gauss(0, 1) - random.gauss(0, 1) - first - second
                normal = 0.5 * (1 + e) * abs(approach)
                most = 0.5 * q / (1 + q) * (1 + beta) * abs(slip)
                impulse = -math.copysign(min(most, mu * normal), slip)  # per mass
                turn = -impulse / q
                gains.append((first + turn)**2 + (second + turn)**2 - first**2 - second**2)
                weights.append(abs(approach))
            total = sum(w * g for w, g in zip(weights, gains))
            error = math.sqrt(sum((w * g)**2 for w, g in zip(weights, gains)))
            self.assertLess(abs(total), 4 * error, (mu, beta, q))

    @staticmethod
    def slope(x, y):
        """Of ln y over ln x by least squares, with its error from the scatter."""
        x, y = [math.log(v) for v in x], [math.log(v) for v in y]
        x_mean, y_mean = sum(x) / len(x), sum(y) / len(y)
        squares = sum((a - x_mean)**2 for a in x)
        slope = sum((a - x_mean) * (b - y_mean) for a, b in zip(x, y)) / squares
        rest = sum((b - y_mean - slope * (a - x_mean))**2 for a, b in zip(x, y))
        return slope, math.sqrt(rest / (len(x) - 2) / squares)

    def test_l10_l11_l12_exponents(self):
        """Least squares of ln H, all alike, as L's: those of the table are found again, and are
        the paper's to the 0.10 by which its own δ of one kind scatter."""
        for name, curve, least, most, column, printed in (
                ("L10", "(1) mu = 0 N = 50", 1, 10, "delta from 1 m/s", 2),
                ("L10", "(2) mu = 0.2 N = 50", 1, 10, "delta from 1 m/s", 2),
                ("L10", "(3) mu = 0.2 N = 150", 1, 10, "delta from 1 m/s", 2),
                ("L10", "(4) mu = 0.2 N = 250", 1, 10, "delta from 1 m/s", 2),
                ("L11", "(1) e_w = 1 mu_w = 0", 1, 10, "delta from 1 m/s", 2),
                ("L11", "(1) e_w = 1 mu_w = 0", 0.12, 1, "delta to 1 m/s", 1.5),
                ("L11", "(2) e_w = 0.9 mu_w = 0", 0.12, 10, "delta", 1.5),
                ("L12", "(1) moving mu_w = 0.2", 0.12, 10, "delta", 1.33),
                ("L12", "(2) moving mu_w = 0.5", 0.12, 10, "delta", 1.33)):
            table = self.table(name)
            points = [(v, h) for v, h in zip(table["V [m/s]"], table[f"H {curve} [mm]"])
                      if 0.999 * least < v < 1.001 * most]
            slope, error = self.slope(*zip(*points))
            self.assertAlmostEqual(table[f"{column} {curve} [-]"][0], slope, delta=1e-9)
            self.assertAlmostEqual(table[f"standard error of {column} {curve} [-]"][0], error,
                                   delta=1e-9)
            self.assertAlmostEqual(slope, printed, delta=0.1, msg=f"{name} {curve}")
        table = self.table("L12")
        self.assertAlmostEqual(table["delta of both [-]"][0], 1.33,
                               delta=0.005 + 2 * table["standard error of delta of both [-]"][0])
        # Curve (1) of L11 is (2) of L10, and (3) of L12 that of L11: the same boxes.
        self.assertEqual(self.table("L11")["H (1) e_w = 1 mu_w = 0 [mm]"],
                         self.table("L10")["H (2) mu = 0.2 N = 50 [mm]"])
        self.assertEqual(table["H (3) at rest mu_w = 0.2 [mm]"],
                         self.table("L11")["H (3) e_w = 0.9 mu_w = 0.2 [mm]"])

    def test_l13_both_tables_of_exponents(self):
        table = self.table("L13")
        self.assertEqual(table["delta of L [-]"], [1.72, 1.66, 1.57, 1.45])
        self.assertEqual(table["nu of L [-]"], [0.60, 0.71, 0.81, 0.91])
        self.assertEqual(table["delta of the experiment [-]"], [1.239, 1.310, 1.326, 1.022])
        self.assertEqual(table["nu of the experiment [-]"], [0.140, 0.172, 0.396, 0.350])
        for speed, amplitude in zip(table["V [m/s]"], table["A0 [mm]"]):
            self.assertAlmostEqual(speed, 2 * math.pi * 50 * amplitude * 1e-3, delta=1e-9)
        heights = [table[f"H at A0 = {a:g} mm [mm]"] for a in table["A0 [mm]"]]  # by A0, N
        for n, (delta, printed) in enumerate(zip(table["delta [-]"], table["delta of L [-]"])):
            slope, error = self.slope(table["V [m/s]"], [column[n] for column in heights])
            self.assertAlmostEqual(delta, slope, delta=1e-9)
            self.assertAlmostEqual(table["standard error of delta [-]"][n], error, delta=1e-9)
            self.assertAlmostEqual(delta, printed, delta=0.10)  # the paper's 1.60 ± 0.10
        for k, (nu, printed) in enumerate(zip(table["nu [-]"], table["nu of L [-]"])):
            slope, error = self.slope([1 / n for n in table["N [-]"]], heights[k])
            self.assertAlmostEqual(nu, slope, delta=1e-9)
            self.assertAlmostEqual(nu, printed, delta=0.10)

    def test_contacts_come_near_collisions(self):
        table = self.table("soft-box-convergence")
        # The next order is Δv beside speeds of 0.35 m/s: 1 to 2 % over the first decade.
        times = table["t_col of trajectories [s]"]
        for column, values in table.items():
            if "apart" in column:
                slope = math.log(values[3] / values[0]) / math.log(times[3] / times[0])
                self.assertAlmostEqual(slope, 1, delta=0.01, msg=column)
        # Means of chaotic runs: 4 standard errors of their difference.
        for name, unit in (("H", "mm"), ("K", "µJ"), ("R", "nJ")):
            for time, *seen in self.rows(
                    "soft-box-convergence", "t_col of averages [s]", f"{name} contact [{unit}]",
                    f"standard error of {name} contact [{unit}]", f"{name} event driven [{unit}]",
                    f"standard error of {name} event driven [{unit}]"):
                if time is None:
                    continue
                off = (seen[0] - seen[2]) / math.hypot(seen[1], seen[3])
                if time <= 1e-4:
                    self.assertLess(abs(off), 4, (name, time))
                if time > 1e-3:
                    self.assertGreater(-off if name == "R" else off, 4, (name, time))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
