"""One mutant by itself, with its traceback: ``python -m tests.fuzz calls 17``."""

import sys
import tempfile
import traceback
from pathlib import Path

from .outcome import drive, outcome
from .test_wrong import MAKERS

name, seed = sys.argv[1], int(sys.argv[2])
with tempfile.TemporaryDirectory() as folder:
    mutant = MAKERS[name][0](seed, Path(folder))
    print(outcome(mutant))  # noqa: T201 (a command)
    try:
        drive(mutant.make(), seed)
    except Exception:
        traceback.print_exc()
