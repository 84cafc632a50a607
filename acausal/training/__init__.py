"""Train: the networks and parameters of a model learn from records.

In: a `System`, `Data`, `FitOptions` as keywords. Out: a `Fit`, an `Ensemble` or a `CrossValidation`, which answer
further questions. It may import every room below; none of them imports it. Inside, `objective` defines what to
minimise, `optimizers` how, `uncertainty` computes how certain the result is, and `presentation` shows it; only
`objective` lays records out.
"""

from acausal.reporting import Band as Band
from acausal.training.cross_validation import (
    CrossValidation as CrossValidation,
    Fold as Fold,
    cross_validate as cross_validate,
)
from acausal.training.ensemble import Ensemble as Ensemble, ensemble as ensemble
from acausal.training.fit import fit as fit
from acausal.training.history import Divergence as Divergence, History as History
from acausal.training.logs import CsvLog as CsvLog, TensorBoardLog as TensorBoardLog
from acausal.training.objective.error_laws import (
    Huber as Huber,
    Likelihood as Likelihood,
    Student as Student,
)
from acausal.training.objective.modal import (
    DampingRatio as DampingRatio,
    FrequencyRange as FrequencyRange,
    Stability as Stability,
)
from acausal.training.objective.modifiers import Bounded as Bounded, Shift as Shift
from acausal.training.objective.regularizers import (
    SmallCorrection as SmallCorrection,
    ZeroCrossing as ZeroCrossing,
)
from acausal.training.objective.timing import Delay as Delay, Lag as Lag
from acausal.training.optimizers.lbfgs import lbfgs as lbfgs
from acausal.training.options import FitOptions as FitOptions
from acausal.training.prediction import Prediction as Prediction, Predictions as Predictions
from acausal.training.profile import Profile as Profile
from acausal.training.record_fit import RecordFit as RecordFit
from acausal.training.result import Fit as Fit
from acausal.training.starts import Minimum as Minimum, Starts as Starts
from acausal.training.trained_model import Seen as Seen
from acausal.training.uncertainty.confidence import Confidence as Confidence
