"""Sweeps and objectives of the Python package: shapes, failing points, the shared cache, interruption."""
import pathlib
import tempfile
import unittest

import numpy as np
import vibrocontact as vc

ROLLING = vc.Case.from_file(vc.EXAMPLES / "half_space_rolling.prm", {"Contact/Grid spacing": 2e-3})
# a body with a reduction
BAR = vc.Case.from_file(vc.EXAMPLES / "bouncing_bar.prm", {"Transient/Time step": 4e-3})


def utilisation(results):
    return results.analyses.quasi_static_rolling.cases[0].utilisation


class Sweeps(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(dir=".")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name).absolute()

    def test_grid_has_the_numbers_of_single_runs(self):
        ended = []
        values = {"Contact/Friction coefficient": [0.2, 0.4], "Rolling/Lateral creepage": [5e-4, 1e-3, 2e-3]}
        study = vc.sweep(ROLLING, values, self.folder, check=False, on_point=ended.append)
        self.assertEqual((study.shape, len(study), len(ended), study.failed), ((2, 3), 6, 6, []))
        numbers = study.collect(utilisation)
        self.assertEqual(numbers.shape, (2, 3))
        self.assertEqual(study.collect(lambda results: results.analyses.quasi_static_rolling.cases[0].tangential_force_N).shape, (2, 3, 2))
        np.testing.assert_array_equal(study.values("Contact/Friction coefficient"), [[0.2] * 3, [0.4] * 3])
        alone = ROLLING.with_entries({"Contact/Friction coefficient": 0.4, "Rolling/Lateral creepage": 5e-4, "Output/Figures": False})
        self.assertEqual(utilisation(alone.run(self.folder / "alone")), numbers[1, 0])

    def test_wrong_point_is_said_before_the_first_is_computed(self):
        values = {"Contact/Friction coefficient": [0.2, -1]}
        with self.assertRaisesRegex(vc.InputError, "number from 0 to 10"):
            vc.sweep(ROLLING, values, self.folder)
        self.assertFalse((self.folder / "0").exists())
        study = vc.sweep(ROLLING, values, self.folder, check=False)
        self.assertIsInstance(study.failed[0].error, vc.InputError)
        numbers = study.collect(utilisation)
        self.assertTrue(numbers[0] > 0 and np.isnan(numbers[1]))

    def test_point_that_does_not_converge_leaves_the_others_alone(self):
        points = [{"Contact/Solver/Max Newton iterations": 1}, {"Contact/Solver/Max Newton iterations": 60}]
        study = vc.sweep(ROLLING, points, self.folder, check=False, jobs=1)
        self.assertIsInstance(study[0].error, vc.NotConverged)
        self.assertIsNotNone(study[0].results)
        self.assertTrue(study[1].results.converged)

    def test_reductions_are_made_once(self):
        study = vc.sweep(BAR, {"Transient/Initial velocity": [-5, -10, -20]}, self.folder, check=False)
        found = ["bar: modes found in the cache" in point.results.log for point in study]
        self.assertEqual(found, [False, True, True])
        # m v twice: speed by speed
        impulses = study.collect(lambda results: results.analyses.transient.impulse_Ns)
        np.testing.assert_allclose(impulses[1:], [200, 400], rtol=0.02)

    def test_exception_of_the_caller_stops_all(self):
        def enough(point):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            vc.sweep(ROLLING, {"Contact/Friction coefficient": [0.1, 0.2, 0.3]}, self.folder, check=False, on_point=enough)
        self.assertFalse((self.folder / "2").exists())
        study = vc.sweep(ROLLING, {"Contact/Friction coefficient": [0.1, 0.2, 0.3]}, self.folder, check=False, resume=True)
        self.assertEqual(study.failed, [])

    def test_objective(self):
        # the creepage whose utilisation is 0.5, by the secant method
        objective = vc.Objective(ROLLING, ["Rolling/Lateral creepage"], lambda results: utilisation(results) - 0.5, self.folder / "fit")
        one, two = 5e-4, 1e-3
        while abs(objective(two)) > 1e-4 and len(objective.history) < 8:
            one, two = two, two - objective(two) * (two - one) / (objective(two) - objective(one))
        self.assertLess(abs(objective(two)), 1e-4)
        self.assertEqual(len({numbers for numbers, _ in objective.history}), len(objective.history))
        with self.assertRaises(ValueError):
            objective([1, 2])
        bounded = vc.Objective(ROLLING, ["Contact/Friction coefficient"], utilisation, self.folder / "bounded", instead=1e9)
        self.assertEqual(bounded(-1), 1e9)
        with self.assertRaises(vc.InputError):
            vc.Objective(ROLLING, ["Contact/Friction coefficient"], utilisation, self.folder / "strict")(-1)


if __name__ == "__main__":
    unittest.main()
