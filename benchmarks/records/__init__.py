"""Training on many, unequal and gappy records of the quarter vehicle."""
