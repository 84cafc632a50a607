"""Random signals that are the same in every run: numbers by seeds, held between the samples."""

import zlib
from collections.abc import Iterator
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax.scipy.special import ndtr, ndtri
from scipy.special import ndtri as exact_ndtri

import acausal as ac
from acausal.components import icons

from .conventions import SMALL
from .generator import uniform
from .interfaces import SO

__modelica__ = "Modelica.Blocks.Noise"

_LONGEST = 2**20
"""Numbers until noise repeats, at most: they are drawn when parameters are made, a million in half a second."""


class GlobalSeed(ac.Component):
    """The seed of all noise in the component that it is a part of, and below.

    Without one the seed is ``fixedSeed`` as here. ``enableNoise=False`` makes all noise constant.
    """

    ICON = icons.block("seed")

    enableNoise = ac.Option(True, doc="whether noise blocks give noise")
    useAutomaticSeed = ac.Option(
        False, choices=(False,), doc="runs are reproducible: change fixedSeed instead"
    )
    fixedSeed = ac.Option(67867967, doc="seed, any whole number")


class PartialNoise(SO):
    """What noise shares: a new number at ``startTime`` and every ``samplePeriod`` [s] after it, ``y_off`` before.

    The numbers follow from the global seed (`GlobalSeed`; 0 unless ``useGlobalSeed``) and a local one:
    ``fixedLocalSeed``, or by ``useAutomaticLocalSeed`` one that follows from the block's name in the model. They are a
    module, ``numbers``, among the model's parameters, and repeat after ``length`` samples.
    """

    __modelica__ = "Modelica.Blocks.Interfaces"

    samplePeriod = ac.Parameter(0.01, unit="s", min=SMALL, doc="time between two numbers")
    enableNoise = ac.Option(True, doc="whether there is noise; else y = y_off")
    y_off = ac.Parameter(0.0, doc="output without noise")
    useGlobalSeed = ac.Option(True, doc="whether the global seed counts")
    useAutomaticLocalSeed = ac.Option(True, doc="whether the local seed follows from the name")
    fixedLocalSeed = ac.Option(1, doc="local seed otherwise, any whole number")
    startTime = ac.Parameter(0.0, unit="s", doc="time of the first number")
    length = ac.Option(2**15, doc="numbers until they repeat")
    numbers = ac.Module("_numbers", data=True, doc="numbers over the count of samples")

    @property
    def _global(self) -> GlobalSeed:
        for node in self._node.ancestors():
            for part in node.children.values():
                if isinstance(part, GlobalSeed):
                    return part
        return GlobalSeed()

    def _numbers(self, _key: Any) -> ac.Signal:
        """The numbers between 0 and 1, or what a subclass makes of them."""
        path = ".".join(node.name for node in (self._node, *self._node.ancestors()))
        local = zlib.crc32(path.encode()) if self.useAutomaticLocalSeed else self.fixedLocalSeed
        seed = self._global.fixedSeed if self.useGlobalSeed else 0
        values = self._made(uniform(int(local), int(seed), int(self.length)))
        values = np.append(values, values[0])
        return ac.Signal(np.arange(len(values)), values, "previous", "periodic", name="numbers")

    def _made(self, numbers: np.ndarray) -> np.ndarray:
        return numbers

    def _noise(self, number: Any) -> Any:
        """The output for a number of `_made`."""
        raise NotImplementedError

    def equations(self) -> Iterator[ac.Eq]:
        if not 1 <= self.length <= _LONGEST:
            raise ac.DeclarationError(
                f"{type(self).__name__}: length={self.length}; give 1 to {_LONGEST} numbers"
            )
        if not (self.enableNoise and self._global.enableNoise):
            yield ac.Eq(self.y, self.y_off)
            return
        since = ac.time - self.startTime
        noise = self._noise(self.numbers(since / self.samplePeriod))
        yield ac.Eq(self.y, ac.where(since < 0, self.y_off, noise, events=None))


class UniformNoise(PartialNoise):
    """Numbers that are equally likely between ``y_min`` and ``y_max``."""

    ICON = icons.marked(icons.NOISE, "U")

    y_min = ac.Parameter(0.0, doc="least value")
    y_max = ac.Parameter(1.0, doc="greatest value")

    def _noise(self, number: Any) -> Any:
        return self.y_min + number * (self.y_max - self.y_min)


class _Normal(PartialNoise):
    """Noise from numbers of mean 0 and standard deviation 1."""

    def _made(self, numbers: np.ndarray) -> np.ndarray:
        return exact_ndtri(np.clip(numbers, 2.0**-60, 1 - 2.0**-53))


class NormalNoise(_Normal):
    """Numbers of a normal distribution with the mean ``mu`` and the standard deviation ``sigma``."""

    ICON = icons.marked(icons.NOISE, "N")

    mu = ac.Parameter(0.0, doc="mean")
    sigma = ac.Parameter(1.0, min=0, doc="standard deviation")

    def _noise(self, number: Any) -> Any:
        return self.mu + self.sigma * number


class BandLimitedWhiteNoise(_Normal):
    """Normal noise of the power ``noisePower`` at all frequencies well below ``1/samplePeriod``.

    Its standard deviation is ``sqrt(noisePower/samplePeriod)``.
    """

    ICON = icons.NOISE

    noisePower = ac.Parameter(1.0, min=0, doc="power of the noise, per hertz and both sides")

    def _noise(self, number: Any) -> Any:
        return ac.sqrt(self.noisePower / self.samplePeriod) * number


class _Truncated(eqx.Module):
    """Quantile of a normal distribution of which only what lies between two values is left."""

    def __call__(self, u: Any, low: Any, high: Any) -> Any:
        """The quantile of u, with limits in standard deviations from the mean."""
        below, above = ndtr(low), ndtr(high)
        return jnp.clip(ndtri(below + u * (above - below)), low, high)


class TruncatedNormalNoise(PartialNoise):
    """Numbers of a normal distribution, ``mu`` and ``sigma``, of which only ``y_min`` to ``y_max`` is left."""

    ICON = icons.marked(icons.NOISE, "TN")

    y_min = ac.Parameter(0.0, doc="least value")
    y_max = ac.Parameter(1.0, doc="greatest value")
    mu = ac.Parameter(lambda self: (self.y_max + self.y_min) / 2, doc="mean before it is cut")
    sigma = ac.Parameter(
        lambda self: (self.y_max - self.y_min) / 6, min=0, doc="standard deviation before it is cut"
    )
    quantile = ac.Module(lambda _key: _Truncated(), data=True, doc="normal quantile between limits")

    def _noise(self, number: Any) -> Any:
        limits = ((limit - self.mu) / self.sigma for limit in (self.y_min, self.y_max))
        return self.mu + self.sigma * self.quantile(number, *limits)
