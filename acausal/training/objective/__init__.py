"""The objective of a training: losses of predictions over a record, and penalties."""
