"""A plant that comes as an FMU: its spring is measured and a friction beside it learned, from one record."""
