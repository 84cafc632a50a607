from .compilation_cache import use_compilation_cache as use_compilation_cache
from .damped_steps import (
    Damped as Damped,
    Descent as Descent,
    DescentMethod as DescentMethod,
    after_trial as after_trial,
    before_trials as before_trials,
    levenberg_marquardt as levenberg_marquardt,
)
from .differentiation import two_modes as two_modes, value_and_jacobian as value_and_jacobian
from .dtypes import (
    above_rounding as above_rounding,
    cast as cast,
    check_time as check_time,
    floating as floating,
    is_number as is_number,
    is_real as is_real,
    precision as precision,
)
from .host_calls import (
    HOST_FAILURES as HOST_FAILURES,
    HostError as HostError,
    call_host as call_host,
    register_host as register_host,
)
from .keys import as_key as as_key
from .primitives import (
    BARRIER as BARRIER,
    CALLS as CALLS,
    WRITTEN_OUT as WRITTEN_OUT,
    Equation as Equation,
    bind as bind,
    called as called,
    name_of as name_of,
    scan_of as scan_of,
    shapes as shapes,
)
from .programs import (
    compile_ahead as compile_ahead,
    compiled as compiled,
)
from .reverse import room as room, with_steps as with_steps
from .scan import Restarts as Restarts, stored_scan as stored_scan
from .settings import (
    configure_with_jax as configure_with_jax,
    need_double_precision as need_double_precision,
)
from .side_by_side import (
    cond_any as cond_any,
    either as either,
    one_by_one as one_by_one,
    while_any as while_any,
)
from .small_factors import (
    cholesky as cholesky,
    solve_lower as solve_lower,
    solve_upper as solve_upper,
)
from .tracing import (
    INLINED as INLINED,
    array as array,
    differentiated as differentiated,
    known as known,
    need_known as need_known,
    numpy_or_jax as numpy_or_jax,
    select as select,
    traced as traced,
    without_derivatives as without_derivatives,
)
