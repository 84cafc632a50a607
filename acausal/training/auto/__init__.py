"""Fits without options: scales, a linear start, steps and stages from the data, and a verdict on what came of it."""
