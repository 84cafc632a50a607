"""The example on a plant that is an FMU: without it a sentence, with it its spring and a friction are found."""

from __future__ import annotations

import sys

import pytest

from examples.fmu_plant import __main__ as command, study
from tests.support.foreign import foreign_fmu


def test_without_the_package_it_is_skipped_in_a_sentence(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(study, "PACKAGE", "no_such_package")
    monkeypatch.setattr(sys, "argv", ["fmu_plant"])
    command.main()
    assert capsys.readouterr().out.startswith("skipped: there is no package 'no_such_package'")


@pytest.mark.slow
def test_a_record_determines_the_spring_and_the_friction() -> None:
    outcome = study.run(foreign_fmu("Mass_Damper"))
    assert outcome.spring == pytest.approx(study.SPRING, rel=1e-3)
    assert outcome.rms < study.NOISE < outcome.rms_before / 50
    for v, learned in zip(study.SPEEDS, outcome.friction, strict=True):
        assert learned == pytest.approx(study.friction(v), rel=0.05)
