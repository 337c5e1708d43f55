"""The command line: `python -m unripple`, and the console script `unripple`."""

from __future__ import annotations

import os
import signal
import sys

from unripple import _unripple


def main() -> None:
    """Run the command line with the arguments of this process, and end with its exit status."""
    if sys.argv[1:2] == ["ask"]:
        # What `unripple optimise` starts; the command line itself has no optimisers.
        from unripple import _asking

        sys.exit(_asking.main(sys.argv[2:]))
    # It asks by this Python, not by the first that is found.
    os.environ.setdefault("UNRIPPLE_PYTHON", sys.executable)
    # Ctrl+C is the command line's own, as in the program; Python's handler would only be heard once the command is over.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_unripple.command_line(sys.argv[1:]))


if __name__ == "__main__":
    main()
