"""Optimizers, and one update of a training."""
