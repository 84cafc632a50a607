"""How it is minimised: optimizers, and one update of a training."""
