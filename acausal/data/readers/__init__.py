"""Files and tables of other libraries, as tables of measured samples and back.

In: paths, pandas and xarray objects. Out: `Table`. What makes a record of one is `acausal.Data`.
"""

from acausal.data.readers.csv_file import read_csv as read_csv
from acausal.data.readers.data_frame import (
    is_data_frame as is_data_frame,
    time_and_signals as time_and_signals,
)
