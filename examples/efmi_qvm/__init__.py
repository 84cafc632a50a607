"""The authors' own test case, M11_NeuralQVM of the eFMI project: `python -m examples.efmi_qvm`."""
