"""Files and tables of other libraries, as tables of measured samples and back.

In: paths, pandas and xarray objects. Out: `SignalTable`. What makes a record of one is `acausal.Data`.
"""

from acausal.data.readers.csv_file import read_csv as read_csv
from acausal.data.readers.data_frame import (
    counts_rows as counts_rows,
    data_frame as data_frame,
    is_data_frame as is_data_frame,
    is_series as is_series,
    need_unique as need_unique,
    read_parquet as read_parquet,
    read_runs as read_runs,
    read_series as read_series,
    units_said as units_said,
)
from acausal.data.readers.many_files import files as files
from acausal.data.readers.mat_file import read_mat as read_mat
from acausal.data.readers.mdf_file import read_mdf as read_mdf
from acausal.data.readers.table import (
    Selection as Selection,
    SignalTable as SignalTable,
    seconds as seconds,
)
from acausal.data.readers.xarray_dataset import dataset as dataset, read_xarray as read_xarray
