# SPDX-License-Identifier: MIT
"""Which compiled part of the module this processor can take."""

import os
import pathlib

LEVEL = "x86-64-v3"
# As Linux names what the level has beyond x86-64-v2; "abm" is LZCNT.
NEEDED = frozenset({"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"})


def has_level(cpuinfo: str) -> bool:
    """Whether every processor of this text, as /proc/cpuinfo has it, has all of the level."""
    flags = [set(line.partition(":")[2].split()) for line in cpuinfo.splitlines() if line.startswith("flags")]
    return bool(flags) and all(NEEDED <= one for one in flags)


def faster_folder(package: str) -> list[str]:
    """The folder with the compiled part for this processor: none, or one to be searched before the package's own.

    The environment variable SHAKEDOWN_PORTABLE keeps to the part that runs on any x86-64.
    """
    folder = pathlib.Path(package) / LEVEL
    if "SHAKEDOWN_PORTABLE" in os.environ or not folder.is_dir():
        return []
    try:
        cpuinfo = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return []
    return [str(folder)] if has_level(cpuinfo) else []
