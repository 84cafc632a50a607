"""docs/quarter-vehicle.md shows the code of examples/qvm as it is."""

import ast
import inspect
import re

import acausal as ac
from tests.support.paths import ROOT

PAGE = (ROOT / "docs" / "quarter-vehicle.md").read_text(encoding="utf-8")
SHOWN = re.findall(r"^```py\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


def test_the_model_is_that_of_the_example() -> None:
    source = (ROOT / "examples" / "qvm" / "model.py").read_text(encoding="utf-8")
    model = [block for block in SHOWN if "ac.fit(" not in block]
    assert len(model) == 2
    for block in model:
        assert block in source, f"examples/qvm/model.py says it differently:\n{block}"


def test_the_training_names_arguments_that_fit_has() -> None:
    (block,) = [block for block in SHOWN if "ac.fit(" in block]
    assignment = ast.parse(block).body[0]
    assert isinstance(assignment, ast.Assign)
    assert isinstance(assignment.value, ast.Call)
    named = {keyword.arg for keyword in assignment.value.keywords}
    assert named <= set(inspect.signature(ac.fit).parameters)
