"""Noise: numbers by seeds, the same in every run, and their distributions."""

from typing import Any

import jax
import numpy as np
import pytest
from scipy import stats

import acausal as ac
from acausal.components import blocks
from acausal.components.blocks.generator import uniform


class Pair(ac.Component):
    """Two noise blocks of one kind."""

    def __init__(self) -> None:
        super().__init__()
        self.one, self.two = (blocks.UniformNoise(samplePeriod=0.1) for _ in range(2))


class Noises(ac.Component):
    """Noise of all kinds, with a seed of the model."""

    def __init__(self, seed: int = 5) -> None:
        super().__init__()
        fixed: dict[str, Any] = {"useAutomaticLocalSeed": False, "fixedLocalSeed": 10}
        self.globalSeed = blocks.GlobalSeed(fixedSeed=seed)
        self.pair = Pair()
        self.uniform = blocks.UniformNoise(samplePeriod=0.1, y_min=-1, y_max=3, **fixed)
        self.normal = blocks.NormalNoise(
            samplePeriod=0.1, mu=2, sigma=0.5, startTime=0.2, y_off=7, **fixed
        )
        self.cut = blocks.TruncatedNormalNoise(samplePeriod=0.1, y_min=1, y_max=2, sigma=1, **fixed)
        self.white = blocks.BandLimitedWhiteNoise(samplePeriod=0.1, noisePower=4, **fixed)
        self.off = blocks.NormalNoise(enableNoise=False, y_off=1)


TS = np.arange(40) / 10 + 0.05
NUMBERS = uniform(10, 5, 40)


@pytest.mark.slow
def test_numbers_follow_from_the_seeds() -> None:
    system = ac.compile(Noises())
    found = ac.simulate(system, (0, 4), saveat=TS)
    np.testing.assert_array_equal(found["uniform.y"], -1 + 4 * NUMBERS)
    normal = np.append([7, 7], 2 + 0.5 * stats.norm.ppf(NUMBERS[:38]))
    np.testing.assert_allclose(found["normal.y"], normal, rtol=1e-13)
    cut = stats.truncnorm.ppf(NUMBERS, -0.5, 0.5, loc=1.5)
    np.testing.assert_allclose(found["cut.y"], cut, rtol=1e-12)
    white = np.sqrt(4 / 0.1) * stats.norm.ppf(NUMBERS)
    np.testing.assert_allclose(found["white.y"], white, rtol=1e-12)
    np.testing.assert_array_equal(found["off.y"], 1)
    one, two = (np.asarray(found[f"pair.{name}.y"]) for name in ("one", "two"))
    assert abs(np.corrcoef(one, two)[0, 1]) < 0.5
    again = ac.simulate(system, (0, 4), saveat=TS)
    assert all(
        (np.asarray(again[n]) == np.asarray(found[n])).all() for n in ("pair.one.y", "cut.y")
    )
    params = system.parameters()
    none = np.zeros(0)
    several = jax.vmap(
        lambda sigma: system.observe("normal.y", 0.35, none, none, params | {"normal.sigma": sigma})
    )(np.array([0.5, 1.0]))
    exact = 2 + np.array([0.5, 1.0]) * stats.norm.ppf(NUMBERS[1])
    np.testing.assert_allclose(several, exact, rtol=1e-13)


def test_the_generator_is_xorshift128plus() -> None:
    """Against the same with NumPy's words of 64 bits; and its numbers are uniform."""
    numbers = uniform(1, 67867967, 2**15)
    with np.errstate(over="ignore"):
        s = [np.uint64(1) | np.uint64(67867967) << np.uint64(32)]
        for _ in range(11):
            x = s[-1]
            x ^= x >> np.uint64(12)
            x ^= x << np.uint64(25)
            x ^= x >> np.uint64(27)
            s.append(x * np.uint64(2685821657736338717))
        a, b = s[10], s[11]
        for number in numbers[:5]:
            a ^= a << np.uint64(23)
            a, b = b, (a ^ b ^ a >> np.uint64(17) ^ b >> np.uint64(26)) + b
            assert number == np.int64(b) * 2.0**-64 + 0.5
    assert stats.kstest(numbers, "uniform").pvalue > 0.01
    assert abs(np.corrcoef(numbers[1:], numbers[:-1])[0, 1]) < 0.02


def test_another_seed_gives_other_numbers() -> None:
    numbers = [
        ac.compile(Noises(seed)).parameters()["uniform.numbers"].values[:3] for seed in (5, 6)
    ]
    assert not np.isclose(*numbers).any()
    with pytest.raises(ac.DeclarationError, match="useAutomaticSeed=True"):
        blocks.GlobalSeed(useAutomaticSeed=True)  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize("length", [-3, 0, 2**20 + 1])
def test_a_length_that_cannot_be_is_refused(length: int) -> None:
    with pytest.raises(ac.DeclarationError, match=f"NormalNoise: length={length}; give 1 to"):
        ac.compile(blocks.NormalNoise(length=length))
