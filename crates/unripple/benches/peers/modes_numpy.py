"""Modes by plain numpy: arguments are the count of modes and of runs. Prints seconds of each run, frequencies in Hz."""

import sys
import time

from ritz import Ritz, film

count, runs = int(sys.argv[1]), int(sys.argv[2])
seconds = []
for _ in range(runs + 1):
    start = time.perf_counter()
    frequencies = Ritz(34, *film()).frequencies_hz()[:count]
    seconds.append(time.perf_counter() - start)
print("seconds", *seconds[1:])
print("hz", *frequencies)
