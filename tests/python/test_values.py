# SPDX-License-Identifier: MIT
"""Setups, runs, measurements, drops: the same numbers, sentences and places as those of the command line."""

import importlib.util
import json
import pathlib
import tempfile
import threading
import time
import unittest

import numpy as np

import shakedown
from project import L040, LEAF_SPRING, ROOT, SHAKEDOWN, by_command


class Setups(unittest.TestCase):
    def test_of_a_file_a_dictionary_and_changes(self):
        setup = shakedown.Setup(L040, set={"box.length": "65 mm"})
        self.assertEqual(setup["box.length"], 0.065)
        self.assertEqual(shakedown.Setup(L040).changed({"box.length": "65 mm"}).digest, setup.digest)
        same = shakedown.Setup({"box": {"length": "65 mm"}, "run": {"duration": "30 s"}})
        self.assertEqual(same.digest, setup.digest)
        rubbing = setup.changed({"grain_friction.grain_grain": 0.2})
        self.assertEqual(rubbing.effects, ["grain_friction"])
        listed = shakedown.Setup({"box": {"length": "65 mm"}, "run": {"duration": "30 s"},
                                  "effect": [{"name": "grain_friction", "grain_grain": 0.2}]})
        self.assertEqual(listed.digest, rubbing.digest)

    def test_writes_what_reads_back(self):
        setup = shakedown.Setup(L040, set={"restitution.grain_grain": 0.7123456789012345})
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "setup.toml"
            setup.write(file)
            self.assertEqual(shakedown.Setup(file).digest, setup.digest)

    def test_says_what_it_took_from_the_paper(self):
        self.assertIn("grains.mass", " ".join(shakedown.Setup().taken_from_paper))
        self.assertEqual(shakedown.Setup(L040).taken_from_paper, [])

    def test_names_every_mistake_with_its_place(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "bad.toml"
            file.write_text('[box]\nmass = "434 mm"\nlenght = "40 mm"\n')
            with self.assertRaises(shakedown.InputError) as caught:
                shakedown.Setup(file)
        self.assertEqual([(v[1], v[3]) for v in caught.exception.violations], [(2, "box.mass"), (3, "box.lenght")])
        self.assertIn(f"{file}:2:", str(caught.exception))
        self.assertIn("did you mean", str(caught.exception))
        self.assertIsInstance(caught.exception, ValueError)
        with self.assertRaises(shakedown.FileError):
            shakedown.Setup("/nowhere/setup.toml")


class Forces(unittest.TestCase):
    """A force of Python beside the same force as a formula."""

    def test_moves_as_the_formula_does(self):
        short = {"run.duration": "0.2 s", "grains.count": 0}
        formula = shakedown.Setup(L040, set={**short, "user_force.force": "-0.3*v*abs(v)"})
        threads = set()

        def drag(x, v, t):
            threads.add(threading.get_ident())
            return -0.3 * v * abs(v)

        lent = shakedown.Setup(L040, set=short).with_force(drag)
        self.assertEqual(lent.effects, ["user_force"])
        for engine in ("hard", "soft"):
            one, other = (shakedown.ensemble(setup, 2, engine=engine) for setup in (lent, formula))
            np.testing.assert_allclose(one.box, other.box, atol=1e-12)
        self.assertGreater(len(threads), 1)
        with self.assertRaisesRegex(ValueError, "already"):
            lent.changed({"box.length": "65 mm"}).with_force(drag)

    def test_on_grains_by_soft_contacts(self):
        short = {"run.duration": "0.01 s"}
        lent = shakedown.Setup(L040, set=short).with_force(lambda x, v, t: -0.02 * v, on="grains")
        formula = shakedown.Setup(L040, set={**short, "user_force.on": "grains", "user_force.force": "-0.02*v"})
        np.testing.assert_allclose(*(shakedown.run(setup, engine="soft").box for setup in (lent, formula)), atol=1e-12)

    def test_its_exceptions_are_told(self):
        setup = shakedown.Setup(L040, set={"run.duration": "1 s"})

        def late(x, v, t):
            if 0.5 < t < 0.9:
                raise RuntimeError("not yet")
            return 0

        with self.assertRaisesRegex(shakedown.PhysicsError, "not yet"):
            shakedown.run(setup.with_force(late))
        with self.assertRaisesRegex(shakedown.InputError, "ZeroDivisionError"):
            setup.with_force(lambda x, v, t: 1 / x)
        with self.assertRaises(shakedown.InputError):
            setup.with_force(lambda x, v, t: "none")


class Runs(unittest.TestCase):
    def test_gives_the_numbers_of_the_command(self):
        short = {"run.duration": "3 s"}
        found = shakedown.ensemble(shakedown.Setup(L040, set=short), 3)
        told = by_command("run", L040, "--set", "run.duration=3 s", "--runs", "3")
        for document in (told, found.to_dict()):
            document.pop("wall_seconds", None)
            document.pop("collisions_per_second", None)
        self.assertEqual(found.to_dict(), told)
        self.assertEqual(found.box.shape, (3, 1501))
        self.assertEqual(found.runs[0].loss.shape, (3, 1501))
        np.testing.assert_allclose(found.runs[1].energy + found.runs[1].loss.sum(axis=0), found.runs[1].energy[0], rtol=1e-9)
        self.assertAlmostEqual(found.runs[0].box[0], 0.1075, places=12)

    def test_results_do_not_depend_on_threads(self):
        setup = shakedown.Setup(L040, set={"run.duration": "1 s"})
        np.testing.assert_array_equal(shakedown.ensemble(setup, 4, threads=1).box, shakedown.ensemble(setup, 4, threads=3).box)

    def test_shows_a_page(self):
        found = shakedown.run(shakedown.Setup(L040, set={"run.duration": "1 s"}))
        self.assertTrue(found.page().startswith("<!doctype html>"))
        self.assertIn("<iframe", found._repr_html_())
        self.assertIn("peak", str(found))

    def test_progress_is_told_and_others_run_on(self):
        told, ticks, stop = [], [], threading.Event()

        def tick():
            while not stop.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.005)

        beside = threading.Thread(target=tick)
        beside.start()
        try:
            shakedown.ensemble(shakedown.Setup(L040), 64, progress=lambda stage, fraction: told.append((stage, fraction)))
        finally:
            stop.set()
            beside.join()
        self.assertGreater(len(ticks), 20)
        self.assertLess(max(np.diff(ticks)), 1.0)
        self.assertTrue(told)
        self.assertEqual(sorted(fraction for _, fraction in told), [fraction for _, fraction in told])

    def test_an_exception_of_the_listener_stops_the_work(self):
        def refuse(stage, fraction):
            raise KeyboardInterrupt

        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            shakedown.ensemble(shakedown.Setup(L040), 100000, progress=refuse)
        self.assertLess(time.monotonic() - begin, 30)

    def test_ctrl_c_stops_the_work(self):
        import os
        import signal

        # What is started in the background by a script ignores the signal, and so would Python.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            shakedown.ensemble(shakedown.Setup(L040), 100000)
        self.assertLess(time.monotonic() - begin, 30)

    def test_refuses_what_an_engine_does_not_model(self):
        with self.assertRaises(shakedown.InputError):
            shakedown.run(L040, engine="none")
        with self.assertRaisesRegex(ValueError, "runs is 0"):
            shakedown.ensemble(L040, 0)


class Measurements(unittest.TestCase):
    def test_of_a_file(self):
        films = shakedown.measurement(LEAF_SPRING / "experiment.toml")
        self.assertEqual(films.title, "an empty box on a leaf spring")
        self.assertEqual([run.name for run in films.runs], ["ring_down_1", "ring_down_2"])
        run = films.runs[0]
        self.assertEqual(run.frame_rate, 240)
        self.assertEqual(run.time.shape, run.box.shape)
        self.assertIsNone(run.centre)

    def test_of_arrays_is_as_of_a_file(self):
        films = shakedown.measurement(LEAF_SPRING / "experiment.toml")
        again = shakedown.measurement({run.name: {"time": run.time, "box": run.box} for run in films.runs})
        for one, other in zip(films.runs, again.runs):
            np.testing.assert_array_equal(one.time, other.time)
            np.testing.assert_array_equal(one.box, other.box)

    def test_of_arrays_with_grains_and_gaps(self):
        time_, box = np.linspace(0, 2, 201), np.cos(np.linspace(0, 12, 201)) * 0.1
        box[7] = np.nan
        films = shakedown.measurement({"a": {"time": time_, "box": box, "centre": 0.9 * box, "box_length": "40 mm"},
                                       "b": {"time": time_, "box": box}}, known={"box.mass": "434 g +- 2 g"}, noise="0.2 mm")
        self.assertTrue(np.isnan(films.runs[0].box[7]))
        self.assertIsNotNone(films.runs[0].centre)
        self.assertIsNone(films.runs[1].centre)
        self.assertEqual(films.runs[0].box_length, 0.04)
        with self.assertRaisesRegex(ValueError, "one shape"):
            shakedown.measurement({"a": {"time": time_, "box": box[1:]}})
        with self.assertRaisesRegex(ValueError, "box is missing"):
            shakedown.measurement({"a": {"time": time_}})

    def test_of_tables(self):
        tables = [LEAF_SPRING / "ring_down_1.csv", LEAF_SPRING / "ring_down_2.csv"]
        films = shakedown.measurement(tables, frame_rate="240 Hz", pixel="0.25 mm", origin="640 px")
        np.testing.assert_array_equal(films.runs[0].box, shakedown.measurement(LEAF_SPRING / "experiment.toml").runs[0].box)
        with self.assertRaisesRegex(ValueError, "do not say everything"):
            shakedown.measurement(tables)

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "needs pandas")
    def test_of_pandas(self):
        import pandas

        as_file = shakedown.measurement(LEAF_SPRING / "experiment.toml")
        tables = [pandas.read_csv(LEAF_SPRING / f"ring_down_{n}.csv", comment="#") for n in (1, 2)]
        tables[1].attrs["name"] = "the second"
        films = shakedown.measurement(tables, frame_rate="240 Hz", pixel="0.25 mm", origin="640 px")
        self.assertEqual([run.name for run in films.runs], ["table_1", "the second"])
        np.testing.assert_array_equal(films.runs[0].box, as_file.runs[0].box)

        table = pandas.DataFrame({"time": as_file.runs[0].time, "box": as_file.runs[0].box, "brightness": 1.0})
        table.loc[7, "box"] = None
        table.attrs["box_length"] = "40 mm"
        films = shakedown.measurement({"one": table})
        self.assertEqual(films.runs[0].box_length, 0.04)
        self.assertTrue(np.isnan(films.runs[0].box[7]))
        np.testing.assert_array_equal(np.delete(films.runs[0].box, 7), np.delete(as_file.runs[0].box, 7))


class Hiding(unittest.TestCase):
    def test_gives_the_films_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            by_command("hide", L040, "--effect", "clamp_dry_friction=force:15 mN", "--lengths", "40mm", "--run",
                       "grains.count=0", "--duration", "3 s", "--out", folder)
            told = shakedown.measurement(pathlib.Path(folder) / "experiment.toml")
            found = shakedown.hide(L040, "clamp_dry_friction=force:15 mN", lengths=["40mm"], runs=["grains.count=0"],
                                   duration="3 s")
            for one, other in zip(found.measurement.runs, told.runs):
                np.testing.assert_allclose(one.box, other.box, atol=1e-9)
            self.assertEqual(found.truth, json.loads((pathlib.Path(folder) / "truth.json").read_text()))
            found.write(pathlib.Path(folder) / "again")
            for name in ("setup.toml", "experiment.toml", "truth.json"):
                self.assertEqual((pathlib.Path(folder) / name).read_text(), (pathlib.Path(folder) / "again" / name).read_text())
        with self.assertRaises(shakedown.InputError):
            shakedown.hide(L040, "no_such_effect")


class Drops(unittest.TestCase):
    def test_gives_the_numbers_of_the_command(self):
        file = ROOT / "tests/data/drops/throws.csv"
        found = shakedown.bounce(file)
        self.assertEqual(found.to_dict(), by_command("bounce", file))
        self.assertIn("restitution falls", found.sentence)
        self.assertIn("power", str(found))
        self.assertTrue(found.page().startswith("<!doctype html>"))
        with self.assertRaises(shakedown.InputError):
            shakedown.bounce(file, mass="2.7 mm", diameter="40 mm")


class Effects(unittest.TestCase):
    def test_lists_them(self):
        found = shakedown.effects()
        self.assertEqual([found[n] for n in range(len(found))], by_command("effects"))
        one = shakedown.effects("clamp_dry_friction")
        self.assertEqual(one.names, ["clamp_dry_friction"])
        self.assertIn("formula", one[0])
        with self.assertRaisesRegex(shakedown.InputError, "did you mean 'clamp_dry_friction'"):
            shakedown.effects("clamp_dry_frictoin")


class Program(unittest.TestCase):
    def test_is_of_the_version_of_the_command(self):
        import subprocess

        told = subprocess.run([SHAKEDOWN, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(told.split()[1], shakedown.__version__)


if __name__ == "__main__":
    unittest.main()
