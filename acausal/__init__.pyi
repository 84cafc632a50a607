from . import networks as networks
from ._jax import use_compilation_cache as use_compilation_cache
from .analysis import (
    Distilled as Distilled,
    Formula as Formula,
    Linearization as Linearization,
    distill as distill,
    linearize as linearize,
)
from .data import (
    Data as Data,
    Signal as Signal,
    load_params as load_params,
    save_params as save_params,
)
from .errors import (
    AcausalError as AcausalError,
    ConnectionError as ConnectionError,
    DataError as DataError,
    DeclarationError as DeclarationError,
    InitializationError as InitializationError,
    ModelError as ModelError,
    SimulationError as SimulationError,
    StructureError as StructureError,
    TrainingError as TrainingError,
    UnitError as UnitError,
)
from .initialization import Initialization as Initialization
from .modeling import (
    Abs as Abs,
    Budget as Budget,
    Component as Component,
    Connector as Connector,
    Eq as Eq,
    Flow as Flow,
    InitialParameter as InitialParameter,
    Input as Input,
    Module as Module,
    Option as Option,
    Output as Output,
    Parameter as Parameter,
    Potential as Potential,
    Start as Start,
    Variable as Variable,
    acos as acos,
    asin as asin,
    asinh as asinh,
    atan as atan,
    atan2 as atan2,
    cos as cos,
    cosh as cosh,
    der as der,
    exp as exp,
    floor as floor,
    log as log,
    maximum as maximum,
    minimum as minimum,
    pi as pi,
    prescribed as prescribed,
    sign as sign,
    sin as sin,
    sinh as sinh,
    sqrt as sqrt,
    tan as tan,
    tanh as tanh,
    time as time,
    where as where,
)
from .netlist import NetlistError as NetlistError, load as load, save as save
from .networks import MLP as MLP, OffsetCorrected as OffsetCorrected, remove_offset as remove_offset
from .reporting import diagram as diagram
from .simulation import Solution as Solution, simulate as simulate
from .system import System as System, compile as compile
from .training import (
    Bounded as Bounded,
    CrossValidation as CrossValidation,
    CsvLog as CsvLog,
    DampingRatio as DampingRatio,
    Delay as Delay,
    Ensemble as Ensemble,
    Fit as Fit,
    FrequencyRange as FrequencyRange,
    Huber as Huber,
    Lag as Lag,
    Likelihood as Likelihood,
    Profile as Profile,
    RecordFit as RecordFit,
    Shift as Shift,
    SmallCorrection as SmallCorrection,
    Stability as Stability,
    Student as Student,
    TensorBoardLog as TensorBoardLog,
    ZeroCrossing as ZeroCrossing,
    cross_validate as cross_validate,
    ensemble as ensemble,
    fit as fit,
    lbfgs as lbfgs,
)

__version__: str
