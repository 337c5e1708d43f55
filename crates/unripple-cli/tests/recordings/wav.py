"""WAV files in numpy alone: integers of 8 to 32 bits, float32 and float64."""

import struct

import numpy as np

KINDS = {"int8": (1, 8), "int16": (1, 16), "int24": (1, 24), "int32": (1, 32), "float32": (3, 32), "float64": (3, 64)}


def write(path, lines, rate, kind="float32"):
    """Writes lines `[channel][sample]`, full scale being 1; integers are rounded, without dither."""
    tag, bits = KINDS[kind]
    frames = np.ascontiguousarray(np.asarray(lines, float).T)
    if tag == 3:
        data = frames.astype(f"<f{bits // 8}").tobytes()
    else:
        full = 2.0 ** (bits - 1)
        whole = np.clip(np.round(frames * full), -full, full - 1).astype(np.int64)
        if bits == 8:
            data = (whole + 128).astype(np.uint8).tobytes()
        elif bits == 24:
            data = whole.astype("<i4").view(np.uint8).reshape(-1, 4)[:, :3].tobytes()
        else:
            data = whole.astype(f"<i{bits // 8}").tobytes()
    channels, width = frames.shape[1], bits // 8
    form = struct.pack("<HHIIHH", tag, channels, round(rate), round(rate) * channels * width, channels * width, bits)
    body = b"WAVEfmt " + struct.pack("<I", len(form)) + form + b"data" + struct.pack("<I", len(data)) + data
    with open(path, "wb") as file:
        file.write(b"RIFF" + struct.pack("<I", len(body)) + body)


def read(path):
    """Lines `[channel][sample]` and the rate of a file of float32 or float64, as the program writes."""
    with open(path, "rb") as file:
        raw = file.read()
    at, form, data = 12, None, b""
    while at + 8 <= len(raw):
        name, size = raw[at : at + 4], struct.unpack("<I", raw[at + 4 : at + 8])[0]
        if name == b"fmt ":
            form = struct.unpack("<HHIIHH", raw[at + 8 : at + 24])
        elif name == b"data":
            data = raw[at + 8 : at + 8 + size]
        at += 8 + size + size % 2
    width = form[5] // 8
    if form[5] not in (32, 64):
        raise ValueError(f"{path}: expected floats, found {form[5]} bits")
    frames = np.frombuffer(data[: len(data) // (width * form[1]) * width * form[1]], f"<f{width}")
    return frames.reshape(-1, form[1]).T.astype(float), float(form[2])
