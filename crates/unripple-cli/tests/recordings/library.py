"""What is stored in a library, read without the program: Zarr, version 3, raw chunks with a checksum at the end."""

import json
from pathlib import Path

import numpy as np

# The state of a point that was measured and is good.
MEASURED = 1


def array(path, kind):
    """A small array of one or two axes, all its chunks lying along the first."""
    told = json.loads((Path(path) / "zarr.json").read_text())
    rows, shape = told["chunk_grid"]["configuration"]["chunk_shape"][0], told["shape"]
    found = np.zeros((-(-shape[0] // rows) * rows, *shape[1:]), kind)
    for chunk in Path(path).glob("c.*"):
        first = int(chunk.name.split(".")[1]) * rows
        found[first : first + rows] = np.frombuffer(chunk.read_bytes()[:-4], kind).reshape(rows, *shape[1:])
    return found[: shape[0]]


def number(library, at):
    """The number of the measured, good point at a place; None if there is none."""
    try:
        places, states = array(library / "position", "<f8"), array(library / "state", "u1")
    except OSError:
        return None
    for point, (place, state) in enumerate(zip(places, states)):
        if state == MEASURED and np.hypot(*(place - at)) < 1e-6:
            return point
    return None


def response(library, point):
    """Responses of a point, all actuators one after the other."""
    raw = (Path(library) / "responses" / f"c.{point}.0.0").read_bytes()
    return np.nan_to_num(np.frombuffer(raw[:-4], "<f4").astype(float))


def level(library, point, other, there):
    """How loud the responses of a point are, over those of a point of another library."""
    here, there = response(library, point), response(other, there)
    return float(np.sqrt((here**2).sum() / (there**2).sum()))
