"""Cases of the Python package: what is wrong with names, values, files or the program is an exception that says what to do."""
import os
import pathlib
import stat
import tempfile
import unittest
from unittest import mock

import numpy as np
import vibrocontact as vc
from vibrocontact.prm import read_entries, write_entries

HALF_SPACES = vc.EXAMPLES / "half_space_rolling.prm"


class Names(unittest.TestCase):
    def refused(self, entry, *words, value=1):
        with self.assertRaises(vc.UnknownEntry) as caught:
            vc.Case.from_file(HALF_SPACES, {entry: value})
        for word in words:
            self.assertIn(word, str(caught.exception))
        return caught.exception

    def test_unknown_ones_are_refused_with_the_nearest(self):
        self.assertEqual(self.refused("Contact/Frction coefficient", "did you mean").nearest, ("Friction coefficient",))
        self.refused("wheeel/Material/Density", '"wheel"')
        self.refused("Speed", '"Rolling"', '"Road"')
        self.refused("rail/Rail/Length", "rail")  # a half-space has no such section

    def test_of_a_dict(self):
        with self.assertRaises(vc.UnknownEntry) as caught:
            vc.Case({"Bodies": ["wheel", "rail"], "Analyses": "quasi-static rolling", "wheel": {"Type": "half-space"}, "rail": {"Type": "half-space"},
                     "Rolling": {"Sped": 3}})
        self.assertIn('"Speed"', str(caught.exception))

    def test_of_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "wrong.prm"
            file.write_text(HALF_SPACES.read_text().replace("Grid spacing", "Gird spacing"))
            with self.assertRaises(vc.UnknownEntry) as caught:
                vc.Case.from_file(file).check()
        self.assertRegex(str(caught.exception), r'wrong.prm:\d+: .*"Grid spacing"')

    def test_shipped_files_have_none(self):
        catalogue, named_here = vc.parameters(), []
        for file in sorted(vc.EXAMPLES.glob("*.prm")):
            entries = vc.Case.from_file(file).entries
            self.assertGreater(len(entries), 5, file)
            named_here += [(file.name, path) for path in catalogue.unknown(entries, entries)]
            self.assertEqual(read_entries(write_entries(entries)), entries)
        # of rows that the file itself names
        self.assertEqual({name for name, _ in named_here}, {"speed_against_error.prm"})
        self.assertTrue(all(path.startswith("Modal convolution/Comparison/") for _, path in named_here))

    def test_the_program_judges_what_its_list_does_not_hold(self):
        case = vc.Case.from_file(vc.EXAMPLES / "speed_against_error.prm")
        row = "Modal convolution/Comparison/tyre/Road/Speed"
        self.assertEqual(case.with_entries({row: 20}).entries[row], "20")
        with self.assertRaises(vc.UnknownEntry):
            case.with_entries({"Modal convolution/Comparison/tyre/Road/Sped": 20})

    def test_list(self):
        friction = vc.parameters().common["Contact/Friction coefficient"]
        self.assertEqual((friction.unit, friction.values, friction.default), ("none", "a number from 0 to 10", "0.3"))
        self.assertIn("Rolling/Normal force", [one.path for one in vc.parameters().search("normal force")])
        self.assertEqual([one.path for one in vc.parameters() if not (one.meaning and one.values)], [])


class Values(unittest.TestCase):
    def test_wrong_ones_are_refused_before_the_start(self):
        with tempfile.TemporaryDirectory() as folder:
            for entries, words in (({"Contact/Friction coefficient": -1}, "number from 0 to 10"),
                                   ({"Contact/Friction coefficient": "high"}, '"high"'),
                                   ({"Contact/Friction coefficient": float("nan")}, "nan"),
                                   ({"Analyses": "rolling"}, "rolling"),
                                   ({"Transient/Theta": 0.7}, "Theta")):  # nothing reads it
                case = vc.Case.from_file(HALF_SPACES, entries)
                with self.assertRaisesRegex(vc.InputError, words):
                    case.check()
            with self.assertRaisesRegex(vc.InputError, words):  # without a check as well
                case.run(folder + "/out")
            self.assertFalse(os.path.exists(folder + "/out"))

    def test_types(self):
        texts = vc.Case.from_file(HALF_SPACES, {"Contact": {"Grid spacing": np.float64(1e-3)}, "Output/Figures": False,
                                                "Rolling/Sweep/Lateral creepage": np.array([0, 1 / 3])}).overrides
        self.assertEqual(texts["Contact/Grid spacing"], "0.001")
        self.assertEqual(texts["Output/Figures"], "false")
        self.assertEqual([float(one) for one in texts["Rolling/Sweep/Lateral creepage"].split(",")], [0, 1 / 3])
        for value, words in ((None, "NoneType"), ("a # b", "one line"), ("a\nb", "one line"), (object(), "object")):
            with self.assertRaisesRegex(vc.InputError, words):
                vc.Case.from_file(HALF_SPACES, {"Title": value})

    def test_a_case_does_not_change(self):
        case = vc.Case.from_file(HALF_SPACES)
        other = case.with_entries({"Contact/Friction coefficient": 0.5})
        self.assertEqual((case.entries["Contact/Friction coefficient"], other.entries["Contact/Friction coefficient"]), ("0.3", "0.5"))
        self.assertEqual(other.overrides, {"Contact/Friction coefficient": "0.5"})

    def test_files(self):
        with self.assertRaisesRegex(vc.InputError, "nowhere.prm"):
            vc.Case.from_file("nowhere.prm")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "latin.prm"
            file.write_bytes("set Title = Stoß".encode("latin-1"))
            with self.assertRaisesRegex(vc.InputError, "UTF-8"):
                vc.Case.from_file(file)


class Program(unittest.TestCase):
    def test_none(self):
        with self.assertRaisesRegex(vc.ProgramNotFound, "VIBROCONTACT"):
            vc.Case.from_file(HALF_SPACES, program="/nowhere/vibrocontact")
        with mock.patch.dict(os.environ, {"VIBROCONTACT": "no_such_program"}), self.assertRaisesRegex(vc.ProgramNotFound, "no_such_program"):
            vc.parameters()
        with mock.patch.dict(os.environ, {"PATH": ""}), mock.patch("vibrocontact.program.CONTRIB", pathlib.Path("/nowhere/contrib")):
            os.environ.pop("VIBROCONTACT")
            with self.assertRaisesRegex(vc.ProgramNotFound, "README"):
                vc.parameters()

    def test_another(self):
        with tempfile.TemporaryDirectory() as folder:
            other = pathlib.Path(folder) / "other"
            other.write_text("#!/bin/sh\necho something else\n")
            other.chmod(other.stat().st_mode | stat.S_IXUSR)
            with self.assertRaisesRegex(vc.ProgramNotFound, "--parameters"):
                vc.Case.from_file(HALF_SPACES, {"Title": "x"}, program=other)

    def test_no_mpirun(self):
        case = vc.Case.from_file(HALF_SPACES)
        with mock.patch.dict(os.environ, {"PATH": ""}), self.assertRaisesRegex(vc.ProgramNotFound, "mpirun"):
            case.start("out", ranks=2)


if __name__ == "__main__":
    unittest.main()
