"""``fmu_model.h``: fits the C files of an FMU to one model."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np

from acausal.export.c_text.text import ModelText
from acausal.export.fmu_text.variables import OUTSIDE, event_indicators

FUNCTIONS = ("init", "recalibrate", "start", "derivatives", "outputs", "step", "directional")
OF_EVENTS = ("begin", "conditions", "completed", "next_event", "event")
TABLES = ("parameters", "inputs", "states", "outputs")


def model_header(
    text: ModelText,
    token: str,
    step: float,
    kinds: Sequence[str],
    scalars: bool,
    nominal: np.ndarray,
) -> str:
    """The text of the file.

    Arguments:
        token: of the FMU's content. step: of co-simulation [s]. kinds: of use.
        scalars: whether every number is a variable of its own.
        nominal: typical magnitudes of the states.
    """
    name, upper = text.name, text.name.upper()
    groups = {
        "PARAMETER": text.parameters,
        "INPUT": text.inputs,
        "STATE": text.states,
        "OUTPUT": text.outputs,
    }
    lines = [
        f"/* {text.title}: what the functions of FMI need to know of it. */",
        "#ifndef FMU_MODEL_H",
        "#define FMU_MODEL_H",
        "",
        f'#include "{name}.h"',
        "",
        f"#define TITLE {json.dumps(text.title)}",
        f'#define TOKEN "{token}"',
        f"#define STEP {float(step)!r} /* of co-simulation, in s */",
        f"#define SCALARS {int(scalars)} /* whether every number has a value reference of its own */",
        f"#define MODEL_EXCHANGE {int('model_exchange' in kinds)}",
        f"#define CO_SIMULATION {int('co_simulation' in kinds)}",
        "",
        f"typedef {name} Model;",
        f"typedef {name}_variable Variable;",
        "enum {",
        *(f"    N_{kind}S = {upper}_{kind}S," for kind in groups),
        *(f"    {kind}_GROUPS = {len(listed)}," for kind, listed in groups.items()),
        "};",
        "",
        *(f"#define model_{f} {name}_{f}" for f in FUNCTIONS),
        *(f"#define model_{f} {name}_{f}" for f in OF_EVENTS if text.has_events),
        *(
            [f"#define model_next_event {name}_next_event"]
            if text.has_edges and not text.has_events
            else []
        ),
        f"#define EDGES {int(text.has_edges)} /* whether rates jump or bend at known times */",
        *(f"#define {t}_table {name}_{t}_table" for t in TABLES),
        f"#define WATCHES {int(text.watches)} /* whether it tells that a network leaves its range in training */",
        *(
            [
                f"#define OUTSIDE_REFERENCE {OUTSIDE << 24}u",
                f"#define model_outside {name}_outside",
            ]
            if text.watches
            else ["#define OUTSIDE_REFERENCE 0u"]
        ),
        "",
        *_nominal(nominal),
        "",
        *_indicators(text),
        "",
        "#endif",
    ]
    return "\n".join(lines) + "\n"


def _indicators(text: ModelText) -> list[str]:
    """Which conditions are event indicators."""
    found = event_indicators(text)
    numbers = ", ".join(map(str, found)) or "0"
    return [
        f"#define EVENTS {int(text.code.events is not None)}",
        f"enum {{ N_INDICATORS = {len(found)} }};",
        "#if EVENTS",
        "/* Conditions, from 1 on, whose numbers are event indicators; negative: its number's opposite. */",
        f"static const int indicators[] = {{{numbers}}};",
        "#endif",
    ]


def _nominal(values: np.ndarray) -> list[str]:
    """A function of a state's place."""
    head = "static double nominal_of(long place) {"
    if (values == 1).all():
        return [head, "    (void)place;", "    return 1;", "}"]
    numbers = [repr(v) for v in values.tolist()]
    rows = [", ".join(numbers[i : i + 8]) for i in range(0, len(numbers), 8)]
    table = ["    static const double values[] = {", *(f"        {row}," for row in rows), "    };"]
    return [head, *table, "    return values[place];", "}"]
