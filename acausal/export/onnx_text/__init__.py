"""ONNX graphs: a traced function as nodes, operation by operation.

In: closed jaxprs. Out: messages of `onnx`.
It knows no model; the one list of operations is `table`.
"""

from acausal.export.onnx_text.message import model_of as model_of
