"""Stiff models of any size, beside SUNDIALS' CVODE and scipy's Radau on the same right-hand sides."""

import os

# SuperLU's threads in CVODE cost it half a second a run, for any of these sizes; it is faster with one.
os.environ.setdefault("OMP_NUM_THREADS", "1")
