"""Results of the Python package: tables and histories against their files, units, figures."""
import csv
import pathlib
import pickle
import re
import shutil
import tempfile
import unittest

import h5py
import matplotlib
import numpy as np
import vibrocontact as vc
from vibrocontact.tables import read_table, unit_of


class OfARun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(dir=".")).absolute()
        cls.case = vc.Case.from_file(vc.EXAMPLES / "rolling_transient.prm", {"Output/Figures": False, "Contact/Grid spacing": 2e-3})
        cls.results = cls.case.run(cls.folder / "run")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_table(self):
        table = self.results.table("contact_patch_0.csv")
        with open(self.results.folder / "contact_patch_0.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual(list(table), list(rows[0]))
        for name, values in table.items():
            self.assertEqual(list(values), [float(row[name]) for row in rows])
        self.assertEqual({name: table[name].unit for name in ("x_m", "pressure_Pa", "slip_x_m_s", "status")},
                         {"x_m": "m", "pressure_Pa": "Pa", "slip_x_m_s": "m/s", "status": ""})
        self.assertTrue(table.head)
        # N from the pressures
        force = table["pressure_Pa"].sum() * 2e-3**2
        self.assertAlmostEqual(force / 66000, 1, delta=1e-6)
        with self.assertRaisesRegex(KeyError, "pressure_Pa"):
            table["presure_Pa"]
        with self.assertRaisesRegex(vc.VibrocontactError, "rolling.csv"):
            self.results.table("roling.csv")

    def test_histories(self):
        histories = self.results.histories()
        with h5py.File(self.results.folder / "histories.h5") as file:
            for name in ("time_s", "normal_force_N", "tangential_force_y_N"):
                np.testing.assert_array_equal(histories[name], file[name][()])
        self.assertEqual(histories["time_s"].unit, "s")
        self.assertEqual(len(histories["time_s"]), self.results.analyses.transient.steps + 1)
        with self.assertRaisesRegex(vc.VibrocontactError, "histories.h5"):
            self.results.histories("signals.h5")

    def test_keys_are_attributes(self):
        self.assertEqual(self.results.status, "converged")
        self.assertIs(self.results.analyses.transient, self.results.data["analyses"]["transient"])
        with self.assertRaisesRegex(AttributeError, "transient"):
            self.results.analyses.transent
        self.assertEqual(pickle.loads(pickle.dumps(self.results)).data, self.results.data)
        with self.assertRaisesRegex(vc.VibrocontactError, "no output folder"):
            vc.Results(self.folder / "none")

    def test_figures(self):
        backend = matplotlib.get_backend()
        copy = pathlib.Path(shutil.copytree(self.results.folder, self.folder / "copy"))
        pictures = vc.figures.draw(copy)
        for name in ("transient_force", "contact_patch_0"):
            self.assertTrue(pictures[name].read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(vc.Results(copy).pictures, sorted(f"figures/{name}.png" for name in pictures))
        scene = vc.figures.scene(self.case, self.folder / "scene")
        self.assertTrue(scene.read_bytes().startswith(b"\x89PNG"))
        picture = vc.figures.compare([self.results, copy], self.folder / "both.png")
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))
        with self.assertRaisesRegex(vc.VibrocontactError, "cannot be drawn"):
            vc.figures.draw(self.folder / "none")
        self.assertEqual(matplotlib.get_backend(), backend)


class Quantities(unittest.TestCase):
    def test_units_of_names(self):
        for name, unit in (("time_s", "s"), ("seconds", "s"), ("pressure_Pa", "Pa"), ("slip_x_m_s", "m/s"), ("growth_1_s", "1/s"), ("spin_1_m", "1/m"),
                           ("tangential_force_1_N", "N"), ("tangential_displacement_1_m", "m"), ("A_z_B_z_imag_m_N", "m/N"),
                           ("support_z_support_z_real_m_Ns", "m/(N s)"), ("lateral_dB_m", "dB/m"), ("spin_moment_Nm", "N m"), ("impulse_Ns", "N s"),
                           ("wavenumber_rad_m", "rad/m"), ("status", ""), ("growth_1_s wheel:axial(0;2)/2", "1/s"), ("pad_stiffness_z_N_m", "N/m"), ("stick_points", ""), ("label", "")):
            self.assertEqual(unit_of(name), unit, name)

    def test_units_of_swept_entries(self):
        found = 0
        for one in vc.parameters():
            if one.unit == "none" or " of " in one.unit or "," in one.unit:
                continue
            # the column of a swept entry, as the program names it
            column = re.sub("[^a-z0-9]", "_", one.path.split("/")[-1].lower()) + "_" + re.sub("[^A-Za-z0-9]", "_", one.unit)
            unit = {"Ns/m": "N s/m", "degrees": "deg"}.get(one.unit, one.unit)
            self.assertEqual(unit_of(column), unit, one.path)
            found += 1
        self.assertGreater(found, 200)

    def test_parts_keep_the_unit_and_sums_are_plain(self):
        force = vc.Quantity([1.0, 2.0, 3.0], "N")
        self.assertEqual((force[1:].unit, force.copy().unit, force[force > 1].unit), ("N", "N", "N"))
        self.assertEqual(pickle.loads(pickle.dumps(force)).unit, "N")
        self.assertIs(type(force * 2), np.ndarray)
        force += 1
        np.testing.assert_array_equal(force, [2, 3, 4])

    def test_texts_and_empty_cells(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "table.csv"
            file.write_text("# roots\nfrequency_Hz,label,share\n917.5,axial(0;2)/2,\n,radial(1;3),0.5\n")
            table = read_table(file)
        self.assertEqual(list(table["label"]), ["axial(0,2)#2", "radial(1,3)"])
        self.assertTrue(np.isnan(table["frequency_Hz"][1]) and np.isnan(table["share"][0]))
        self.assertEqual((table.head, table.units()), (["roots"], {"frequency_Hz": "Hz"}))


if __name__ == "__main__":
    unittest.main()
