"""A motor leads an arm along a course: a friction that was learned, in a model predictive controller."""
