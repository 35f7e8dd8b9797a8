# SPDX-License-Identifier: MIT
"""What questions come to."""

import html
import json
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._setup import Path, Setup

Array = npt.NDArray[np.float64]


class Answer:
    """An answer: print() shows what the command prints, a notebook shows the page, to_dict() has every key of the JSON.

    holds   the model holds, or the engines agree: what the command's exit code 0 says
    """

    def __init__(self, answer: _core.Answer, name: str) -> None:
        self._answer = answer
        self._name = name
        self._document: Optional[dict[str, Any]] = None
        self._page: Optional[str] = None

    @property
    def holds(self) -> bool:
        return self._answer.holds

    def to_dict(self) -> dict[str, Any]:
        """The results as the command writes them with --json. None: there is no such number."""
        if self._document is None:
            document: dict[str, Any] = json.loads(self._answer.document)
            if self._answer.taken_from_paper is not None:
                document["taken_from_paper"] = self._answer.taken_from_paper
            self._document = document
        return self._document

    def page(self) -> str:
        """The page as one HTML text that needs nothing else. Its curves may be simulated now, which takes seconds."""
        if self._page is None:
            self._page = self._answer.page()
        return self._page

    def write_page(self, file: Path) -> None:
        """Writes the page, as --report does."""
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(self.page())

    def _repr_html_(self) -> str:
        # A page of its own, with its own rules of what it may do.
        return (f'<iframe sandbox="allow-scripts allow-downloads" style="width:100%;height:48em;border:1px solid #ccc" '
                f'srcdoc="{html.escape(self.page(), quote=True)}"></iframe>')

    def __str__(self) -> str:
        return self._answer.text

    def __repr__(self) -> str:
        return f"<shakedown.{type(self).__name__} of {self._name}>"


class Run:
    """The motion of one run. T samples at run.sample_rate, lab frame, SI.

    time, box, box_velocity, centre   s, m, m/s, m; shape (T); centre: mass-weighted mean of the grains, nan without
    energy                            J, spring, box and grains; shape (T)
    loss                              J, cumulative, shape (3, T): between grains, at end walls, at side walls
    peak_time, peak                   s, m (signed); shape (P); one extremum a half period, the release excluded
    zero_crossings                    s, shape (C)
    frequency, slope                  Hz; m/s, of |peaks| against time; nan where there is none
    first_small_peak                  s, of the first peak below 9.3 % of the release; nan where there is none
    """

    def __init__(self, motion: dict[str, Any], observed: dict[str, Any]) -> None:
        self.time: Array = motion["time"]
        self.box: Array = motion["box"]
        self.box_velocity: Array = motion["box_velocity"]
        self.centre: Array = motion["centre"]
        self.energy: Array = motion["energy"]
        self.loss: Array = motion["loss"]
        self.peak_time: Array = observed["peak_time"]
        self.peak: Array = observed["peak"]
        self.zero_crossings: Array = observed["zero_crossings"]
        self.frequency: float = observed["frequency"]
        self.slope: float = observed["slope"]
        self.first_small_peak: float = observed["first_small_peak"]

    def __repr__(self) -> str:
        return f"<run of {self.time[-1]:.3f} s, {len(self.time)} samples, {len(self.peak)} peaks>"


class Ensemble(Answer):
    """Runs of one setup that differ by their random numbers only.

    runs     each with its motion, in the order of their numbers
    time     s, shape (T)
    box      m, shape (N, T); likewise centre (m) and energy (J)
    mean and spread over the runs: .box.mean(axis=0), .box.std(axis=0, ddof=1)
    """

    def __init__(self, simulated: _core.Simulated, name: str) -> None:
        super().__init__(simulated.answer, name)
        self.runs = [Run(simulated.motion(number), simulated.observed(number)) for number in range(simulated.count())]

    @property
    def time(self) -> Array:
        return self.runs[0].time

    @property
    def box(self) -> Array:
        return np.array([run.box for run in self.runs])

    @property
    def centre(self) -> Array:
        return np.array([run.centre for run in self.runs])

    @property
    def energy(self) -> Array:
        return np.array([run.energy for run in self.runs])


class Curve:
    """One run beside the model, as a camera saw it. SI.

    run, observable   name of the run; "box" or "centre" (of the grains)
    time              s, shape (T)
    measured, model   m, shape (T); model: mean of the model that was judged, of a diagnosis the final one
    as_given          m, shape (T); of a diagnosis the model that it began with
    residual          m, measured less model, shape (T)
    spread            m, standard deviation of the residual of a right model, shape (T)
    A number that there is not is nan, and an array all nan where there is none.
    """

    def __init__(self, curve: dict[str, Any]) -> None:
        def metres(name: str) -> Array:
            return 1e-3 * np.asarray(curve.get(name + "_mm", [None] * len(self.time)), dtype=float)

        self.run: str = curve["run"]
        self.observable: str = curve["observable"]
        self.time: Array = np.asarray(curve["time_s"], dtype=float)
        self.measured, self.model, self.as_given = metres("measured"), metres("model"), metres("as_given")
        self.residual, self.spread = metres("residual"), metres("spread")

    def __repr__(self) -> str:
        return f"<{self.observable} of {self.run} beside the model: {len(self.time)} points>"


class _WithCurves(Answer):
    @property
    def curves(self) -> list[Curve]:
        """Of each run the box and, where it was seen, the grains' centre beside the model, as arrays."""
        return [Curve(one) for one in self.to_dict()["curves"]]


class Comparison(_WithCurves):
    """Is the model acceptable for these measurements, and where does it fail?"""

    @property
    def p_value(self) -> float:
        """Of the whole measurement; nan for an empty box, which is judged by its waveform (see reason)."""
        found = self.to_dict()["p_value"]
        return float("nan") if found is None else float(found)

    @property
    def reason(self) -> str:
        """Why the model holds, fails, or is undecided."""
        return str(self.to_dict()["reason"])


class _WithSetup(Answer):
    @property
    def setup(self) -> Setup:
        """The amended or fitted setup."""
        found = self._answer.setup
        assert found is not None
        return Setup._of(found, f"{type(self).__name__.lower()} of {self._name}")


class Diagnosis(_WithSetup, _WithCurves):
    """Which physical effect is missing in the model, and how strong is it?"""

    @property
    def verdict(self) -> str:
        """adequate, refit, measurement, missing or unknown."""
        return str(self.to_dict()["verdict"])

    @property
    def sentence(self) -> str:
        return str(self.to_dict()["sentence"])

    @property
    def missing(self) -> list[str]:
        """Names of the effects that were added, or that are most probable (to_dict()["not_fitted"])."""
        return list(self.to_dict()["missing"])

    @property
    def parameters(self) -> dict[str, dict[str, Any]]:
        """By key: value, low and high (95 %), in SI."""
        return dict(self.to_dict()["parameters"])

    @property
    def hypotheses(self) -> list[dict[str, Any]]:
        """Sets of effects with their probability, most probable first."""
        return list(self.to_dict()["hypotheses"])


class Fit(_WithSetup):
    """Parameters of the model with 95 % intervals, and the error on runs left out."""

    @property
    def parameters(self) -> dict[str, dict[str, Any]]:
        """By key: value, low and high (95 %) in the unit that stands beside them; told: whether the data tell it."""
        return {one["key"]: one for one in self.to_dict()["parameters"]}


class Crosscheck(Answer):
    """One setup through several engines: what each makes of it, and where they agree."""


class Bounce(Answer):
    """The law of restitution from drops of a ball."""

    @property
    def sentence(self) -> str:
        return str(self.to_dict()["sentence"])
