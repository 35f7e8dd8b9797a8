# SPDX-License-Identifier: MIT
"""Measurements with something hidden in them, to try a diagnosis on."""

import json
import os
from typing import Any, Mapping, Optional, Sequence, Union

from . import _core
from ._measurement import Measurement
from ._questions import Progress, SetupLike, as_setup
from ._setup import Path, Setup
from ._toml import words_of


class Hidden:
    """What a laboratory measured. Look at truth only after the diagnosis is made.

    measurement   the films
    setup         what the user believes
    """

    def __init__(self, hidden: _core.Hidden, name: str) -> None:
        self._hidden = hidden
        self.measurement = Measurement(hidden.experiment, "hidden")
        self.setup = Setup._of(hidden.believed, name)

    @property
    def truth(self) -> dict[str, Any]:
        """What is hidden, as truth.json has it."""
        found: dict[str, Any] = json.loads(self._hidden.truth())
        return found

    def write(self, folder: Path, truth: Optional[Path] = None) -> None:
        """Writes setup.toml, experiment.toml and the tables into the folder; the answer into truth.json there, or elsewhere."""
        where = os.fspath(folder)
        self._hidden.write(where, os.path.join(where, "truth.json") if truth is None else os.fspath(truth))

    def __repr__(self) -> str:
        return f"<shakedown.Hidden in {len(self.measurement.runs)} runs of {self.setup.name}>"


def hide(setup: SetupLike, effect: Union[str, Sequence[str]] = (), *, set: Optional[Mapping[str, Any]] = None,
         lengths: Sequence[str] = ("40mm", "40mm", "65mm", "85mm", "104mm"), runs: Sequence[str] = (),
         camera: Sequence[str] = (), known: Sequence[str] = (), duration: str = "", title: str = "",
         engine: str = "soft", seed: int = 1, threads: int = 0, progress: Progress = None) -> Hidden:
    """A laboratory measures the damper as it truly is; texts are those of the options of `shakedown hide`.

    effect     hidden at its typical strength, "grain_friction", or "clamp_dry_friction=force:15 mN"; or several
    set        what else is different in the laboratory: {"restitution.grain_grain": 0.7}
    lengths    of the box, one a run; () for none
    runs       more runs with keys of their own: "box.length=40mm,grains.count=0"
    camera     "noise.box=0.3 mm", "fps=250", "lens=0.5%" and so on
    known      what the experimenter knows: "box.mass=434 g +- 2 g"
    duration   of each run, "20 s"; the setup's unless said

    Raises InputError with everything that is wrong, KeyboardInterrupt.
    """
    of = as_setup(setup)
    asked = _core.HiddenQuestion()
    asked.effects = [effect] if isinstance(effect, str) else list(effect)
    asked.parameters = words_of(set or {})
    asked.lengths, asked.runs = ",".join(lengths), list(runs)
    asked.camera, asked.known = list(camera), list(known)
    asked.duration, asked.title, asked.engine = duration, title, engine
    asked.seed, asked.threads = seed, threads
    return Hidden(_core.hide(of._setup, asked, progress), of.name)
