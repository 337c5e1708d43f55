"""Labelled arrays by xarray and data frames by pandas or polars, which are imported when they are first needed."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from unripple import _values
from unripple._errors import OptionError

if TYPE_CHECKING:
    import xarray as xr

    from unripple._responses import Responses

#: Tables of reports that stand for the whole, the first that is there.
_TABLES = (
    "each_number",
    "targets",
    "methods",
    "surfaces",
    "dispersion",
    "checks",
    "materials",
    "devices",
    "pings",
    "extremes",
    "faults",
    "actuators",
    "sections",
)

#: Endings of keys, longest first, and the units that they name.
UNITS = {
    "_n_s_per_m": "N s/m",
    "_n_per_m": "N/m",
    "_kg_m3": "kg/m3",
    "_n_m": "N m",
    "_m_s": "m/s",
    "_hz": "Hz",
    "_db": "dB",
    "_kg": "kg",
    "_pa": "Pa",
    "_m2": "m2",
    "_m": "m",
    "_s": "s",
    "_n": "N",
    "_w": "W",
    "_j": "J",
}


def needed(module: str, extra: str) -> Any:
    """Import a module that not everybody has."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        raise ImportError(f"{package} is needed for this: pip install 'unripple[{extra}]'") from error


def array(
    values: npt.NDArray[Any],
    dims: Sequence[str],
    coords: Mapping[str, Any],
    name: str,
    units: str,
    **attrs: Any,
) -> xr.DataArray:
    """Return a labelled array with units; so are its coordinates, which are places in m and times in s."""
    xarray = needed("xarray", "xarray")
    found: xr.DataArray = xarray.DataArray(values, dims=dims, coords=dict(coords), name=name)
    found.attrs.update({"units": units, "long_name": name.replace("_", " "), **attrs})
    for coord, of_coord in (("time", "s"), ("x", "m"), ("y", "m"), ("frequency", "Hz")):
        if coord in found.coords:
            found.coords[coord].attrs.update({"units": of_coord, "long_name": coord})
    return found


def dataset(arrays: Mapping[str, xr.DataArray], **attrs: Any) -> xr.Dataset:
    """Return labelled arrays together."""
    found: xr.Dataset = needed("xarray", "xarray").Dataset(dict(arrays), attrs=attrs)
    return found


def spread(
    values: npt.NDArray[Any], grid: tuple[int, int, float, float], inside: npt.NDArray[np.int64]
) -> npt.NDArray[Any]:
    """Return values of the points of a grid, of shape (..., points), on all its cells, (..., rows, columns); NaN outside."""
    columns, rows = grid[:2]
    shape = (*values.shape[:-1], rows, columns)
    if values.shape[-1] == rows * columns:
        return values.reshape(shape)
    empty = False if values.dtype == np.bool_ else np.nan
    cells = np.full((*values.shape[:-1], rows * columns), empty, dtype=values.dtype)
    cells[..., inside] = values
    return cells.reshape(shape)


def centres(grid: tuple[int, int, float, float]) -> dict[str, npt.NDArray[np.floating[Any]]]:
    """Return the centres of a grid's cells along y and x, in m."""
    columns, rows, width, height = grid
    return {"y": (np.arange(rows) + 0.5) * height, "x": (np.arange(columns) + 0.5) * width}


def responses(of: Responses) -> xr.Dataset:
    """Return responses with labels: their samples, or their modes."""
    actuators = {"actuator": of.names}
    sampled, points = of.array, of.points_m
    if sampled is not None and points is not None:
        times = np.arange(sampled.shape[2]) / of.rate_hz
        coords = {**actuators, "time": times, "x": ("point", points[:, 0]), "y": ("point", points[:, 1])}
        return dataset(
            {"h": array(sampled, ("point", "actuator", "time"), coords, "h", "")}, source=of.source
        )
    modes = {}
    for name, values, units in (
        ("frequency", of.frequencies_hz, "Hz"),
        ("decay_time", of.decay_times_s, "s"),
        ("input", of.input, ""),
    ):
        if values is not None:
            dims = ("mode",) if values.ndim == 1 else ("actuator", "mode")
            modes[name] = array(values, dims, {} if values.ndim == 1 else actuators, name, units)
    return dataset(modes, source=of.source)


def unit(key: str) -> str:
    """Return the unit that the ending of a key names; empty for a count, a ratio, a name or a text."""
    for ending, units in UNITS.items():
        if key.endswith(ending):
            return units
    return ""


def dataframe(data: Mapping[str, Any], key: str | None, library: str | None) -> Any:
    """Return a table of a report as a data frame."""
    columns = _columns(data, key)
    module = _frames(library)
    frame = module.DataFrame(columns)
    if module.__name__ == "pandas":
        frame.attrs["units"] = {name: unit(name.rpartition(".")[2]) for name in columns}
    return frame


def _frames(library: str | None) -> Any:
    if library is not None and _values.text("library", library) not in ("pandas", "polars"):
        raise OptionError(f"library: expected pandas or polars, found {library}")
    if library is None:
        has_polars = (
            importlib.util.find_spec("pandas") is None and importlib.util.find_spec("polars") is not None
        )
        library = "polars" if has_polars else "pandas"
    return needed(library, "table")


def _columns(data: Mapping[str, Any], key: str | None) -> dict[str, list[Any]]:
    """Return the columns of the table at a key, or of the report's own."""
    if key is not None:
        return _table(_at(data, _values.text("key", key)), key.rpartition(".")[2])
    for name in _TABLES:
        if _is_table(data.get(name)):
            return _table(data[name], name)
    lists = {name: value for name, value in data.items() if isinstance(value, list) and value}
    lengths = {
        len(value) for value in lists.values() if not any(isinstance(item, (dict, list)) for item in value)
    }
    if len(lengths) == 1 and len(lists) > 1:
        return {name: value for name, value in lists.items() if len(value) in lengths}
    return _table([{name: value for name, value in data.items() if name != "run"}], "")


def _at(data: Mapping[str, Any], key: str) -> Any:
    here: Any = data
    for step in key.split("."):
        if not isinstance(here, Mapping) or step not in here:
            raise OptionError(f"key: expected a key of the report, found {key}")
        here = here[step]
    return here


def _is_table(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(item, dict) for item in value)


def _table(value: Any, name: str) -> dict[str, list[Any]]:
    if isinstance(value, Mapping):
        value = [value]
    if not _is_table(value):
        return {name: value if isinstance(value, list) else [value]}
    rows = [_flat(item) for item in value]
    names = dict.fromkeys(key for row in rows for key in row)
    return {key: [row.get(key) for row in rows] for key in names}


def _flat(item: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return an object with the keys of objects in it beside its own, joined by dots."""
    found: dict[str, Any] = {}
    for key, value in item.items():
        if isinstance(value, Mapping):
            found.update(_flat(value, f"{prefix}{key}."))
        else:
            found[f"{prefix}{key}"] = value
    return found
