# SPDX-License-Identifier: MIT
"""The types that the module tells are those it has."""

import importlib.util
import inspect
import os
import subprocess
import sys
import unittest

import shakedown
from project import ROOT


class Typing(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("mypy"), "needs mypy")
    def test_mypy_finds_nothing(self):
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, "shakedown"],
                              cwd=ROOT / "harness/python", capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_stub_names_what_the_compiled_part_has(self):
        stub = (ROOT / "harness/python/shakedown/_core.pyi").read_text()
        for name, value in vars(shakedown._core).items():
            if name.startswith("__"):
                continue
            self.assertRegex(stub, rf"(class|def) {name}\b|{name}:", name)
            if inspect.isclass(value):
                for member in vars(value):
                    if not member.startswith("_") and member not in ("with_traceback",):
                        self.assertRegex(stub, rf"def {member}\(|{member}:", f"{name}.{member}")

    def test_everything_is_explained(self):
        for name in shakedown.__all__:
            self.assertTrue(getattr(shakedown, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
