"""Places of sensors and taps: forms of options, errors in the names that were typed, and the report."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import unripple as ur
from unripple._call import Call

#: What takes no time on the film.
_SMALL: dict[str, Any] = {"count": 2, "grid_mm": 25, "profile": 0, "restarts": 1}


def _asked(**options: Any) -> dict[str, Any]:
    return Call("sensors", options).ask


def test_options() -> None:
    assert _asked(taps=True) == {"sensing": "taps"} == _asked(sensing="taps")
    assert _asked(taps=False) == {}
    wanted = {"keep_m": [[0.01, 0.02]], "pitch_m": 0.002, "apart_m": 0.005, "snr_db": 40}
    assert _asked(keep=(10, 20), grid_mm=2, apart_mm=5, snr_db=40) == wanted
    assert _asked(keep_m=np.array([[0.01, 0.02]]), pitch_m=0.002, apart_m=0.005, snr_db=40) == wanted


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"count": 0}, "count"),
        ({"keep": (300, 90)}, "keep"),
        ({"rim_mm": (12, 6)}, "rim_mm"),
        ({"apart_mm": -1}, "apart_mm"),
        ({"snr_db": 1000}, "snr_db"),
        ({"profile": 9}, "profile"),
        ({"grid_mm": None, "place": [(10, 20)]}, "count, place"),
    ],
)
def test_errors_name_what_was_typed(film: ur.Surface, options: dict[str, Any], field: str) -> None:
    with pytest.raises(ur.AskError) as raised:
        film.sensors(**{**_SMALL, **options})
    assert raised.value.field == field


def test_what_is_measured_already_need_not_be_measured_again(film: ur.Surface) -> None:
    alone = film.sensors(**_SMALL)
    beside = film.sensors(**_SMALL, keep=[[1e3 * x for x in at] for at in alone.at_m])
    assert np.array(beside.kept_m) == pytest.approx(np.array(alone.at_m))
    deviations = [{unknown.name: unknown.planned for unknown in report.unknowns} for report in (alone, beside)]
    assert all(deviations[1][name] < deviation for name, deviation in deviations[0].items())
    table = beside.to_dataframe()
    assert list(table["places"]) == [1, 2, 3, 4]
