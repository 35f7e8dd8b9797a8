# SPDX-License-Identifier: MIT
"""The table of what Python reaches names every command and option that the program has, and arguments that the functions have."""

import inspect
import re
import subprocess
import unittest

import shakedown
from project import ROOT, SHAKEDOWN

OF_ALL = {"--help", "--set", "--rate", "--seed", "--strict", "--json", "--report"}


def help_of(*words):
    return subprocess.run([SHAKEDOWN, *words, "--help"], capture_output=True, text=True, check=True).stdout


def commands():
    return re.findall(r"^  ([a-z-]+) ", help_of().split("Subcommands:")[1].split("Exit codes:")[0], re.M)


def rows():
    """Cells of the table by command."""
    table = (ROOT / "harness/python/README.md").read_text(encoding="utf-8").split("| command | Python |")[1].split("\n\n")[0]
    found = {}
    for line in table.splitlines()[2:]:
        cells = line.strip("|").split("|")
        for command in re.findall(r"`([a-z-]+)`", cells[0]):
            found[command] = cells
    return found


class Reach(unittest.TestCase):
    def test_the_table_has_the_commands_of_the_program(self):
        self.assertEqual(sorted(rows()), sorted(commands()))

    def test_each_option_is_reached_or_said_not_to_be(self):
        for command, (_, calls, arguments, without) in rows().items():
            if without.strip() == "all":
                continue
            options = set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", help_of(command), re.M))
            named = set(re.findall(r"--[a-z-]+", arguments + without))
            self.assertEqual(options - OF_ALL, named - OF_ALL, command)
            functions = [getattr(shakedown, name) for name in re.findall(r"`(\w+)\(", calls)]
            known = {name for function in functions for name in inspect.signature(function).parameters}
            self.assertTrue(known or command == "effects", command)
            for option, argument in re.findall(r"`(--[a-z-]+)` `(\w+)=`", arguments):
                self.assertIn(argument, known, f"{command} {option}")


if __name__ == "__main__":
    unittest.main()
