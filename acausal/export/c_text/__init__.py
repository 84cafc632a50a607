"""C text from traced functions: arrays without storage, loops, memory, steps, and the files of a model."""
