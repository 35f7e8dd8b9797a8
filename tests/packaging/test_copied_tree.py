# SPDX-License-Identifier: MIT
"""A tree that was copied together with its build folder: what is built there is made of the copy's sources, with the options that the build had."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parent.parent.parent
SOURCE = "harness/numbers/expect.cpp"
OBJECT = "harness/numbers/CMakeFiles/numbers.dir/expect.cpp.o"


def build(tree):
    return subprocess.run([tree / "harness/build", "--target", OBJECT], capture_output=True, text=True, check=False)


@unittest.skipUnless(shutil.which("dpkg-query") and shutil.which("ninja"), "needs Debian's packages")
class CopiedTree(unittest.TestCase):
    def test_builds_its_own_sources_with_the_options_that_it_had(self):
        with tempfile.TemporaryDirectory() as scratch:
            first, copy = pathlib.Path(scratch, "first"), pathlib.Path(scratch, "copy")
            shutil.copytree(ROOT, first, ignore=lambda folder, _: {"build", "out", ".git"} if pathlib.Path(folder) == ROOT else set())
            configured = subprocess.run([os.environ["CMAKE"], "--preset", "release", "-DSHAKEDOWN_TESTS=OFF", "-DSHAKEDOWN_CPU=portable"], cwd=first,
                                        capture_output=True, text=True, check=False)
            self.assertEqual(configured.returncode, 0, configured.stderr)
            result = build(first)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

            subprocess.run(["cp", "-a", first, copy], check=True)
            text = (copy / SOURCE).read_text(encoding="utf-8")
            (copy / SOURCE).write_text(text.replace("please report it", "please tell us"), encoding="utf-8")
            result = build(copy)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn(b"please tell us", (copy / "build/release" / OBJECT).read_bytes())
            self.assertNotIn(b"please tell us", (first / "build/release" / OBJECT).read_bytes())
            cache = (copy / "build/release/CMakeCache.txt").read_text(encoding="utf-8")
            self.assertIn(f"CMAKE_HOME_DIRECTORY:INTERNAL={copy}\n", cache)
            for option in ("SHAKEDOWN_TESTS:BOOL=OFF", "SHAKEDOWN_CPU:STRING=portable", "SHAKEDOWN_TOGETHER:BOOL=OFF"):
                self.assertIn(option, cache)
            self.assertIn("ninja: no work to do", build(copy).stdout)


if __name__ == "__main__":
    sys.exit(unittest.main())
