from .compilation_cache import use_compilation_cache as use_compilation_cache
from .differentiation import two_modes as two_modes
from .dtypes import (
    cast as cast,
    check_time as check_time,
    floating as floating,
    is_number as is_number,
    is_real as is_real,
    precision as precision,
)
from .jacobian import value_and_jacobian as value_and_jacobian
from .scan import Restarts as Restarts, stored_scan as stored_scan
from .settings import configure as configure, need_double_precision as need_double_precision
from .tracing import array as array, known as known, traced as traced
