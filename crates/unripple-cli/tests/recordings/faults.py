"""All that goes wrong on a bench, each in three strengths."""

import of_cables  # noqa: F401
import of_files  # noqa: F401
import of_flows  # noqa: F401
import of_sheet  # noqa: F401
import of_sound  # noqa: F401
from registry import FAULTS, made  # noqa: F401
