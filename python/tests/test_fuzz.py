"""Random arguments of random types to everything that is public: exceptions of ours alone, no panic, no abort."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

#: Seconds of calls where nothing else is asked for: a few of each.
_SECONDS = "4"

#: Lines that are shown of what was called last.
_LAST = 12


def test_random_arguments(folder: Path) -> None:
    seconds = os.environ.get("UNRIPPLE_FUZZ_S", _SECONDS)
    seed = os.environ.get("UNRIPPLE_SEED", "1")
    log = folder / "calls"
    script = Path(__file__).with_name("fuzzing.py")
    with log.open("w", encoding="utf-8") as told:
        done = subprocess.run(
            [sys.executable, "-X", "faulthandler", str(script), seconds, seed],
            stdout=told,
            stderr=subprocess.PIPE,
            text=True,
        )
    last = log.read_text(encoding="utf-8").splitlines()[-_LAST:]
    assert done.returncode == 0, "\n".join([f"UNRIPPLE_SEED={seed}", *last, done.stderr])
    assert "panicked" not in done.stderr, done.stderr
    print(last[-1])
