"""Measured data: records, signals over time, files of parameters.

In: arrays, CSV files, parameters. Out: `Data`, `Signal`, arrays in a model's units.
It knows the names and units of a compiled model; it knows nothing of simulation or training.
"""

from acausal.data.band_limited import (
    FRACTIONS as FRACTIONS,
    deviation_from_line as deviation_from_line,
    polynomial_coefficients as polynomial_coefficients,
)
from acausal.data.formats import (
    CsvOptions as CsvOptions,
    Formats as Formats,
    ReadOptions as ReadOptions,
    Stream as Stream,
)
from acausal.data.noise import noise_level as noise_level
from acausal.data.params_file import (
    like_saved as like_saved,
    load_params as load_params,
    save_params as save_params,
)
from acausal.data.readers import (
    counts_rows as counts_rows,
    is_data_frame as is_data_frame,
    is_series as is_series,
    read_series as read_series,
)
from acausal.data.record import Data as Data
from acausal.data.samples import check_resolution as check_resolution
from acausal.data.several import (
    Record as Record,
    RecordsLike as RecordsLike,
    records_of as records_of,
)
from acausal.data.signal import (
    Interpolation as Interpolation,
    Signal as Signal,
    differentiate as differentiate,
)
from acausal.data.tensors import (
    filled_like as filled_like,
    named_arrays as named_arrays,
    read_arrays as read_arrays,
    write_arrays as write_arrays,
)
