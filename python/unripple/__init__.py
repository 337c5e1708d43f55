"""Waves that meet under a fingertip: design, simulate, measure, focus and play a reverberant touch surface."""

from unripple import _unripple
from unripple._animation import Animation
from unripple._drive import Drive
from unripple._drives import field, focus, stroke, waveform
from unripple._errors import (
    AskError,
    Cancelled,
    Fault,
    InputError,
    OptionError,
    SurfaceError,
    UnrippleError,
    UnrippleWarning,
    WorkError,
)
from unripple._field import Field
from unripple._frequencies import fit_modes, listen
from unripple._importing import import_measurements
from unripple._libraries import calibrate, export, fit, open, respond
from unripple._lists import builtin, commands, devices, effects, materials
from unripple._motion import FingerMotion, Snapshots, Traces
from unripple._player import Felt, Player
from unripple._progress import set_progress, set_threads
from unripple._report import Report
from unripple._responses import Responses
from unripple._searching import optimise
from unripple._surface import Surface
from unripple._tasks import (
    check,
    compare,
    design,
    doctor,
    drift,
    modes,
    place,
    play,
    reproduce,
    rerun,
    run,
    sensors,
    sweep,
)
from unripple._verifying import verify
from unripple._view import View
from unripple._virtual import VirtualSurface

__all__ = [
    "Animation",
    "AskError",
    "Cancelled",
    "Drive",
    "Fault",
    "Felt",
    "Field",
    "FingerMotion",
    "InputError",
    "OptionError",
    "Player",
    "Report",
    "Responses",
    "Snapshots",
    "Surface",
    "SurfaceError",
    "Traces",
    "UnrippleError",
    "UnrippleWarning",
    "View",
    "VirtualSurface",
    "WorkError",
    "__version__",
    "builtin",
    "calibrate",
    "check",
    "commands",
    "compare",
    "design",
    "devices",
    "doctor",
    "drift",
    "effects",
    "export",
    "field",
    "fit",
    "fit_modes",
    "focus",
    "import_measurements",
    "listen",
    "materials",
    "modes",
    "open",
    "optimise",
    "place",
    "play",
    "reproduce",
    "rerun",
    "respond",
    "run",
    "sensors",
    "set_progress",
    "set_threads",
    "stroke",
    "sweep",
    "verify",
    "waveform",
]

#: Version of the package and of the program in it.
__version__ = _unripple.version()


def __dir__() -> list[str]:
    # What is public; the modules beneath are nobody's.
    return [*__all__, "__doc__", "__file__", "__name__", "__path__"]
