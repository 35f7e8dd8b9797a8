# SPDX-License-Identifier: MIT
"""What is simulated."""

import itertools
import os
from typing import Any, Callable, Mapping, Optional, Union

from . import _core
from ._toml import toml_of, words_of

Path = Union[str, "os.PathLike[str]"]
Force = Callable[[float, float, float], float]

_numbers = itertools.count(1)


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

    def with_force(self, force: Force, *, on: str = "box") -> "Setup":
        """Another setup with a force of your own, force(x, v, t) in N, for trying a law where speed does not matter.

        x, v, t   m, m/s, s: of the box in the lab (x = 0 where the spring is relaxed); on="grains": of each grain
        on        "box" or "grains"; on grains only the soft engine follows it

        It is the effect user_force with a name for a formula. The function stays in this process: such a setup can
        be written, and read here only. It is called from several threads, one at a time, ten thousand times for a
        second of motion (about 10 us each), by a diagnosis millions of times; an exception in it ends the work with
        PhysicsError.

        Raises InputError where it has no finite value at usual places, speeds and times, ValueError where the setup
        has a user_force already.
        """
        if "user_force" in self.effects:
            raise ValueError("the setup has a user_force already; add both forces in one function")
        name = f"python_{next(_numbers)}"
        _core.lend(name, force)
        return self.changed({"user_force.on": on, "user_force.force": f"{name}(x, v, t)"})

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
