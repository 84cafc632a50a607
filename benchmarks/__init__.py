"""What acausal costs: compile time and run time over the size of a model, each beside code by hand.

Run one by ``python -m benchmarks.chain --n 10 100 1000``; all print a table, and one JSON line at the end.
"""

import os

os.environ.setdefault("ACAUSAL_COMPILATION_CACHE", "off")  # what compiling costs is measured
