# SPDX-License-Identifier: MIT
"""What was measured: from an experiment file, from the tables of a tracking program, or from arrays and pandas' tables."""

import os
import tempfile
from typing import Any, Mapping, Optional, Protocol, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._setup import Path
from ._toml import toml_of

Array = npt.NDArray[np.float64]


class Table(Protocol):
    """What is needed of a pandas.DataFrame, which this module takes without importing pandas."""

    @property
    def columns(self) -> Any: ...
    @property
    def attrs(self) -> Any: ...
    def __getitem__(self, key: Any, /) -> Any: ...
    def to_csv(self, path: Any, /, *, index: bool) -> Any: ...


class MeasuredRun:
    """One film. Lab frame, x = 0 where the spring is relaxed, +x towards the release.

    name         of the run
    box_length   m; nan: as in the setup
    frame_rate   Hz
    time         s since release, shape (T)
    box          position of the box, m, shape (T); nan where it is missing
    centre       mean position of the grains, m, shape (T); None where it was not tracked
    """

    def __init__(self, found: Mapping[str, Any]) -> None:
        self.name: str = found["name"]
        self.box_length: float = found["box_length"]
        self.frame_rate: float = found["frame_rate"]
        self.time: Array = found["time"]
        self.box: Array = found["box"]
        self.centre: Optional[Array] = found["centre"]

    def __repr__(self) -> str:
        return f"<run {self.name}: {len(self.time)} frames, {self.time[0]:.3f} to {self.time[-1]:.3f} s>"


class Measurement:
    """Films of one damper, ready to be compared with a setup; made by measurement()."""

    def __init__(self, experiment: _core.Experiment, name: str) -> None:
        self._experiment = experiment
        self.name = name

    @property
    def title(self) -> str:
        return self._experiment.title

    @property
    def notes(self) -> list[str]:
        """What was assumed in reading, in words."""
        return self._experiment.notes

    @property
    def runs(self) -> list[MeasuredRun]:
        return [MeasuredRun(self._experiment.run(number)) for number in range(self._experiment.count())]

    def __repr__(self) -> str:
        return f"<shakedown.Measurement {self.title or self.name}: {', '.join(run.name for run in self.runs)}>"


def _column(folder: str, name: str, run: Mapping[str, Any]) -> dict[str, Any]:
    """Writes the arrays of a run as a table; returns what the experiment file says of it."""
    arrays = {key: np.asarray(run[key], dtype=float) for key in ("time", "box", "centre") if run.get(key) is not None}
    for key in ("time", "box"):
        if key not in arrays:
            raise ValueError(f"run {name}: {key} is missing; give an array of shape (T)")
    shapes = {key: array.shape for key, array in arrays.items()}
    if len(set(shapes.values())) != 1 or arrays["time"].ndim != 1:
        raise ValueError(f"run {name}: arrays must have one shape (T), and have {shapes}")
    with open(os.path.join(folder, name + ".csv"), "w", encoding="utf-8") as table:
        table.write(",".join(arrays) + "\n")
        for row in zip(*arrays.values()):
            table.write(",".join("" if np.isnan(value) else repr(float(value)) for value in row) + "\n")
    said = {key: value for key, value in run.items() if key not in ("time", "box", "centre")}
    if "centre" not in arrays:
        said["column"] = {"grain_centre": {"from": ""}}
    return {"file": name + ".csv", **said}


def _of_columns(run: Union[Mapping[str, Any], Table]) -> Mapping[str, Any]:
    """The run as a dictionary: of a pandas table the columns of that name and what its attrs say."""
    if isinstance(run, Mapping):
        return run
    return {**{key: run[key] for key in ("time", "box", "centre") if key in run.columns}, **run.attrs}


def _of_arrays(source: Mapping[str, Union[Mapping[str, Any], Table]], title: str, known: Mapping[str, Any], noise: str,
               centre_noise: str) -> Measurement:
    runs = {name: _of_columns(run) for name, run in source.items()}
    columns: dict[str, Any] = {"time": {"from": "time", "unit": "s"}, "box_position": {"from": "box", "unit": "m"}}
    if any(run.get("centre") is not None for run in runs.values()):
        columns["grain_centre"] = {"from": "centre", "unit": "m"}
        if centre_noise:
            columns["grain_centre"]["uncertainty"] = centre_noise
    if noise:
        columns["box_position"]["uncertainty"] = noise
    with tempfile.TemporaryDirectory() as folder:
        said = [_column(folder, name, run) for name, run in runs.items()]
        if "grain_centre" not in columns:
            for one in said:
                one.pop("column", None)
        document = {"title": title, "column": columns, "known": dict(known), "run": said}
        return Measurement(_core.Experiment.parse(toml_of(document), "measurement", folder), "measurement")


def _of_tables(source: Sequence[Union[Path, Table]], frame_rate: str, pixel: str, origin: str,
               lengths: Sequence[str]) -> Measurement:
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, table in enumerate(source, 1):
            if isinstance(table, (str, os.PathLike)):
                files.append(os.fspath(table))
                continue
            file = os.path.join(folder, f"{table.attrs.get('name', f'table_{number}')}.csv")
            table.to_csv(file, index=False)
            files.append(file)
        text, preview, questions = _core.import_tables(files, frame_rate, pixel, origin, list(lengths))
        if questions:
            raise ValueError("the tables do not say everything:\n  " + "\n  ".join(questions) + "\n" + preview)
        names = ", ".join(os.path.basename(file) if file.startswith(folder) else file for file in files)
        return Measurement(_core.Experiment.parse(text, "tables", os.getcwd()), names)


def measurement(source: Union[Path, Sequence[Union[Path, Table]], Mapping[str, Union[Mapping[str, Any], Table]]], *,
                title: str = "", known: Optional[Mapping[str, Any]] = None, noise: str = "", centre_noise: str = "",
                frame_rate: str = "", pixel: str = "", origin: str = "",
                lengths: Sequence[str] = ()) -> Measurement:
    """What was measured.

    source   an experiment file (TOML); or tables of a tracking program, one a run, whose columns are guessed
             (a list of paths or of pandas' tables, whose attrs["name"] names the run); or arrays, {"L040":
             {"time": t, "box": x, "centre": c, "box_length": "40 mm"}}: time in s since release, positions in m,
             each of shape (T), nan where a position is missing, centre (mean position of the grains) optional, and
             beside them any key of [[run]] in an experiment file; or pandas' tables that have these columns,
             {"L040": table}, the keys of [[run]] in its attrs; other columns of it are left out
    Of arrays also: title; known, what was weighed and measured ({"box.mass": "434 g +- 2 g"}); noise and
             centre_noise, standard deviation of one frame ("0.2 mm").
    Of tables also: frame_rate ("240 Hz"), pixel (length that one shows, "0.25 mm"), origin (what is read at rest,
             "640 px"), lengths of the box (one for all, or one a table).

    Raises InputError, FileError, ValueError for arrays of other shapes.
    """
    if isinstance(source, Mapping):
        return _of_arrays(source, title, known or {}, noise, centre_noise)
    if isinstance(source, (str, os.PathLike)):
        return Measurement(_core.Experiment.read(os.fspath(source)), os.fspath(source))
    return _of_tables(source, frame_rate, pixel, origin, lengths)
