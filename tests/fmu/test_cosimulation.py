"""FMUs for co-simulation as sampled parts: they step by themselves, each simulation with an instance of its own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from tests.fmu.test_model_exchange import Mass
from tests.support.fmus import Unpacked, need_fmpy
from tests.support.foreign import foreign_fmu

STEP = 0.01


class Looped(ac.Component):
    """A source and a gain around an FMU, which see its output."""

    k = ac.Parameter(-2.0, unit="N/m")

    def __init__(self, path: Path, memory: int = 0) -> None:
        super().__init__()
        self.plant = ac.FMU(path, kind="cs", step=STEP, memory=memory)
        self.push, self.area = ac.Output(unit="N"), ac.Variable(fixed=True)
        self.connect(self.push, self.plant.f)

    def equations(self) -> Iterator[Any]:
        yield ac.Eq(self.push, 3 * ac.sin(20 * ac.time) + self.k * self.plant.s)
        yield ac.Eq(ac.der(self.area), self.plant.s)


@pytest.fixture(scope="module")
def masses(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    need_fmpy()
    folder, system = tmp_path_factory.mktemp("cosimulation"), ac.compile(Mass())

    def of(fmi: str) -> Path:
        path = folder / f"mass{fmi[0]}.fmu"
        return path if path.is_file() else ac.export.fmu(system, path, fmi=fmi, outputs=["s"])

    return of


def by_fmpy(path: Path, fmi: str, k: float) -> np.ndarray:
    """The output at communication points, by a loop of our own."""
    fmu, found = Unpacked(path, fmi), list[float]()
    with fmu.instance("CoSimulation") as mass:
        for i in range(31):
            found.append(float(mass.get(["s"])[0]))
            mass.set(["f"], [3 * np.sin(20 * i * STEP) + k * found[-1]])
            mass.fmu.doStep(i * STEP, STEP)
    fmu.remove()
    return np.array(found)


@pytest.mark.cases(fast=1, slow=1)
@pytest.mark.parametrize("fmi", ["2.0", "3.0"])
def test_it_steps_from_point_to_point(masses: Callable[[str], Path], fmi: str) -> None:
    path = masses(fmi)
    system = ac.compile(Looped(path))
    times = np.arange(31) * STEP
    for k in (-2.0, -1.0, -2.0):  # again with the same values: no instance remembers
        run = ac.simulate(system, 0.3, saveat=times, dt=STEP, params={"k": k})
        np.testing.assert_allclose(run["plant.s"], by_fmpy(path, fmi, k), atol=1e-12)


@pytest.mark.slow
def test_parameters_have_gradients_and_inputs_need_a_memory(masses: Callable[[str], Path]) -> None:
    system = ac.compile(ac.FMU(masses("2.0"), {"f": 1.0}, kind="cs", step=STEP))

    def last(d: Any) -> Any:
        return ac.simulate(system, 0.2, saveat=[0.2], dt=STEP, params={"d": d})["s"][0]

    np.testing.assert_allclose(jax.grad(last)(2.0), (last(2.001) - last(1.999)) / 2e-3, rtol=1e-5)
    looped = ac.compile(Looped(masses("2.0")))
    with pytest.raises(ac.SimulationError, match="whose co-simulation depends on all earlier"):
        jax.grad(lambda k: ac.simulate(looped, 0.02, dt=STEP, params={"k": k})["area"][-1])(-2.0)


@pytest.mark.slow
def test_gradients_go_through_inputs_as_far_as_the_memory(masses: Callable[[str], Path]) -> None:
    system = ac.compile(Looped(masses("2.0"), memory=6))

    def last(k: Any, d: Any, steps: int = 6) -> Any:
        known = {"k": k, "plant.d": d}
        return ac.simulate(system, steps * STEP, dt=STEP, params=known)["area"][-1]

    for i, found in enumerate(jax.grad(last, argnums=(0, 1))(-200.0, 2.0)):
        h = 1e-3 * (1 - i), 1e-3 * i
        expected = (last(-200.0 + h[0], 2.0 + h[1]) - last(-200.0 - h[0], 2.0 - h[1])) / 2e-3
        np.testing.assert_allclose(found, expected, rtol=1e-5)
    with pytest.raises(
        jax.errors.JaxRuntimeError, match=r"over 9 communication steps, and memory= is 6"
    ):
        float(jax.grad(lambda k: last(k, 2.0, 9))(-200.0))


@pytest.mark.slow
def test_a_co_simulation_that_explodes_says_so() -> None:
    model = ac.FMU(foreign_fmu("Mass_Damper"), {"f": 0.0}, kind="cs", step=5e-3)
    run = ac.simulate(ac.compile(model), 5.0, saveat=[5.0], dt=5e-2)
    with pytest.warns(UserWarning, match=r"explodes: 'y' is .* smaller step= .* or kind='me'"):
        _ = run["y"]


@pytest.mark.slow
def test_the_kind_and_the_step_are_checked() -> None:
    only = foreign_fmu("FMU3Model")
    assert "in steps of 0.002 s" in repr(ac.FMU(only))
    with pytest.raises(ac.DeclarationError, match="has 'cs', not kind='me'"):
        ac.FMU(only, kind="me")
    with pytest.raises(ac.DeclarationError, match="above zero"):
        ac.FMU(only, step=-1.0)
    system = ac.compile(ac.FMU(only))
    run = ac.simulate(system, 0.004, dt=2e-3, inputs=dict.fromkeys(system.inputs, 1.0))
    assert np.isfinite(run["vector[2]"]).all()
