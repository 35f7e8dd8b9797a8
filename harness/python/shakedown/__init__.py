# SPDX-License-Identifier: MIT
"""Which physical effect is missing in the model of a granular damper, and how strong is it?

    import shakedown
    setup = shakedown.Setup("setup.toml")
    films = shakedown.measurement("experiment.toml")
    answer = shakedown.diagnose(setup, films)
    print(answer)                  # as the command prints it
    answer.to_dict()["verdict"]    # every key of diagnosis.json
    answer                         # in a notebook: the page

Quantities are SI (m, s, kg, J, Hz) unless a key says otherwise (`_mm`); where a unit may be meant, texts such as
"65 mm" are taken. Long work runs without Python's lock, tells its progress, and stops at Ctrl-C with KeyboardInterrupt.
"""

from ._processor import faster_folder

__path__[:0] = faster_folder(__path__[0])  # the compiled part for this processor, where it is installed

from ._core import FileError, InputError, PhysicsError
from ._core import version_line as _version_line
from ._laboratory import Hidden, hide
from ._measurement import Measurement, measurement
from ._questions import (
    EffectList,
    bounce,
    compare,
    crosscheck,
    diagnose,
    effects,
    ensemble,
    fit,
    run,
)
from ._results import Answer, Bounce, Comparison, Crosscheck, Curve, Diagnosis, Ensemble, Fit, Run
from ._setup import Setup

__version__ = _version_line.split()[1]

__all__ = [
    "Answer",
    "Bounce",
    "Comparison",
    "Crosscheck",
    "Curve",
    "Diagnosis",
    "EffectList",
    "Ensemble",
    "FileError",
    "Fit",
    "Hidden",
    "InputError",
    "Measurement",
    "PhysicsError",
    "Run",
    "Setup",
    "bounce",
    "compare",
    "crosscheck",
    "diagnose",
    "effects",
    "ensemble",
    "fit",
    "hide",
    "measurement",
    "run",
]
