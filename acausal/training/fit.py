"""`fit`: train the networks and parameters of a model on measured data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Unpack

from acausal.data import RecordsLike, Stream
from acausal.errors import need_compiled
from acausal.training.options import FitKeywords, FitOptions, documented
from acausal.training.preparation import prepare
from acausal.training.result import Fit
from acausal.training.streaming import need_one_training
from acausal.training.train_from_starts import run

if TYPE_CHECKING:
    from acausal.system import System


@documented
def fit(
    system: System,
    data: RecordsLike | Stream,
    targets: str | Sequence[str],
    *,
    params: Mapping[str, Any] | None = None,
    seed: int = 0,
    **options: Unpack[FitKeywords],
) -> Fit:
    """Train networks and parameters of a model so that its outputs follow measured records.

    Every update takes a batch of random sequences that start from measured states (or whole records),
    integrates the model over them in fixed or adaptive steps, and moves along the gradient of the loss. All updates
    run in one compiled program. A sequence that diverges is left out, noted in the history, and harms nothing.

    Arguments:
        system: a compiled model.
        data: a record with all inputs and targets of the model, and its states where sequences start from them; or
            several records, as a list or by name. They may differ in length and sample times, and miss samples, or
            a target that others have. A stream (`acausal.Data.stream`) is trained by sequences.
        targets: the variables to fit, measured in the data.
        params: where to start: those of the model's parameters that differ from what `system.parameters` gives for
            ``seed``, from which networks are made, or what a ``prior`` ends with.
        seed: of the networks, the sequences and the points. The same seed gives the same result.
        options: see `acausal.training.FitOptions`, each by its name.

    Returns:
        The best of the training, also after Ctrl-C.

    Raises:
        DataError: if the data do not fit the model, or the checkpoint is damaged or of another training.
        TrainingError: if there is nothing to train, the training cannot go on, or no checkpoint can be written.
        TypeError: for a keyword that is not an option.
    """
    need_compiled(system, "fit")
    fit_options = FitOptions.of("fit", options)
    need_one_training(data, fit_options, fit_options.starts)
    (trained,) = run(prepare(system, data, targets, fit_options, seeds=(seed,), params=(params,)))
    return trained
