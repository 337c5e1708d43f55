"""From a surface to a drive, what it does, a picture and a page: the first lines of docs/python.md."""

import numpy as np

import unripple as ur

film = ur.Surface("hudin-2012")  # built-in, file, TOML text or keywords
print(film.design())  # every tradeoff, with units
resp = film.responses()  # ur.open("measured") gives the same type
drive = resp.focus([(40, 50), (100, 90)], window_ms=30, method="concentrate", peak_um=40)
field = film.field(drive, fingers_mm=[(40, 50)])  # judged by other code than made it
print(field.report)  # contrast, spot, felt, per target
field.velocity.sel(time=drive.focal_time, method="nearest").plot()  # type: ignore[call-arg]
drive.to_wav("drive.wav")
print(np.asarray(drive).shape)  # actuators x samples
view = film.view(drive)  # in a browser, until it is closed or Python ends
print(view)
