# SPDX-License-Identifier: MIT
"""Which compiled part of the module a processor takes."""

import pathlib
import tempfile
import unittest
from unittest import mock

from shakedown import _processor

NEW = "processor\t: 0\nflags\t\t: fpu sse4_2 xsave avx f16c movbe abm bmi1 avx2 bmi2 fma\n"
OLD = "processor\t: 1\nflags\t\t: fpu sse4_2 popcnt\n"


class Processor(unittest.TestCase):
    def test_the_level_is_what_every_core_has(self):
        self.assertTrue(_processor.has_level(NEW))
        self.assertFalse(_processor.has_level(OLD))
        self.assertFalse(_processor.has_level(NEW + OLD))
        self.assertFalse(_processor.has_level("model name : one without flags\n"))

    def test_a_folder_is_searched_where_it_is_installed_and_wanted(self):
        with tempfile.TemporaryDirectory() as package:
            text = mock.patch.object(pathlib.Path, "read_text", return_value=NEW)
            with text:
                self.assertEqual(_processor.faster_folder(package), [])
                folder = pathlib.Path(package, _processor.LEVEL)
                folder.mkdir()
                self.assertEqual(_processor.faster_folder(package), [str(folder)])
                with mock.patch.dict("os.environ", {"SHAKEDOWN_PORTABLE": "1"}):
                    self.assertEqual(_processor.faster_folder(package), [])
            with mock.patch.object(pathlib.Path, "read_text", return_value=OLD):
                self.assertEqual(_processor.faster_folder(package), [])


if __name__ == "__main__":
    unittest.main()
