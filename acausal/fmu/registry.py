"""What computes each FMU of a model in this process: made once, when it is first needed."""

from __future__ import annotations

from acausal.errors import AcausalError
from acausal.fmu.cosimulation import Stepped
from acausal.fmu.model_exchange import NEVER, Evaluated
from acausal.fmu.part import Part

_COMPUTED: dict[str, Evaluated | Stepped] = {}


def computed(part: Part) -> Evaluated | Stepped:
    """What computes a part."""
    found = _COMPUTED.get(part.key)
    if found is None:
        found = _COMPUTED[part.key] = (Evaluated if part.kind == "me" else Stepped)(part)
    return found


def evaluated(part: Part) -> Evaluated | None:
    """What computes a part by model exchange; None where it cannot be used here, but can be looked at."""
    try:
        found = computed(part)
    except AcausalError:
        return None
    assert isinstance(found, Evaluated)
    return found


def has_events(part: Part) -> bool:
    """Whether there are events: nobody but the FMU itself knows of its time events."""
    known = part.description.variables.values()
    changes = any(v.variability == "discrete" and v.causality in ("local", "output") for v in known)
    found = evaluated(part)
    return found is not None and (
        changes or part.description.indicators > 0 or found.first_event < NEVER
    )
