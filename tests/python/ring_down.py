"""Ring-downs of the Python package: frequency and damping over amplitude against a damped oscillator's, whose middle is not zero."""
import pathlib
import unittest

import numpy as np
import vibrocontact as vc


class Oscillator(unittest.TestCase):
    def test_closed_form(self):
        zeta, omega = 0.03, 2 * np.pi * 200
        damped = omega * np.sqrt(1 - zeta**2)
        time = np.arange(0, 0.05, 1e-5)
        decay = np.exp(-zeta * omega * time)
        # let go at rest
        place = 0.4 + decay * (np.cos(damped * time) + zeta * omega / damped * np.sin(damped * time))
        speed = -decay * omega**2 / damped * np.sin(damped * time)
        times, places = vc.turning_points(time, place, speed)
        self.assertEqual(times[0], 0)
        np.testing.assert_allclose(times, np.arange(len(times)) * np.pi / damped, atol=1e-8)
        motion = vc.ring_down(times, places)
        np.testing.assert_allclose(motion.frequency_Hz, damped / (2 * np.pi), rtol=2e-6)
        np.testing.assert_allclose(motion.damping_ratio[1:-1], zeta, rtol=1e-4)
        self.assertTrue(np.isnan(motion.damping_ratio[[0, -1]]).all())
        half = np.pi * zeta / np.sqrt(1 - zeta**2)
        np.testing.assert_allclose(motion.amplitude_m, (1 + np.exp(-half)) / 2 * np.exp(-half * np.arange(len(times) - 1)), rtol=1e-5)

    def test_samples_at_rest(self):
        # sampled where it turns
        time = np.arange(0, 13, 0.5)
        times, places = vc.turning_points(time, np.cos(np.pi / 2 * time), -np.pi / 2 * np.sin(np.round(time * 2) * np.pi / 4) * (np.round(time * 2) % 4 != 0))
        np.testing.assert_allclose(times, np.arange(0, 13, 2), atol=1e-12)
        np.testing.assert_allclose(places, (-1.) ** np.arange(7), atol=1e-12)

    def test_nothing_turns(self):
        times, places = vc.turning_points([0, 1, 2], [0, 1, 2], [1, 1, 1])
        self.assertEqual(len(times), 0)
        self.assertEqual(len(vc.ring_down([0, 1], [0, 1]).amplitude_m), 1)
        self.assertEqual(len(vc.ring_down(times, places).amplitude_m), 0)

    def test_figure(self):
        joint = vc.Case.from_file(vc.EXAMPLES / "lap_joint.prm", {"Transient/Time step": 1e-5, "Transient/End time": 0.009, "Transient/History interval": 1e-5,
                                                                 "Loading/Steps": 20, "Output/Figures": False, "Output/Cache directory": pathlib.Path("cache").absolute()})
        pictures = vc.figures.draw(joint.run("joint"))
        self.assertTrue(pictures["ring_down"].read_bytes().startswith(b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
