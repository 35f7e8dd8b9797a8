# SPDX-License-Identifier: MIT
"""The notebook runs from its first cell to its last, and shows what its text says."""

import contextlib
import io
import json
import os
import shutil
import tempfile
import unittest

from project import LEAF_SPRING, ROOT


class Notebook(unittest.TestCase):
    def test_runs_in_order(self):
        document = json.loads((ROOT / "harness/python/from_table_to_verdict.ipynb").read_text(encoding="utf-8"))
        cells = ["".join(cell["source"]) for cell in document["cells"] if cell["cell_type"] == "code"]
        shown = io.StringIO()
        names = {}
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(shown):
            for table in LEAF_SPRING.glob("*.csv"):
                shutil.copy(table, folder)
            os.chdir(folder)
            try:
                for cell in cells:
                    exec(compile(cell, "notebook", "exec"), names)  # pylint: disable=exec-used
                self.assertEqual(sorted(os.listdir(folder)),
                                 ["amended.toml", "diagnosis.html", "ring_down_1.csv", "ring_down_2.csv"])
            finally:
                os.chdir(before)
        self.assertFalse(names["as_given"].holds)
        self.assertEqual(sorted(names["answer"].missing), ["blade_viscous_damping", "clamp_dry_friction"])
        self.assertTrue(names["with_effects"].holds)
        errors = [step["error_box_mm"] for step in names["answer"].to_dict()["ladder"]]
        self.assertLess(errors[-1], errors[0] / 20)


if __name__ == "__main__":
    unittest.main()
