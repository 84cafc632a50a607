"""FMUs: the model description, and C files that give a model in C the functions of FMI 2 or FMI 3.

The `.c` and `.h` files here are copied into every FMU; `header.py` writes the one that fits them to a model.
"""
