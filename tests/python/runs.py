"""Runs of the Python package: on two ranks as on one, watched, stopped, killed, on a full disk, not converged."""
import contextlib
import os
import pathlib
import signal
import stat
import subprocess
import tempfile
import time
import unittest
from unittest import mock

import numpy as np
import vibrocontact as vc

NO_FIGURES = {"Output/Figures": False}
HALF_SPACES = vc.Case.from_file(vc.EXAMPLES / "half_space_rolling.prm", NO_FIGURES)
MARCH = vc.Case.from_file(vc.EXAMPLES / "rolling_transient.prm", {**NO_FIGURES, "Transient/Time step": 4e-6, "Contact/Grid spacing": 1.5e-3,
                                                                  "Transient/Checkpoint interval": 0.02})


def met(folder, ranks, interrupt):
    """A march that was interrupted after a checkpoint; one that was at its end before is begun again."""
    for _ in range(5):
        run = MARCH.start(folder, ranks=ranks)
        while run.running and not (folder / "checkpoint.h5").exists():
            time.sleep(0.005)
        if run.running:
            interrupt(run)
            if not vc.Results(folder).converged:
                return run
    raise AssertionError("five marches ended before they could be interrupted")


def kill(run):
    # one rank of two: mpirun ends the other
    ranks = pathlib.Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
    os.kill(int(ranks[-1]) if ranks else run.pid, signal.SIGKILL)
    with contextlib.suppress(vc.VibrocontactError):
        run.wait()


class Runs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(dir=".")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name).absolute()

    def same_histories(self, one, other, tolerance=1e-9):
        first, second = (results.histories() for results in (one, other))
        self.assertEqual(list(first), list(second))
        for name in ("time_s", "normal_force_N", "tangential_force_x_N", "tangential_force_y_N"):
            np.testing.assert_allclose(first[name], second[name], rtol=tolerance, atol=tolerance * np.abs(second[name]).max())

    def test_two_ranks_as_one(self):
        cases = [HALF_SPACES.run(self.folder / str(ranks), ranks=ranks) for ranks in (1, 2)]
        self.assertEqual([results.data.program.ranks for results in cases], [1, 2])
        one, two = (results.analyses.quasi_static_rolling.cases[0] for results in cases)
        for name in ("utilisation", "normal_force_N", "max_pressure_Pa", "approach_m"):
            self.assertAlmostEqual(one[name] / two[name], 1, delta=1e-9)
        patches = [results.table("contact_patch_0.csv") for results in cases]
        for name, values in patches[0].items():
            np.testing.assert_allclose(values, patches[1][name], rtol=1e-9, atol=1e-9 * (np.abs(values).max() or 1))

    def test_values_used_make_the_case_again(self):
        results = HALF_SPACES.with_entries({"Contact/Friction coefficient": 0.2}).run(self.folder / "first")
        again = results.case().with_entries(NO_FIGURES).run(self.folder / "again")
        self.assertEqual(again.analyses.quasi_static_rolling.cases[0].friction, 0.2)
        self.assertEqual(*(one.analyses.quasi_static_rolling.cases[0].tangential_force_N for one in (results, again)))

    def test_lines_and_an_exception_among_them(self):
        lines = []
        HALF_SPACES.run(self.folder / "said", on_line=lines.append)
        self.assertTrue(any(line.text.startswith("Vibrocontact") for line in lines))
        line = vc.Line.read("wheel: modes: 12 %, 34 s, about 4 min 05 s left, 3 of 20")
        self.assertEqual((line.percent, line.left_s), (12, 245))
        self.assertFalse(vc.Line.read("time                              6.68 s").is_progress)

        def too_much(line):
            raise RuntimeError(line.text)

        with self.assertRaises(RuntimeError):
            MARCH.run(self.folder / "left", on_line=too_much)

    def test_killed_and_stopped_ones_go_on(self):
        whole = MARCH.run(self.folder / "whole")
        for ranks in (1, 2):
            folder = self.folder / f"killed_{ranks}"
            run = met(folder, ranks, kill)
            with self.assertRaisesRegex(vc.Killed, "SIGKILL.*resume=True") as caught:
                run.wait()
            self.assertEqual((caught.exception.signal, caught.exception.folder), (signal.SIGKILL, folder))
            self.assertFalse(vc.Results(folder).converged)
            self.same_histories(MARCH.run(folder, resume=True), whole)

            folder = self.folder / f"stopped_{ranks}"
            run = met(folder, ranks, vc.Run.stop)
            self.assertFalse(run.stop().converged)  # again: nothing happens
            with self.assertRaisesRegex(vc.Stopped, "resume=True"):
                run.wait()
            self.same_histories(MARCH.run(folder, resume=True, ranks=ranks), whole)

    def test_another_case_is_not_resumed(self):
        HALF_SPACES.run(self.folder / "one")
        with self.assertRaisesRegex(vc.InputError, "--resume goes on with the same parameters"):
            HALF_SPACES.with_entries({"Rolling/Speed": 11}).run(self.folder / "one", resume=True)
        # where there is no run it begins
        self.assertTrue(HALF_SPACES.run(self.folder / "new", resume=True).converged)

    def test_waiting_has_an_end(self):
        with MARCH.start(self.folder / "long") as run:
            with self.assertRaises(subprocess.TimeoutExpired):
                run.wait(0.001)
            self.assertTrue(run.running)
        self.assertFalse(run.running)

    def test_full_disk(self):
        # files that may not grow beyond 16 blocks
        program = self.folder / "on_a_full_disk"
        program.write_text(f"#!/bin/bash\ntrap '' XFSZ\nulimit -f 16\nexec '{vc.find_program()}' \"$@\"\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        case = vc.Case.from_file(vc.EXAMPLES / "bouncing_bar.prm", {**NO_FIGURES, "Output/Cache directory": self.folder / "cache"})
        case.run(self.folder / "room")
        case.program = program
        with self.assertRaisesRegex(vc.CannotWrite, r"cannot be written.*MB are free.*resume=True") as caught:
            case.run(self.folder / "full")
        self.assertEqual(caught.exception.folder, self.folder / "full")
        self.assertFalse(vc.Results(self.folder / "full").converged)
        # without room for the parameter file itself
        own = vc.Case(HALF_SPACES.entries)
        with mock.patch("tempfile.tempdir", "/dev/full"), self.assertRaisesRegex(vc.CannotWrite, "TMPDIR"):
            own.start(self.folder / "own")

    def test_folder_that_nothing_can_be_written_to(self):
        (self.folder / "file").write_text("")
        with self.assertRaises(vc.InputError):
            HALF_SPACES.run(self.folder / "file" / "out")

    def test_not_converged(self):
        with self.assertRaisesRegex(vc.NotConverged, "did not converge") as caught:
            HALF_SPACES.with_entries({"Contact/Solver/Max Newton iterations": 1}).run(self.folder / "out")
        self.assertFalse(caught.exception.results.converged)
        self.assertEqual(len(caught.exception.results.analyses.quasi_static_rolling.cases), 1)
        self.assertIn("Case 0", caught.exception.messages[0])

    def test_fault(self):
        program = self.folder / "faulty"
        program.write_text("#!/bin/bash\necho 'vibrocontact: a fault of the program' >&2; exit 3\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        case = HALF_SPACES.with_entries({})
        case.program = program
        with self.assertRaisesRegex(vc.ProgramFault, "a fault of the program"):
            case.run(self.folder / "out")
        with self.assertRaisesRegex(vc.ProgramFault, "a fault of the program"):
            case.check()


if __name__ == "__main__":
    unittest.main()
