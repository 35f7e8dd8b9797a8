# SPDX-License-Identifier: MIT
"""The questions, each as a function with the options of the command of its name."""

import json
import os
from typing import Any, Callable, Mapping, Optional, Sequence, Union

from . import _core
from ._measurement import Measurement, measurement
from ._results import Bounce, Comparison, Crosscheck, Diagnosis, Ensemble, Fit
from ._setup import Path, Setup

SetupLike = Union[Setup, Path, Mapping[str, Any]]
MeasurementLike = Union[Measurement, Path]
Progress = Optional[Callable[[str, float], object]]


def as_setup(setup: SetupLike) -> Setup:
    """The setup itself, or that of a file or a dictionary."""
    return setup if isinstance(setup, Setup) else Setup(setup)


def _measured(data: MeasurementLike) -> Measurement:
    return data if isinstance(data, Measurement) else measurement(data)


def _whole(name: str, value: int, least: int, most: int) -> int:
    if not least <= value <= most:
        raise ValueError(f"{name} is {value}; give a whole number from {least} to {most}")
    return value


def run(setup: SetupLike, *, engine: str = "hard", progress: Progress = None) -> Ensemble:
    """One run of a setup through an engine ("hard", "soft" or "bullet"); .runs[0] has its motion."""
    return ensemble(setup, 1, engine=engine, progress=progress)


def ensemble(setup: SetupLike, runs: int, *, engine: str = "hard", threads: int = 0,
             progress: Progress = None) -> Ensemble:
    """Runs that differ by their random numbers only.

    runs       how many, from 1
    threads    0: one for each core; results do not depend on it
    progress   called with a text and the fraction that is done, from this thread

    Raises InputError (an engine that does not model an effect of the setup), PhysicsError, KeyboardInterrupt.
    """
    of = as_setup(setup)
    return Ensemble(_core.simulate(of._setup, of.name, engine, _whole("runs", runs, 1, 1000000),
                                   _whole("threads", threads, 0, 1024), progress), of.name)


def crosscheck(setup: SetupLike, *, engines: Sequence[str] = ("hard", "soft"), runs: int = 8, threads: int = 0,
               progress: Progress = None) -> Crosscheck:
    """The setup through several engines: .holds where none of their numbers differ beyond the margins."""
    of = as_setup(setup)
    return Crosscheck(_core.crosscheck(of._setup, of.name, list(engines), _whole("runs", runs, 2, 1000000),
                                       _whole("threads", threads, 0, 1024), progress), of.name)


def compare(setup: SetupLike, data: MeasurementLike, *, engine: str = "hard", runs: int = 128, threads: int = 0,
            progress: Progress = None) -> Comparison:
    """Is the model acceptable for these measurements, and where does it fail? Nothing is fitted.

    runs   simulations of each different setup, from 16

    Raises InputError where no comparison makes sense, KeyboardInterrupt.
    """
    of, measured = as_setup(setup), _measured(data)
    return Comparison(_core.compare(of._setup, measured._experiment, engine, _whole("runs", runs, 16, 100000),
                                    _whole("threads", threads, 0, 1024), progress), measured.name)


def diagnose(setup: SetupLike, data: MeasurementLike, *, effects: Sequence[str] = (), fixed: Sequence[str] = (),
             budget: int = 0, seconds: float = 300, threads: int = 0, progress: Progress = None) -> Diagnosis:
    """Which physical effect is missing in the model, and how strong is it?

    effects   only these may be added; none: all that a diagnosis looks for
    fixed     not refitted, because known otherwise: restitution.grain_grain, restitution.grain_wall, spring.frequency
    budget    simulations at most; 0: 10000 for each different setup among the runs, for four at least
    seconds   at most, up to 1.6 times that beside other work

    Raises InputError, KeyboardInterrupt.
    """
    if not seconds > 0:
        raise ValueError(f"seconds is {seconds}; give a number above 0")
    of, measured = as_setup(setup), _measured(data)
    asked = _core.DiagnosisAsked(list(effects), list(fixed), budget, seconds, _whole("threads", threads, 0, 1024))
    return Diagnosis(_core.diagnose(of._setup, measured._experiment, asked, progress), measured.name)


def fit(setup: SetupLike, data: MeasurementLike, free: Union[str, Sequence[str]], *, on: Sequence[str] = (),
        restitution_curve: str = "", friction_curve: str = "", runs: int = 160, threads: int = 0,
        progress: Progress = None) -> Fit:
    """Parameters of the model from measurements, and the error on runs left out.

    free   keys to fit, starting at the setup's values; keys joined by & move together
    on     names of the runs to fit; the others are foretold; none: all are fitted
    runs   simulations of each different setup in a round, from 32
    restitution_curve  "all", "grains" or "walls": restitution of these contacts as a free function of the closing
                       speed, fitted too
    friction_curve     "all", "grains" or "walls": friction of these contacts as a free function of the slip speed,
                       fitted too, in a setup with friction whose coefficients are free; beside both curves a constant

    Raises InputError for a key that cannot be fitted, KeyboardInterrupt.
    """
    of, measured = as_setup(setup), _measured(data)
    keys = free if isinstance(free, str) else ",".join(free)
    asked = _core.FitAsked(keys, restitution_curve, friction_curve, list(on), _whole("runs", runs, 32, 100000),
                           _whole("threads", threads, 0, 1024))
    return Fit(_core.fit(of._setup, measured._experiment, asked, progress), measured.name)


def bounce(files: Union[Path, Sequence[Path]], *, recorded_as: str = "", columns: Sequence[str] = (), unit: str = "",
           rate: str = "", mass: str = "", diameter: str = "", height: str = "", timing: str = "", gravity: str = "",
           reference: str = "") -> Bounce:
    """From drops of a ball to the law of restitution; quantities are texts with their units.

    files          tables of intervals or instants of impacts, tracks of a falling ball, sounds (WAV, FLAC, OGG)
    recorded_as    "intervals", "instants", "track" or "sound"; else guessed
    columns        headers of the columns with times; else guessed
    unit, rate     of the times: "ms"; "240 Hz" where they are counts of a clock
    mass, diameter of the ball, for the drag of the air: "2.7 g", "40 mm"
    height         of the fall onto the first impact of every drop: "2.5 m +- 5 mm"
    timing         standard deviation of an instant: "0.1 ms"
    gravity        9.81 m/s^2 unless said
    reference      speed at which the restitution of a law is told; the middle of those measured unless said

    Raises InputError for a file that holds no drops, FileError.
    """
    given = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    asked = _core.DropQuestion()
    asked.files = [os.fspath(file) for file in given]
    asked.recorded_as, asked.columns, asked.unit, asked.rate = recorded_as, list(columns), unit, rate
    asked.mass, asked.diameter, asked.height, asked.timing = mass, diameter, height, timing
    asked.gravity, asked.reference = gravity, reference
    return Bounce(_core.bounce(asked), ", ".join(asked.files))


class EffectList:
    """The effects that a setup may add, or all about one of them; a list of dictionaries that prints as a table."""

    def __init__(self, name: str) -> None:
        self._records: list[dict[str, Any]] = json.loads(_core.effects_document(name))
        self._text = _core.effects_text(name)

    def __len__(self) -> int:
        return len(self._records)

    def __getitem__(self, number: int) -> dict[str, Any]:
        return self._records[number]

    @property
    def names(self) -> list[str]:
        return [record["name"] for record in self._records]

    def to_dict(self) -> dict[str, dict[str, Any]]:
        """Records by name: sentence, formula, source, limits, parameters with unit and bounds, engines."""
        return {record["name"]: record for record in self._records}

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return self._text


def effects(name: str = "") -> EffectList:
    """The effects that a setup may add; with a name all about that one. Raises InputError for no such effect."""
    return EffectList(name)
