"""What is minimised: losses of predictions over a record, and penalties."""
