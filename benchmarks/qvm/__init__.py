"""One gradient of the quarter vehicle, by the framework and by others: `python -m benchmarks.qvm`."""
