"""One meaning a word: no two rooms of the kernel have public classes of one name."""

import ast
from collections import defaultdict

from tests.support.paths import ROOT


def test_no_class_name_has_two_meanings() -> None:
    places = defaultdict[str, list[str]](list)
    kernel = ROOT / "acausal"
    for path in sorted(kernel.rglob("*.py")):
        if (kernel / "components") in path.parents:
            continue
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places[node.name].append(str(path.relative_to(kernel)))
    assert len(places) > 500
    assert {name: found for name, found in places.items() if len(found) > 1} == {}
