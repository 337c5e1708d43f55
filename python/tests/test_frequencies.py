"""Surfaces known by frequencies: forms of options, a knock written here, and a surface fitted to what is heard of it."""

from __future__ import annotations

import math
import wave
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import unripple as ur
from unripple._call import Call

#: The copper plate of the guide, clamped along one long side.
_COPPER = """
format = 1
name = "copper plate"
[outline]
rectangle_mm = [100, 80]
edge = ["clamped", "free", "free", "free"]
[sheet]
material = "copper"
young_gpa = 120
density_kg_m3 = 8765
poisson_ratio = 0.33
thickness_mm = 0.81
loss_factor = 0.001
[drive]
band_hz = [0, 2000]
sample_rate_hz = 48000
[[actuator]]
at_mm = [50, 40]
"""


def _asked(**options: Any) -> dict[str, Any]:
    return Call("fit_modes", options).ask


def test_forms_of_frequencies() -> None:
    plain = {"modes": [{"frequency_hz": 73.2}, {"frequency_hz": 148.0, "decay_time_s": 0.035}]}
    assert _asked(modes=[73.2, (148, 35)]) == plain == _asked(modes="73.2,148:35")
    assert _asked(modes=np.array([73.2])) == {"modes": [{"frequency_hz": 73.2}]} == _asked(modes=73.2)
    factor = _asked(modes="100:Q50")["modes"][0]
    assert factor["decay_time_s"] == pytest.approx(50 / (math.pi * 100))
    assert _asked(modes=[73.2], error_percent=3, free="tension,modulus")["free"] == ["tension", "modulus"]


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"modes": []}, "modes"),
        ({"modes": [-3]}, "modes"),
        ({"modes": "a"}, "modes"),
        ({"modes": [100], "error_percent": 50}, "error_percent"),
        ({"modes": [100], "free": "colour"}, "free"),
        ({"modes": [100], "free": "tension"}, "free"),
    ],
)
def test_errors_name_what_was_typed(options: dict[str, Any], field: str) -> None:
    with pytest.raises(ur.AskError) as raised:
        ur.fit_modes(_COPPER, **options)
    assert raised.value.field == field


def test_a_knock_is_heard_and_a_plate_is_fitted(tmp_path: Path) -> None:
    rate = 16000
    time = np.arange(2 * rate) / rate
    sound = 0.002 * np.random.default_rng(1).standard_normal(2 * rate)
    measured = {73.2: 250, 148.0: 200, 376.0: 100, 431.0: 90, 559.0: 70, 910.0: 50}
    ringing = time >= 0.2
    for hz, ms in measured.items():
        since = time[ringing] - 0.2
        sound[ringing] += 0.1 * np.exp(-since / (1e-3 * ms)) * np.sin(2 * np.pi * hz * since)
    file = tmp_path / "knock.wav"
    with wave.open(str(file), "wb") as written:
        written.setparams((1, 2, rate, len(sound), "NONE", ""))
        written.writeframes((32767 * sound).astype("<i2").tobytes())
    heard = ur.listen(file, band_hz=(40, 2000))
    assert [mode.frequency_hz for mode in heard.modes] == pytest.approx(list(measured), rel=2e-3)
    assert [1e3 * mode.decay_time_s for mode in heard.modes] == pytest.approx(
        list(measured.values()), rel=0.1
    )
    fitted = ur.fit_modes(
        _COPPER, heard.modes_text, error_percent=3, output=tmp_path / "fitted", no_figures=True
    )
    (modulus,) = fitted.quantities
    assert modulus.quantity == "modulus" and modulus.value == pytest.approx(98e9, rel=0.03)
    assert any(other.mirrored for other in fitted.others) and fitted.losses.loss_factor > 0
    assert ur.Surface(tmp_path / "fitted" / "fitted.toml").toml == ur.Surface(fitted.surface_toml).toml
