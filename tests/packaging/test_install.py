# SPDX-License-Identifier: MIT
"""What `cmake --install` copies works away from the tree: the program, the library in a project of somebody else's, pkg-config."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent


def done(*words, **more):
    result = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **more)
    if result.returncode != 0:
        raise AssertionError(f"{words} gave {result.returncode}:\n{result.stdout[-4000:]}{result.stderr[-4000:]}")
    return result.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.prefix = cls.folder / "prefix"
        # What a user builds before installing; nothing to do where all is built.
        done(os.environ["CMAKE"], "--build", os.environ["BUILD"], "--target", "shakedown", "shakedown-studies", "shakedown_whole", "manual")
        done(os.environ["CMAKE"], "--install", os.environ["BUILD"], "--prefix", cls.prefix)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def seen(self, text):
        """The paper's damper at 40 mm: 1.05 Hz, -8 mm/s."""
        frequency, _, slope, _ = text.split()
        self.assertAlmostEqual(float(frequency), 1.048, delta=0.01)
        self.assertAlmostEqual(float(slope), -8.2, delta=0.6)

    def test_programs_run_from_the_prefix(self):
        program = self.prefix / "bin" / "shakedown"
        self.assertIn("clamp_dry_friction", done(program, "effects"))
        self.assertIn("paper", done(program, "paper", "--help"))
        # Stored intervals come with the program: this would say that a file is missing.
        done(program, "check", "linear-decay", "--help")
        examples = self.prefix / "share/doc/shakedown/harness/examples"
        done(program, "run", examples / "L040.toml", "--set", "run.duration=1s")
        self.assertTrue((self.prefix / "share/shakedown/linear_decay.json").exists())

    def test_a_project_finds_the_package(self):
        build = self.folder / "consumer"
        done(os.environ["CMAKE"], "-S", HERE / "consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
             "-DCMAKE_BUILD_TYPE=Release")
        done(os.environ["CMAKE"], "--build", build)
        self.seen(done(build / "one_damper"))

    @unittest.skipUnless(shutil.which("pkg-config"), "needs pkg-config")
    def test_pkg_config_tells_how_to_compile(self):
        folders = [str(found.parent) for found in self.prefix.rglob("shakedown.pc")]
        self.assertEqual(len(folders), 1)
        flags = done("pkg-config", "--cflags", "--libs", "shakedown", env={**os.environ, "PKG_CONFIG_PATH": folders[0]}).split()
        program = self.folder / "by_pkg_config"
        done(os.environ.get("CXX", "c++"), "-std=c++20", HERE / "consumer/one_damper.cpp", "-o", program, *flags)
        libraries = os.path.dirname(folders[0])
        self.seen(done(program, env={**os.environ, "LD_LIBRARY_PATH": libraries}))

    def test_no_installed_text_names_the_tree(self):
        tree = str(HERE.parent.parent)
        for file in self.prefix.rglob("*"):
            if file.is_file() and file.suffix in {".cmake", ".pc", ".hpp", ".md", ".toml", ".json", ".py"}:
                self.assertNotIn(tree, file.read_text(encoding="utf-8"), file)


if __name__ == "__main__":
    sys.exit(unittest.main())
