from . import export as export, networks as networks
from ._jax import use_compilation_cache as use_compilation_cache
from .analysis import (
    Distilled as Distilled,
    Estimation as Estimation,
    Formula as Formula,
    Linearization as Linearization,
    Observer as Observer,
    OperatingPoint as OperatingPoint,
    distill as distill,
    estimate as estimate,
    linearize as linearize,
    observer as observer,
    operating_point as operating_point,
)
from .data import (
    Data as Data,
    Signal as Signal,
    load_params as load_params,
    save_params as save_params,
)
from .drawing import Diagram as Diagram
from .errors import (
    AcausalError as AcausalError,
    ConnectionError as ConnectionError,
    DataError as DataError,
    DeclarationError as DeclarationError,
    ExportError as ExportError,
    InitializationError as InitializationError,
    ModelError as ModelError,
    SimulationError as SimulationError,
    StructureError as StructureError,
    TrainingError as TrainingError,
    UnitError as UnitError,
)
from .fmu import FMU as FMU
from .initialization import Initialization as Initialization
from .modelica import ModelicaError as ModelicaError, load as load
from .modeling import (
    Abs as Abs,
    Budget as Budget,
    Component as Component,
    Connector as Connector,
    Discrete as Discrete,
    Eq as Eq,
    Flow as Flow,
    Icon as Icon,
    InitialParameter as InitialParameter,
    Input as Input,
    Module as Module,
    Option as Option,
    Output as Output,
    Parameter as Parameter,
    Potential as Potential,
    Reinit as Reinit,
    Start as Start,
    Variable as Variable,
    When as When,
    acos as acos,
    asin as asin,
    asinh as asinh,
    atan as atan,
    atan2 as atan2,
    change as change,
    cos as cos,
    cosh as cosh,
    der as der,
    edge as edge,
    exp as exp,
    floor as floor,
    initial as initial,
    log as log,
    maximum as maximum,
    minimum as minimum,
    pi as pi,
    pre as pre,
    prescribed as prescribed,
    sample as sample,
    sign as sign,
    sin as sin,
    sinh as sinh,
    sqrt as sqrt,
    tan as tan,
    tanh as tanh,
    time as time,
    where as where,
)
from .netlist import NetlistError as NetlistError, find as find, save as save
from .networks import MLP as MLP, OffsetCorrected as OffsetCorrected, remove_offset as remove_offset
from .pages import page as page
from .reporting import diagram as diagram
from .simulation import (
    Solution as Solution,
    Sweep as Sweep,
    simulate as simulate,
    sliders as sliders,
    sweep as sweep,
)
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
    Prediction as Prediction,
    Predictions as Predictions,
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
