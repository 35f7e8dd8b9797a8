# SPDX-License-Identifier: MIT
"""What is simulated."""

import os
from typing import Any, Mapping, Optional, Union

from . import _core
from ._toml import toml_of, words_of

Path = Union[str, "os.PathLike[str]"]


class Setup:
    """A damper as its owner states it: box, spring, grains, release, effects.

    source   a setup file (TOML), or a dictionary with the keys of one
             ({"box": {"length": "65 mm"}, "effect": [{"name": "grain_friction", "grain_grain": 0.2}]}),
             or nothing: the paper's damper, L = 40 mm
    set      keys to change: {"box.length": "65 mm", "grain_friction.grain_grain": 0.2}

    Raises InputError with everything that is wrong (in a file each with line and column), FileError.
    """

    def __init__(self, source: Union[Path, Mapping[str, Any], None] = None, *,
                 set: Optional[Mapping[str, Any]] = None) -> None:
        changes = words_of(set or {})
        if source is None or isinstance(source, Mapping):
            self.name = "setup"
            self._setup = _core.Setup.parse(toml_of(source or {}), "setup", changes)
        else:
            self.name = os.fspath(source)
            self._setup = _core.Setup.read(self.name, changes)

    @classmethod
    def _of(cls, setup: _core.Setup, name: str) -> "Setup":
        made = cls.__new__(cls)
        made._setup, made.name = setup, name
        return made

    def changed(self, set: Mapping[str, Any]) -> "Setup":
        """Another setup with these keys changed; raises InputError."""
        return Setup._of(self._setup.changed(words_of(set)), self.name)

    def __getitem__(self, key: str) -> float:
        """The value of a numeric key in SI: setup["box.length"] is 0.04 (m). Raises InputError for no such key."""
        return self._setup.number(key)

    @property
    def effects(self) -> list[str]:
        """Names of the effects beyond the plain model."""
        return self._setup.effects()

    @property
    def taken_from_paper(self) -> list[str]:
        """Keys that were left out and have the value of the paper's damper: "grains.mass = 4.04 g"."""
        return self._setup.taken_from_paper(False)

    @property
    def digest(self) -> str:
        """16 hexadecimal digits that change with anything that changes results."""
        return self._setup.digest()

    def to_toml(self) -> str:
        """The setup as a file has it; reads back to the same setup bit for bit."""
        return self._setup.toml()

    def write(self, file: Path) -> None:
        """Writes the setup file."""
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(self.to_toml())

    def __repr__(self) -> str:
        names = ", ".join(self.effects) or "plain"
        return f"<shakedown.Setup {self.name}: {names}, digest {self.digest}>"
