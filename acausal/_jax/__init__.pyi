from .compilation_cache import use_compilation_cache as use_compilation_cache
from .dtypes import cast as cast, floating as floating, precision as precision
from .jacobian import value_and_jacobian as value_and_jacobian
from .scan import stored_scan as stored_scan
from .settings import configure as configure, need_double_precision as need_double_precision
from .tracing import array as array, traced as traced
