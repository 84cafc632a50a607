from .c_file import c as c
from .casadi_function import casadi as casadi
from .fmu_file import fmu as fmu
from .modelica_file import modelica as modelica
from .onnx_file import onnx as onnx
from .stablehlo_file import stablehlo as stablehlo
