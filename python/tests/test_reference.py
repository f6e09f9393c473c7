"""The compiled reference against closed forms worked out here, and against the program."""
import math
import os
import unittest
from pathlib import Path

import numpy
import slipcheck

try:
    from slipcheck import physics
except ImportError as missing:
    raise unittest.SkipTest(str(missing))

SOURCE = Path(os.environ["SLIPCHECK_SOURCE"])
SCENES = SOURCE / "scenarios"
E_EFF = "i-j.effective_restitution"


def head_on(restitution=0.9, **more):
    """Two rolling steel balls on one line, as a dict."""
    ball = {"material": "steel", "sphere": {"radius": "2 mm"}, "spin": "rolling"}
    return {"slipcheck": 1, "name": "head-on", "title": "Two balls meet", "gravity": 9.81, "materials": {"steel": {"density": 7850}},
            "contacts": [{"between": ["steel", "steel"], "normal": {"model": "hard", "restitution": restitution},
                          "tangential": {"model": "none"}},
                         {"between": ["steel", "substrate"], "friction": {"static": 0.5, "kinetic": 0.1}}],
            "substrate": {}, "run": {"until": "rolling", "limit": 5}, "compare": {"engines": []},
            "bodies": [{"name": "i", "position": [-0.0095, 0], "velocity": [0.15, 0], **ball},
                       {"name": "j", "position": [0.0095, 0], "velocity": [-0.15, 0], **ball}], **more}


class OneScene(unittest.TestCase):
    def test_arrays_and_solution(self):
        scene = slipcheck.Scene(head_on())
        self.assertEqual((scene.name, scene.bodies, scene.solver), ("head-on", ["i", "j"], "event"))
        numpy.testing.assert_allclose(scene.mass, 7850 * 4 / 3 * math.pi * 0.002 ** 3, rtol=1e-14)
        numpy.testing.assert_array_equal(scene.velocity, [[0.15, 0, 0], [-0.15, 0, 0]])
        numpy.testing.assert_allclose(scene.angular_velocity, [[0, 75, 0], [0, -75, 0]], rtol=1e-14)
        solution = scene.solve()
        e_eff = (2.5 * 0.9 - 1) / 3.5
        self.assertAlmostEqual(solution[E_EFF], e_eff, 14)
        self.assertLess(solution.observables[E_EFF].uncertainty, 1e-14)
        self.assertAlmostEqual(solution.closed_form[E_EFF], e_eff, 14)
        self.assertTrue(solution.reached)
        self.assertEqual(solution.collisions, 1)
        self.assertAlmostEqual(solution.first_contact, (0.019 - 0.004) / 0.3, 14)

    def test_is_the_program_s_answer_to_the_last_bit(self):
        for name in ("symmetric-30cms", "oblique", "slope-rolls", "hertz-10cms"):
            file = SCENES / f"{name}.yaml"
            found = slipcheck.Scene(file).solve().observables
            told = slipcheck.run(file, engines="bullet", rates=240, phases=1, precision="double").reference()
            told = told[~told.value.isna()].set_index("observable")
            self.assertEqual({name: value.value for name, value in found.items()}, dict(told.value))
            self.assertEqual({name: value.uncertainty for name, value in found.items()}, dict(told.uncertainty))

    def test_trajectory(self):
        scene = slipcheck.Scene(head_on())
        motion = scene.trajectory([0, 0.02, 0.05, 0.2])
        self.assertEqual(motion.position.dims, ("time", "body", "axis"))
        x = motion.position.sel(body="i", axis="x").values
        # It rolls at 0.15 m/s until the centres are 4 mm apart, after 0.05 s.
        numpy.testing.assert_allclose(x[:3], [-0.0095, -0.0065, -0.002], rtol=1e-12)
        self.assertAlmostEqual(motion.velocity.sel(body="i", axis="x").values[3], -0.15 * (2.5 * 0.9 - 1) / 3.5, 13)
        for times, rule in (([-1.0], "must be >= 0"), ([1, 1], "must rise"), ([math.nan], "must be finite"),
                            ([[1.0]], r"must have the shape \(n\), got \(1, 1\)")):
            with self.assertRaisesRegex(ValueError, "times: " + rule):
                scene.trajectory(times)

    def test_faults_have_place_rule_and_value(self):
        bad = head_on()
        bad["bodies"][1]["sphere"] = {"radius": "-2 mm"}
        bad["gravty"] = 3
        with self.assertRaises(slipcheck.SceneError) as refused:
            slipcheck.Scene(bad)
        faults = {fault["key"]: fault for fault in refused.exception.faults}
        self.assertIn("must be > 0", faults["bodies[1].sphere.radius"]["rule"])
        self.assertIn("-2 mm", faults["bodies[1].sphere.radius"]["value"])
        self.assertIn("gravty", str(refused.exception))
        self.assertIsInstance(refused.exception, ValueError)
        with self.assertRaises(slipcheck.SceneError):
            slipcheck.Scene("/nonexistent.yaml")
        with self.assertRaises(slipcheck.SceneError) as refused:
            slipcheck.Scene.parse("slipcheck: 1\nname: [", "here.yaml")
        self.assertIn("here.yaml", str(refused.exception))

    def test_time_limit_is_a_failed_run_or_an_error(self):
        scene = slipcheck.Scene(SCENES / "box-rough-moving-walls.yaml")
        solution = scene.solve(time_limit=1e-3)
        self.assertTrue(solution.failed)
        self.assertIn("time limit", solution.reason)
        with self.assertRaisesRegex(ValueError, "time_limit: must be > 0"):
            scene.solve(time_limit=0)


class ManyRuns(unittest.TestCase):
    def test_map_over_speeds_is_the_closed_form(self):
        scene = slipcheck.Scene(head_on())
        rng = numpy.random.default_rng(1)
        speeds = rng.uniform(0.01, 1, (500, 2)) * [1, -1]
        velocity = numpy.zeros((500, 2, 3))
        velocity[:, :, 0] = speeds
        found = scene.solve_many([E_EFF, "i.rolling_velocity.x", "i.sliding_time"], velocity=velocity, angular_velocity="rolling")
        self.assertTrue(found.reached.all())
        numpy.testing.assert_allclose(found[E_EFF], (2.5 * 0.9 - 1) / 3.5, rtol=1e-11)
        v_i, v_j = speeds.T
        after = 0.5 * ((1 - 0.9) * v_i + (1 + 0.9) * v_j)  # K, with R Omega = v_i kept
        numpy.testing.assert_allclose(found["i.rolling_velocity.x"], after + (v_i - after) / 3.5, rtol=1e-11, atol=1e-14)
        numpy.testing.assert_allclose(found["i.rolling_velocity.x"], physics.head_on_rolling_velocity(v_i, v_j, 0.9), rtol=1e-11,
                                      atol=1e-14)
        numpy.testing.assert_allclose(found["i.sliding_time"], abs(v_i - after) / (3.5 * 0.1 * 9.81), rtol=1e-11)

    def test_each_is_the_scene_s_own_answer(self):
        scene = slipcheck.Scene(SCENES / "oblique.yaml")
        names = sorted(scene.solve().observables)
        found = scene.solve_many(names, position=numpy.stack([scene.position] * 3))
        for name in names:
            self.assertEqual(list(found[name].values), [scene.solve()[name]] * 3)

    def test_what_does_not_happen_is_nan(self):
        scene = slipcheck.Scene(head_on())
        found = scene.solve_many([E_EFF, "i.nonsense"], velocity=[[[-0.1, 0, 0], [0.1, 0, 0]], [[0.1, 0, 0], [-0.1, 0, 0]]],
                                 angular_velocity="rolling")
        self.assertTrue(math.isnan(found[E_EFF][0]))
        self.assertAlmostEqual(found[E_EFF][1].item(), (2.5 * 0.9 - 1) / 3.5, 12)
        self.assertTrue(numpy.isnan(found["i.nonsense"]).all())

    def test_bad_states_are_refused(self):
        scene = slipcheck.Scene(head_on())
        for more, rule in (({"velocity": numpy.zeros((2, 3, 3))}, r"states: must broadcast to \(n, 2, 3\)"),
                           ({"velocity": numpy.full((4, 2, 3), math.inf)}, "velocity: must be finite, got inf"),
                           ({"position": numpy.full((4, 2, 3), 0.002)}, "position: spheres must not overlap, got 0.0"),
                           ({"position": [[0, 0, 0.001], [1, 0, 0.002]]}, "position: z must be the radius or more, got 0.001"),
                           ({"angular_velocity": "sliding"}, "must be an array or 'rolling'")):
            with self.assertRaisesRegex(ValueError, rule):
                scene.solve_many([E_EFF], **more)

    def test_many_answers_are_those_of_the_closed_form(self):
        scene = slipcheck.Scene(head_on())
        count = 100_000
        velocity = numpy.zeros((count, 2, 3))
        velocity[:, 0, 0] = numpy.linspace(0.05, 0.5, count)
        velocity[:, 1, 0] = -velocity[:, 0, 0]
        found = scene.solve_many([E_EFF], velocity=velocity, angular_velocity="rolling")
        numpy.testing.assert_allclose(found[E_EFF], (2.5 * 0.9 - 1) / 3.5, rtol=1e-11)


class Impacts(unittest.TestCase):
    def test_hard_rule(self):
        scene = head_on()
        scene["contacts"][0]["tangential"] = {"model": "hard", "friction": 0.2, "tangential_restitution": 0.5}
        made = slipcheck.Scene(scene)
        g_n = numpy.array([0.1, 0.1])
        g_t = numpy.array([1e-4, 1.0])
        hit = made.collide("i", "j", g_n, g_t)
        numpy.testing.assert_allclose(hit.normal_restitution, 0.9)
        # L (5)-(12): u_t' = -b0 u_t where it sticks, else u_t - mu (1 + e) g_n/kappa with kappa = 2/7.
        numpy.testing.assert_allclose(hit.tangential_restitution, [-0.5, 1 - 0.2 * 1.9 * 0.1 / (2 / 7)], rtol=1e-13)
        m = made.mass[0] / 2
        numpy.testing.assert_allclose(hit.energy_change, 0.5 * m * g_n ** 2 * (0.81 - 1) +
                                      0.5 * m * 2 / 7 * g_t ** 2 * (hit.tangential_restitution ** 2 - 1), rtol=1e-12)

    def test_linear_contact_has_its_restitution_and_duration(self):
        scene = head_on()
        scene["contacts"][0]["normal"] = {"model": "linear", "restitution": 0.8, "collision_time": "0.1 ms"}
        made = slipcheck.Scene(scene)
        hit = made.collide("i", "j", numpy.linspace(0.01, 1, 50), 0.05, steps=400)
        # Second order in the step: (pi/400)^2/12 is 5e-6.
        numpy.testing.assert_allclose(hit.normal_restitution, 0.8, rtol=1e-4)
        numpy.testing.assert_allclose(hit.duration, 1e-4, rtol=1e-4)
        for arguments, rule in ((("i", "j", [-1.0]), "speeds: must be > 0"), (("i", "i", [1.0]), "must be two")):
            with self.assertRaisesRegex(ValueError, rule):
                made.collide(*arguments)
        with self.assertRaises(KeyError):
            made.collide("i", "k", [1.0])


class Laws(unittest.TestCase):
    def test_forces_broadcast(self):
        xi = numpy.linspace(0, 1e-5, 5)
        rate = numpy.array([[0.1], [-0.1]])
        force = physics.linear_force(xi, rate, 1e6, 3.0)
        self.assertEqual(force.shape, (2, 5))
        numpy.testing.assert_allclose(force, 1e6 * xi + 3 * rate, rtol=1e-14)
        numpy.testing.assert_allclose(physics.hertz_force(xi, 1e9), 1e9 * xi ** 1.5, rtol=1e-14)
        numpy.testing.assert_allclose(physics.power_force(xi, 0.1, 2e9, 40.0, 1.5, 0.5), 2e9 * xi ** 1.5 + 4 * xi ** 0.5, rtol=1e-13)
        numpy.testing.assert_allclose(physics.viscoelastic_force(xi, 0.1, 1e9, 1e-6),
                                      1e9 * (xi ** 1.5 + 1.5e-7 * xi ** 0.5), rtol=1e-13)
        numpy.testing.assert_allclose(physics.compact_viscoelastic_force(xi, 0.1, 1e9, 1e-6), 1e9 * (xi + 1e-7) ** 1.5, rtol=1e-13)
        self.assertIsInstance(physics.hertz_force(1e-5, 1e9), float)
        numpy.testing.assert_allclose(physics.viscous_friction([-0.1, 5], 2.0, 3.0, 0.5), [0.3, 1.0], rtol=1e-14)

    def test_laws_over_speed(self):
        g = numpy.array([1e-4, 0.01, 1.0])
        numpy.testing.assert_allclose(physics.power_law_restitution(g), numpy.minimum(1, 0.32 * (g / 0.01) ** -0.234), rtol=1e-14)
        numpy.testing.assert_allclose(physics.exponential_friction(g, 9.951e-3, 0.108, 1.088),
                                      9.951e-3 + 0.108 * numpy.exp(-1.088 * g), rtol=1e-14)

    def test_pairs(self):
        self.assertAlmostEqual(physics.effective_mass(1.0, 3.0), 0.75, 15)
        # m g^2/2 = (2/5) rho xi^(5/2), and 2.9432 xi/g (B A13).
        overlap = (5 / 4 * 0.1 * 0.3 ** 2 / 1e9) ** 0.4
        self.assertAlmostEqual(physics.hertz_largest_overlap(0.1, 1e9, 0.3) / overlap, 1, 14)
        exact = 2 * math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9)  # 2 ∫ dx / √(1 - x^5/2) over [0, 1]
        self.assertAlmostEqual(physics.hertz_duration(0.1, 1e9, 0.3) * 0.3 / overlap, exact, 12)
        # exp(-gamma t/2) with t = pi/sqrt(k/m - gamma^2/4).
        t = math.pi / math.sqrt(1e5 / 0.1 - 50 ** 2 / 4)
        self.assertAlmostEqual(physics.linear_restitution(0.1, 1e5, 50.0), math.exp(-25 * t), 14)

    def test_head_on_and_slide(self):
        e = numpy.linspace(0, 1, 11)
        numpy.testing.assert_allclose(physics.effective_restitution(e), (2.5 * e - 1) / 3.5, rtol=1e-14)
        numpy.testing.assert_allclose(physics.head_on_velocity_after(0.15, -0.15, e), -0.15 * e, atol=1e-16)
        # A ball that is thrown without spin: 5/7 v, v/(3.5 mu g), and the way (v + 5/7 v) t/2.
        slide = physics.slide_to_roll([[1.0, 0, 0], [0, 2.0, 0]], numpy.zeros((2, 3)), 0.03, 0.2)
        numpy.testing.assert_allclose(slide["rolling_velocity"], [[5 / 7, 0, 0], [0, 10 / 7, 0]], rtol=1e-14, atol=1e-16)
        t = numpy.array([1, 2]) / (3.5 * 0.2 * 9.81)
        numpy.testing.assert_allclose(slide["sliding_time"], t, rtol=1e-14)
        numpy.testing.assert_allclose(slide["sliding_distance"], numpy.array([1, 2]) * (12 / 7) * t / 2, rtol=1e-14)
        # u^f = (1 + e) v, half of v_rel = 2v: s of K (44) is that of the slide from v^f = -e v with R Omega = v.
        v, e_n = 0.15, 0.9
        struck = physics.slide_to_roll([[-e_n * v, 0, 0]], [[0, v / 0.002, 0]], 0.002, 0.1)
        self.assertAlmostEqual(physics.symmetric_sliding_distance(2 * v, e_n, 0.1), struck["sliding_distance"][0], 15)
        for more, rule in (({"radius": 0.0}, "radius: must be > 0"), ({"kinetic_friction": -1.0}, "kinetic_friction: must be > 0")):
            with self.assertRaisesRegex(ValueError, rule):
                physics.slide_to_roll([[1.0, 0, 0]], [[0, 0, 0]], **{"radius": 0.1, "kinetic_friction": 0.1, **more})


if __name__ == "__main__":
    unittest.main()
