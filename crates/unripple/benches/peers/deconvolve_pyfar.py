"""Deconvolution by pyfar. Arguments: channels, samples, runs, then rate, begin, end and seconds of an exponential sweep.

Every channel hears the sweep late by its own number of samples. Prints seconds of each run, from signals in time to
responses in time, and the sample at which each response is largest.
"""

import sys
import time
import warnings

import numpy as np
import pyfar

warnings.simplefilter("ignore")
channels, samples, runs = (int(a) for a in sys.argv[1:4])
rate, low, high, length = (float(a) for a in sys.argv[4:8])
growth = length / np.log(high / low)
t = np.arange(int(length * rate) + 1) / rate
sweep = np.sin(2.0 * np.pi * low * growth * (np.exp(t / growth) - 1.0))
fade_in, fade_out = 0.03, 0.002
sweep *= np.sin(np.pi / 2.0 * np.minimum(t / fade_in, 1.0)) ** 2
sweep *= np.sin(np.pi / 2.0 * np.clip((length - t) / fade_out, 0.0, 1.0)) ** 2
stimulus = np.zeros(samples)
stimulus[: len(sweep)] = sweep
heard = np.zeros((channels, samples))
for channel in range(channels):
    late = 10 + 7 * channel
    heard[channel, late : late + len(sweep)] = 0.5 * sweep[: samples - late]

seconds = []
for run in range(runs + 1):
    output, drive = pyfar.Signal(heard, rate), pyfar.Signal(stimulus, rate)
    start = time.perf_counter()
    responses = pyfar.dsp.deconvolve(output, drive, frequency_range=(low, high)).time
    seconds.append(time.perf_counter() - start)
print("seconds", *seconds[1:])
print("peaks", *np.argmax(responses, axis=-1))
