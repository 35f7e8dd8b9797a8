# SPDX-License-Identifier: MIT
"""Every command has a manual page and a completion, and they know every option that the help shows."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SHAKEDOWN = os.environ["SHAKEDOWN"]
STUDIES = SHAKEDOWN + "-studies"


def output(*words):
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout


def options_in(text):
    return set(re.findall(r"^\s+(?:-\w,)?(--[a-z][a-z-]*)", text, re.MULTILINE))


def commands_in(text):
    return re.findall(r"^  ([a-z][a-z-]*) ", text.split("Subcommands:")[1], re.MULTILINE) if "Subcommands:" in text else []


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        for program in (SHAKEDOWN, STUDIES):
            if os.path.exists(program):
                subprocess.run([program, "--write-manual", str(cls.folder)], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def page(self, name):
        text = (self.folder / "man1" / (name + ".1")).read_text()
        return text.replace("\\-", "-")

    def each_command(self, program, above=()):
        for command in commands_in(output(program, *above, "--help")):
            yield (*above, command)
            if "Subcommands:" in output(program, *above, command, "--help"):
                yield from self.each_command(program, (*above, command))

    def programs(self):
        return [program for program in (SHAKEDOWN, STUDIES) if os.path.exists(program)]

    def test_every_command_has_a_page_with_every_option(self):
        for program in self.programs():
            name = os.path.basename(program)
            commands = list(self.each_command(program))
            self.assertGreater(len(commands), 2)
            for words in commands:
                page = self.page("-".join((name, *words)))
                if page.startswith(".so "):
                    self.assertTrue((self.folder / page[4:].strip()).exists() or len(self.programs()) == 1, page)
                    continue
                with self.subTest(command=words):
                    for section in (".SH NAME", ".SH SYNOPSIS", ".SH OPTIONS", ".SH EXIT STATUS"):
                        self.assertIn(section, page)
                    told = options_in(output(program, *words, "--help"))
                    self.assertTrue(told)
                    for option in told:
                        self.assertIn(f".B {option}", page.replace(".B --help, -h", ".B --help"))

    def test_pages_name_no_place_of_the_building_machine(self):
        for page in (self.folder / "man1").iterdir():
            self.assertNotIn(os.path.dirname(SHAKEDOWN), page.read_text().replace("\\-", "-"), page)

    @unittest.skipUnless(shutil.which("groff"), "needs groff")
    def test_pages_are_good_roff(self):
        for page in (self.folder / "man1").iterdir():
            if page.read_text().startswith(".so "):
                continue
            done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-z", str(page)], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.stderr, "", page)

    def completed(self, *words):
        """What bash offers for the last of the words."""
        script = (f"source '{self.folder}/bash/shakedown'; COMP_WORDS=({' '.join(repr(word) for word in words)}); "
                  f"COMP_CWORD={len(words) - 1}; _shakedown; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_commands_options_and_values(self):
        commands = commands_in(output(SHAKEDOWN, "--help"))
        self.assertEqual(sorted(set(self.completed("shakedown", "")) - {"--help", "-h", "--version"}), sorted(commands))
        for words in self.each_command(SHAKEDOWN):
            if self.page("-".join(("shakedown", *words))).startswith(".so "):
                continue
            with self.subTest(command=words):
                told = options_in(output(SHAKEDOWN, *words, "--help"))
                self.assertLessEqual(told, set(self.completed("shakedown", *words, "-")))
        self.assertEqual(self.completed("shakedown", "run", "--engine", ""), ["hard", "soft", "bullet", "lammps", "apart"])
        self.assertIn("clamp_dry_friction", self.completed("shakedown", "effects", "clamp"))
        self.assertEqual(self.completed("shakedown", "bounce", "--as", "tr"), ["track"])
        self.assertEqual(self.completed("shakedown", "check", "lin"), ["linear-decay"])

    def test_zsh_names_every_command_and_option(self):
        text = (self.folder / "zsh" / "_shakedown").read_text()
        self.assertTrue(text.startswith("#compdef shakedown\n"))
        for words in self.each_command(SHAKEDOWN):
            self.assertIn(f" '{words[-1]}:", text)
            if self.page("-".join(("shakedown", *words))).startswith(".so "):
                continue
            for option in options_in(output(SHAKEDOWN, *words, "--help")):
                self.assertTrue(f"{option}[" in text, (words, option))
        if shutil.which("zsh"):
            subprocess.run(["zsh", "-n", str(self.folder / "zsh" / "_shakedown")], check=True)


if __name__ == "__main__":
    unittest.main()
