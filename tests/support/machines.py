"""A plugin of pytest that stands for other machines: ``pytest -p tests.support.machines --last-bits 1``.

With a seed, all values of records change in their last bits where a model takes them. The summary lists how far what
tests have measured is from their bars: of compared floating-point numbers where ``enable_assertion_pass_hook`` is set
(`.ci/machines.py` does that), of `numpy.testing.assert_allclose`, and of the numbers that pages show.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

CHANGE = 1e-15
"""The largest relative change of a value: a few units in the last place."""

FAR = 1e6
"""No margin that is larger is noted: nothing but roundoff was found."""

FIFTH = 0.2
"""The least distance of a bar, relative to what is measured."""

ORDERS = ("<", "<=", ">", ">=")


def changed(values: np.ndarray, seed: int) -> np.ndarray:
    """Values with other last bits; the same for the same values."""
    generator = np.random.default_rng([seed, zlib.crc32(np.ascontiguousarray(values).tobytes())])
    return values * (1 + CHANGE * generator.uniform(-1, 1, values.shape))


def distances(op: str, left: Any, right: Any) -> Iterator[tuple[float, float, float]]:
    """What is measured, its bar, and their distance relative to what is measured; the nearest of an array.

    Of ``approx`` they are the error, the tolerance, and the distance relative to the error.
    """
    if op == "==" and type(right).__name__.startswith("Approx"):
        yield from _of_approx(left, right)
    elif op in ORDERS:
        try:
            kinds = {np.asarray(side).dtype.kind for side in (left, right)}
            measured, bar = np.broadcast_arrays(*(np.asarray(s, float) for s in (left, right)))
        except (TypeError, ValueError):
            return
        if "f" in kinds and measured.size:
            apart = np.abs(measured - bar) / np.maximum(np.abs(measured), 1e-300)
            apart = np.where(np.isfinite(measured) & np.isfinite(bar), apart, np.inf)
            i = np.unravel_index(np.argmin(apart), apart.shape)
            yield float(measured[i]), float(bar[i]), float(apart[i])


def _of_approx(left: Any, right: Any) -> Iterator[tuple[float, float, float]]:
    expected = right.expected
    if isinstance(expected, Mapping):
        pairs = [(left[key], value) for key, value in expected.items()]
    else:
        try:
            pairs = list(zip(np.ravel(left), np.ravel(expected), strict=True))
        except (TypeError, ValueError):
            return
    for found, wanted in pairs:
        if isinstance(found, str) or isinstance(wanted, str | None):
            continue
        relative = 1e-6 if right.rel is None and right.abs is None else (right.rel or 0.0)
        absolute = 1e-12 if right.abs is None else right.abs
        tolerance = float(max(relative * abs(wanted), absolute))
        error = float(abs(found - wanted))
        yield error, tolerance, (tolerance - error) / max(error, 1e-300)


class Machines:
    """The plugin, registered where its options are read."""

    def __init__(self, config: pytest.Config) -> None:
        self.config = config
        self.item: pytest.Item | None = None
        self.seen: list[tuple[float, float, float]] = []
        self.patch = pytest.MonkeyPatch()

    def note(self, place: str, text: str, found: list[tuple[float, float, float]]) -> None:
        """Keep the nearest bar of an assertion."""
        near = min(found, key=lambda f: f[2], default=None)
        if near is not None and self.item is not None and near[2] < FAR:
            told = (place, " ".join(text.split())[:100], *near)
            self.item.user_properties.append(("margin", told))

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        self.item, self.seen = item, []
        return (yield)

    def pytest_assertrepr_compare(self, op: str, left: object, right: object) -> None:
        self.seen += distances(op, left, right)

    def pytest_assertion_pass(self, item: pytest.Item, lineno: int, orig: str) -> None:
        seen, self.seen = self.seen, []
        self.note(f"{item.nodeid.partition('::')[0]}:{lineno}", orig, seen)

    def pytest_collection_finish(self) -> None:
        """Change the last bits of records, and note how near arrays are to what is expected."""
        from acausal.data import Data

        seed, close = self.config.getoption("last_bits"), np.testing.assert_allclose
        for_system = Data.for_system

        def other_bits(record: Data, system: Any) -> Data:
            found = for_system(record, system)
            return found._with(found.time, {n: changed(v, seed) for n, v in found.signals.items()})

        def noted(
            actual: Any, desired: Any, rtol: float = 1e-7, atol: float = 0.0, **k: Any
        ) -> None:
            __tracebackhide__ = True
            close(actual, desired, rtol, atol, **k)
            wanted = np.asarray(desired)
            errors = np.atleast_1d(np.abs(np.asarray(actual) - wanted)).astype(float)
            bars = np.broadcast_to(atol + rtol * np.abs(wanted), errors.shape).astype(float)
            apart = np.where(errors > 0, (bars - errors) / np.maximum(errors, 1e-300), np.inf)
            if apart.size and self.item is not None:
                i = np.unravel_index(np.argmin(apart), apart.shape)
                nearest = (float(errors[i]), float(bars[i]), float(apart[i]))
                self.note(self.item.nodeid.partition("::")[0], "assert_allclose", [nearest])

        self.patch.setattr(np.testing, "assert_allclose", noted)
        if seed is not None:
            self.patch.setattr(Data, "for_system", other_bits)

    def pytest_unconfigure(self) -> None:
        self.patch.undo()

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        reports = [r for kind in ("passed", "failed") for r in terminalreporter.getreports(kind)]
        margins = [
            (r.nodeid, *value)
            for r in reports
            for key, value in r.user_properties
            if key == "margin"
        ]
        digits = sorted(
            {tuple(v) for r in reports for key, v in r.user_properties if key == "digit"}
        )
        near = sorted((m for m in margins if m[-1] < FIFTH), key=lambda m: m[-1])
        if near:
            terminalreporter.section("bars that are closer than a fifth to what is measured")
        for _, place, text, measured, bar, apart in near:
            terminalreporter.write_line(f"{apart:7.1%} {measured:.6g} {bar:.6g} {place}  {text}")
        if digits:
            terminalreporter.section("numbers of pages that are not printed as they are shown")
        for page, shown, printed in digits:
            terminalreporter.write_line(f"{page}: {shown} is {printed}")
        if target := self.config.getoption("margins"):
            failed = [r.nodeid for r in terminalreporter.getreports("failed")]
            found = {"margins": margins, "digits": digits, "failed": failed}
            Path(target).write_text(json.dumps(found), encoding="utf-8")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--last-bits", type=int, metavar="SEED", help="change the last bits of records"
    )
    parser.addoption("--margins", metavar="FILE", help="write all margins as JSON")


def pytest_configure(config: pytest.Config) -> None:
    config.pluginmanager.register(Machines(config), "machines")
