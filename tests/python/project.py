# SPDX-License-Identifier: MIT
"""Where things are."""

import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(os.environ["PROJECT_ROOT"])
SHAKEDOWN = os.environ["SHAKEDOWN"]
L040 = ROOT / "harness/examples/L040.toml"
LEAF_SPRING = ROOT / "tests/data/leaf_spring"


def by_command(*words):
    """What the command line gives as JSON."""
    done = subprocess.run([SHAKEDOWN, *map(str, words), "--json"], capture_output=True, text=True, check=False)
    return json.loads(done.stdout)
