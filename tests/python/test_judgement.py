# SPDX-License-Identifier: MIT
"""Comparison, fit, diagnosis and engines side by side: the numbers of the command line, from arrays too."""

import math
import unittest

import numpy as np

import shakedown
from project import L040, LEAF_SPRING, by_command

SETUP, FILMS = LEAF_SPRING / "setup.toml", LEAF_SPRING / "experiment.toml"


def without_times(document):
    return {key: value for key, value in document.items() if key != "seconds"}


class Judgement(unittest.TestCase):
    def test_compare(self):
        found = shakedown.compare(SETUP, FILMS, runs=16)
        self.assertEqual(without_times(found.to_dict()),
                         without_times(by_command("compare", SETUP, "--data", FILMS, "--runs", "16")))
        self.assertFalse(found.holds)
        self.assertTrue(math.isnan(found.p_value))  # an empty box, judged by its waveform
        self.assertIn("reject", str(found))
        self.assertIn("The data reject the model", found.page())

    def test_diagnose_names_what_is_hidden(self):
        found = shakedown.diagnose(SETUP, FILMS)
        self.assertEqual(without_times(found.to_dict()), without_times(by_command("diagnose", SETUP, "--data", FILMS)))
        self.assertEqual(found.verdict, "missing")
        self.assertEqual(sorted(found.missing), ["blade_viscous_damping", "clamp_dry_friction"])
        self.assertGreater(found.hypotheses[0]["probability"], 0.9)
        damping = found.parameters["blade_viscous_damping.damping"]
        self.assertLess(damping["low"], 0.02005)
        self.assertGreater(damping["high"], 0.0199)
        curve = found.curves[0]
        self.assertEqual((curve.run, curve.observable), ("ring_down_1", "box"))
        np.testing.assert_allclose(curve.measured - curve.model, curve.residual, atol=2e-7)  # m; rounded to 0.1 um
        self.assertLess(np.sqrt(np.mean(curve.residual**2)), 0.2e-3)
        self.assertGreater(np.sqrt(np.mean((curve.measured - curve.as_given) ** 2)), 50e-3)
        self.assertTrue(shakedown.compare(found.setup, FILMS, runs=16).holds)
        self.assertTrue(found.page().startswith("<!doctype html>"))

    def test_fit(self):
        free = ["blade_viscous_damping.damping", "clamp_dry_friction.force", "spring.frequency"]
        words = ["blade_viscous_damping.damping=0.01 N s/m", "clamp_dry_friction.force=5 mN", "spring.frequency=1.26 Hz"]
        found = shakedown.fit(shakedown.Setup(SETUP, set=dict(word.split("=") for word in words)), FILMS, free, runs=32)
        told = by_command("fit", SETUP, "--data", FILMS, "--free", ",".join(free), "--runs", "32", "--set", words[0],
                          "--set", words[1], "--set", words[2])
        self.assertEqual(without_times(found.to_dict()), without_times(told))
        friction = found.parameters["clamp_dry_friction.force"]
        self.assertEqual(friction["unit"], "mN")
        # What is hidden lies within 3.5 standard errors: of 7.975 (7.948 to 8.002) mN, 1.260003 (1.2600005 to
        # 1.260006) Hz.
        for value, truth in ((friction, 8), (found.parameters["spring.frequency"], 1.26)):
            self.assertLess(abs(value["value"] - truth), 3.5 / 1.96 * (value["high"] - value["low"]) / 2)
        self.assertLess(friction["high"], 20)

    def test_arrays_are_judged_as_their_file_is(self):
        films = shakedown.measurement(FILMS)
        arrays = shakedown.measurement({run.name: {"time": run.time, "box": run.box} for run in films.runs})
        found = shakedown.diagnose(SETUP, arrays)
        self.assertEqual(sorted(found.missing), ["blade_viscous_damping", "clamp_dry_friction"])

    def test_refuses_names_that_are_none(self):
        with self.assertRaises(shakedown.InputError):
            shakedown.diagnose(SETUP, FILMS, effects=["no_such_effect"])
        with self.assertRaises(shakedown.InputError):
            shakedown.fit(SETUP, FILMS, "no.such.key")

    def test_crosscheck(self):
        setup = shakedown.Setup(L040, set={"run.duration": "4 s"})
        found = shakedown.crosscheck(setup, runs=4)
        self.assertEqual([one["engine"] for one in found.to_dict()["crosschecks"][0]["engines"]], ["hard", "soft"])
        self.assertIn("slope", str(found))


if __name__ == "__main__":
    unittest.main()
