"""``modelDescription.xml`` of an FMU."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from acausal.export.fmu_text.variables import DERIVATIVE, INDICATOR, OUTSIDE, STATE, WrittenVariable
from acausal.units import in_si

KINDS = {"model_exchange": "ModelExchange", "co_simulation": "CoSimulation"}
"""FMI's words by ours."""


@dataclass(frozen=True)
class ModelDescription:
    """What the model description says.

    Attributes:
        fmi: "2.0" or "3.0". name: of files and functions. title: of the model. token: of this content.
        kinds: keys of `KINDS`. step: of co-simulation [s].
        variables: all but time. dependencies: references by reference, or None if each depends on all.
        sources: names of the C files to compile. indicators: the number of event indicators.
        experiment: where a simulation starts, and where it stops, if that is known [s].
    """

    fmi: str
    name: str
    title: str
    token: str
    kinds: Sequence[str]
    step: float
    variables: Sequence[WrittenVariable]
    dependencies: Mapping[int, Sequence[int]] | None
    sources: Sequence[str]
    indicators: int = 0
    experiment: Sequence[float] = (0.0,)

    def xml(self) -> bytes:
        """The text of the file."""
        old = self.fmi == "2.0"
        root = Element(
            "fmiModelDescription",
            {
                "fmiVersion": self.fmi,
                "modelName": self.title,
                "guid" if old else "instantiationToken": self.token,
                "generationTool": "acausal",
                "variableNamingConvention": "structured",
            },
        )
        if old and self.indicators:
            root.set("numberOfEventIndicators", str(self.indicators))
        for kind in KINDS:
            if kind in self.kinds:
                self._add_kind(root, kind)
        _add_units(root, ["s", *(v.unit for v in self.variables)])
        listed = SubElement(root, "LogCategories")
        for name, what in (
            ("logStatusDiscard", "a step or a value that could not be computed"),
            ("logStatusError", "wrong calls"),
        ):
            SubElement(listed, "Category", name=name, description=what)
        times = zip(("startTime", "stopTime"), self.experiment, strict=False)
        experiment = {name: number(t) for name, t in times}
        SubElement(root, "DefaultExperiment", {**experiment, "stepSize": number(self.step)})
        listed = SubElement(root, "ModelVariables")
        self._add_variables(listed)
        self._add_structure(root)
        indent(root, " ")
        return b'<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, "utf-8") + b"\n"

    def _add_kind(self, root: Element, kind: str) -> None:
        old = self.fmi == "2.0"
        found = {"modelIdentifier": self.name}
        if old:
            found |= dict.fromkeys(
                ("canNotUseMemoryManagementFunctions", "canGetAndSetFMUstate", "canSerializeFMUstate",
                 "providesDirectionalDerivative"), "true",
            )  # fmt: skip
        else:
            found |= dict.fromkeys(
                ("canGetAndSetFMUState", "canSerializeFMUState", "providesDirectionalDerivatives",
                 "providesAdjointDerivatives"), "true",
            )  # fmt: skip
        watches = any(v.kind == OUTSIDE for v in self.variables)
        if kind == "model_exchange" and watches and not old:
            found["needsCompletedIntegratorStep"] = "true"
        if kind == "co_simulation":
            found["canHandleVariableCommunicationStepSize"] = "true"
            if not old:
                found["fixedInternalStepSize"] = number(self.step)
                found |= dict.fromkeys(
                    ("providesIntermediateUpdate", "mightReturnEarlyFromDoStep",
                     "canReturnEarlyAfterIntermediateUpdate", "hasEventMode"), "true",
                )  # fmt: skip
        element = SubElement(root, KINDS[kind], found)
        if old:
            listed = SubElement(element, "SourceFiles")
            for name in self.sources:
                SubElement(listed, "File", name=name)

    def _place(self, reference: int) -> str:
        """How a variable is named in other places: in FMI 2 by its index in the file, in FMI 3 by its reference."""
        return str(self._index[reference] if self.fmi == "2.0" else reference)

    @cached_property
    def _index(self) -> dict[int, int]:
        return {0: 1, **{v.reference: i + 2 for i, v in enumerate(self.variables)}}

    def _add_variables(self, listed: Element) -> None:
        def add(words: dict[str, str], kind: str, values: dict[str, str]) -> Element:
            if self.fmi == "2.0":
                return SubElement(SubElement(listed, "ScalarVariable", words), kind, values)
            return SubElement(listed, kind, {**words, **values})

        real = "Real" if self.fmi == "2.0" else "Float64"
        time = {"causality": "independent", "variability": "continuous"}
        add({"name": "time", "valueReference": "0", **time}, real, {"unit": "s"})
        for v in self.variables:
            element = add(_words(v), "Boolean" if v.kind == OUTSIDE else real, _values(v))
            if v.kind == DERIVATIVE:
                element.set("derivative", self._place((STATE << 24) + v.number))
            for length in v.shape:
                SubElement(element, "Dimension", start=str(length))

    def _unknowns(
        self,
    ) -> tuple[list[WrittenVariable], list[WrittenVariable], list[WrittenVariable]]:
        """Outputs, derivatives, and what is to be computed at the start."""
        outputs = [v for v in self.variables if v.causality == "output"]
        rates = [v for v in self.variables if v.kind == DERIVATIVE]
        computed = ("calculated", "approx")
        first = [v for v in self.variables if v.initial in computed and v.kind != INDICATOR]
        return outputs, rates, first

    @property
    def _computes_starts(self) -> bool:
        """Whether states are computed at the start, so that what is unknown there depends on all parameters."""
        return any(v.initial == "approx" for v in self.variables)

    def _add_structure(self, root: Element) -> None:
        old, structure = self.fmi == "2.0", SubElement(root, "ModelStructure")
        parameters = [v.reference for v in self.variables if v.causality == "parameter"]
        rate = "Derivative" if old else "ContinuousStateDerivative"
        for name, unknowns in zip(
            ("Output", rate, "InitialUnknown"), self._unknowns(), strict=True
        ):
            at_start = name == "InitialUnknown"
            depends_on_all = at_start and (old or self.indicators or self._computes_starts)
            listed = SubElement(structure, f"{name}s") if old and unknowns else structure
            for v in unknowns:
                place = {"index" if old else "valueReference": self._place(v.reference)}
                unknown = SubElement(listed, "Unknown" if old else name, place)
                if self.dependencies is not None and not depends_on_all:
                    read = [*self.dependencies[v.reference], *(parameters if at_start else ())]
                    unknown.set("dependencies", " ".join(map(self._place, sorted(read))))
        for v in self.variables:
            if v.kind == INDICATOR and not old:
                SubElement(structure, "EventIndicator", valueReference=str(v.reference))


def _add_units(root: Element, units: Iterable[str]) -> None:
    """Append the definitions of units, in base units where these are known; empty texts have no definition."""
    named = sorted({u for u in units if u})
    if not named:
        return
    listed = SubElement(root, "UnitDefinitions")
    for name in named:
        unit, found = SubElement(listed, "Unit", name=name), in_si(name)
        if found is None:
            continue
        base = SubElement(unit, "BaseUnit", {s: str(e) for s, e in found.exponents.items()})
        if found.factor != 1:
            base.set("factor", repr(found.factor))
        if found.offset != 0:
            base.set("offset", repr(found.offset))


def documentation(description: ModelDescription, about: str) -> bytes:
    """``documentation/index.html``: what the model is about, and a table of its variables."""
    rows = "".join(
        f"<tr><td>{escape(v.name)}</td><td>{v.causality}</td><td>{escape(v.unit)}</td><td>{escape(v.doc)}</td></tr>\n"
        for v in description.variables
    )
    title = escape(description.title)
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title></head>\n<body>\n'
        f"<h1>{title}</h1>\n<p>{escape(about)}</p>\n<table>\n"
        f"<tr><th>variable</th><th>causality</th><th>unit</th><th>description</th></tr>\n{rows}</table>\n</body></html>\n"
    ).encode()


def build_description(name: str, sources: Sequence[str]) -> bytes:
    """``sources/buildDescription.xml`` of FMI 3: how the C is compiled."""
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    build = SubElement(root, "BuildConfiguration", modelIdentifier=name)
    files = SubElement(build, "SourceFileSet", language="C99")
    for source in sources:
        SubElement(files, "SourceFile", name=source)
    indent(root, " ")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, "utf-8") + b"\n"


def number(value: float) -> str:
    """A number with all its digits and no more."""
    return repr(float(value)).removesuffix(".0")


def _words(v: WrittenVariable) -> dict[str, str]:
    found = {
        "name": v.name,
        "valueReference": str(v.reference),
        "causality": v.causality,
        "variability": v.variability,
    }
    if v.initial:
        found["initial"] = v.initial
    if v.doc:
        found["description"] = v.doc
    return found


def _values(v: WrittenVariable) -> dict[str, str]:
    found = {"unit": v.unit} if v.unit else {}
    if len(set(v.nominal)) == 1 and v.nominal[0] != 1:
        found["nominal"] = number(v.nominal[0])
    if v.start is not None:
        found["start"] = " ".join(map(number, v.start))
    return found
