"""Gradients of simulations on every path that a solver can take, and central differences to compare them with."""

from __future__ import annotations

import functools
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

import acausal as ac
from acausal.simulation import Steps, functions_of_time, integrate, solvers
from acausal.simulation.inputs import evaluate_all
from acausal.simulation.sampled_inputs import over_steps
from tests.support.slow import in_turn

from .models import CASES, Case

STEPS = 8
MOST = 5
"""Parameters of a model that are moved one by one, drawn at random where there are more."""

LANES = 8
"""Gradients side by side."""

QUICK = {"xla_backend_optimization_level": 0}
"""The programs run a few times only."""

FRACTIONS = (0.02, 0.005, 0.001)
"""Relative steps of the differences."""


@dataclass(frozen=True)
class Subject:
    """A compiled model, and what is moved: ``shift`` has one number for each of ``names``.

    Attributes:
        base: all parameters, and ``direction``: of networks' weights, for the last of the numbers.
    """

    case: Case
    system: ac.System
    names: tuple[str, ...]
    base: dict[str, Any]
    direction: dict[str, Any]

    def params(self, shift: Array) -> dict[str, Any]:
        """Each parameter moved by a fraction of itself (of 1 where it is 0), and the networks along their direction."""
        moved = dict(self.base)
        for name, s in zip(self.names, shift, strict=False):
            moved[name] = self.base[name] + s * (abs(self.base[name]) or 1.0)
        for name, direction in self.direction.items():
            moved[name] = jax.tree.map(
                lambda w, d: w + shift[len(self.names)] * d if d is not None else w,
                self.base[name],
                direction,
                is_leaf=lambda a: a is None,
            )
        return moved

    def x0(self, shift: Array) -> dict[str, Any] | None:
        """The initial values that are given, each moved, too."""
        given = list(self.case.x0.items())
        first = len(self.names) + bool(self.direction)
        return {n: v + shift[first + k] * (abs(v) or 1.0) for k, (n, v) in enumerate(given)} or None

    @property
    def size(self) -> int:
        return len(self.names) + bool(self.direction) + len(self.case.x0)


@functools.cache
def subject(name: str) -> Subject:
    """A model by its name."""
    case = CASES[name]
    system = ac.compile(case.make())
    rng = np.random.default_rng(zlib.crc32(name.encode()))
    base = system.parameters(0)
    movable = [n for n in system.layout.names if n not in case.kept]
    names = tuple(n for n in movable if n in set(rng.permutation(movable)[:MOST].tolist()))

    def along(leaf: Any) -> Any:
        if not (
            isinstance(leaf, jax.Array | np.ndarray) and jnp.issubdtype(leaf.dtype, jnp.floating)
        ):
            return None
        return jnp.asarray(rng.standard_normal(leaf.shape))

    networks = {
        n: base[n]
        for n in base
        if n not in system.layout.names and not isinstance(base[n], ac.Signal)
    }
    direction = {n: jax.tree.map(along, net) for n, net in networks.items()}
    return Subject(case, system, names, base, direction)


# -- values: (subject, shift) -> what is simulated, a vector ---------------------------------------------------------


def observed(s: Subject) -> list[str]:
    """Some variables besides the states."""
    rng = np.random.default_rng(0)
    free = [n for n in s.system.variables if n not in s.system.states and "port" not in n]
    return sorted(rng.choice(free, min(2, len(free)), replace=False).tolist()) if free else []


def simulated(**how: Any) -> Callable[[Subject, Array], Array]:
    """A run of `acausal.simulate`: the states in the middle and at the end, and some variables there."""

    def values(s: Subject, shift: Array) -> Array:
        end = s.case.end
        steps = {"dt": end / STEPS} if "rtol" not in how else {}
        run = ac.simulate(
            s.system,
            (0.0, end),
            saveat=[end / 2, end],
            inputs=s.case.inputs,
            params=s.params(shift),
            x0=s.x0(shift),
            **steps,
            **how,
        )
        return jnp.concatenate([run.x.ravel(), *(run[n] for n in observed(s))])

    return values


def substeps(s: Subject, shift: Array) -> Array:
    """The steps of a training, each of three parts, with outputs that share the first stage."""
    system, end = s.system, s.case.end
    ends = np.linspace(0.0, end, STEPS + 1)
    functions = functions_of_time(system, s.case.inputs, (0.0, end), ends)
    packed = system.pack(s.params(shift))
    u = evaluate_all(functions, jnp.zeros(1))[0]
    x = system.initial_state(packed, s.x0(shift), u, 0.0)
    steps = Steps(jnp.asarray(ends[:-1]), jnp.asarray(end / STEPS), over_steps(functions, ends))
    found = integrate(
        system,
        system.values(0.0, x, u, packed),
        steps,
        solvers.solver_named("heun"),
        outputs=observed(s),
        substeps=3,
    )
    return jnp.concatenate(
        [found.x[STEPS // 2], found.end, *([] if found.y is None else [found.y[-1]])]
    )


@dataclass(frozen=True)
class Path:
    """A way to a gradient.

    Attributes:
        values: what is differentiated. ``bar``: the largest error, relative to the largest component.
        mode: ``reverse``, ``forward``, or ``lanes``: several in reverse mode, side by side.
        reference: the path whose differences it is compared with, where that has the same values.
    """

    values: Callable[[Subject, Array], Array]
    bar: float
    mode: str = "reverse"
    reference: str = ""


FIXED, ADAPTIVE = 1e-7, 1e-6
"""The largest error allowed, relative to the largest component.

In fixed steps both are derivatives of one smooth function, and the differences are good to 1e-9: what remains is the
tolerance of Newton's method. Adaptive steps are chosen anew for every difference: each choice moves the result by about
the tolerance, which the difference divides by its step. For a cubic record, whose samples are corners, the gradient at
a tolerance of 1e-8, 1e-10 and 1e-12 is good to 2e-7, 5e-10 and 2e-11, and the differences are to 6e-4, 1e-5 and 3e-8.
"""

TIGHT = {"rtol": 1e-12, "atol": 1e-14, "max_steps": 4096}
PATHS: dict[str, Path] = {
    "rk4": Path(simulated(solver="rk4"), FIXED),
    "rk4 in lanes": Path(simulated(solver="rk4"), FIXED, "lanes", "rk4"),
    "rk4, stages stored": Path(
        simulated(solver="rk4", adjoint=diffrax.DirectAdjoint()), FIXED, "reverse", "rk4"
    ),
    "rk4 forward": Path(
        simulated(solver="rk4", adjoint=diffrax.ForwardMode()), FIXED, "forward", "rk4"
    ),
    "heun with substeps": Path(substeps, FIXED),
    "implicit Euler": Path(simulated(solver="implicit_euler"), FIXED),
    "kvaerno3 forward": Path(
        simulated(solver="kvaerno3", adjoint=diffrax.ForwardMode()), FIXED, "forward"
    ),
    "adaptive": Path(simulated(solver="tsit5", **TIGHT), ADAPTIVE),
    "adaptive forward": Path(
        simulated(solver="tsit5", adjoint=diffrax.ForwardMode(), **TIGHT), ADAPTIVE, "forward"
    ),
    "adaptive, forward by the default adjoint": Path(
        simulated(solver="tsit5", **TIGHT), ADAPTIVE, "forward"
    ),
    "adaptive, implicit": Path(simulated(solver="kvaerno5", **TIGHT), ADAPTIVE),
}


ALWAYS = {"explicit": ("rk4",), "implicit": (), "adaptive": ()}
IN_TURN = {
    "adaptive": (
        "adaptive",
        "adaptive forward",
        "adaptive, forward by the default adjoint",
        "adaptive, implicit",
    ),
    "explicit": ("rk4 in lanes", "rk4 forward", "rk4, stages stored", "heun with substeps"),
    "implicit": ("implicit Euler", "kvaerno3 forward"),
}
"""Every model takes one path of each kind: all models on all paths would take half an hour to compile.

In the slow tests it takes those of one kind (`cases_of`)."""


LEFT_OUT = {("sparse nonlinear loop", "adaptive")}
"""Its thousands of factorizations on the host take minutes at so small a tolerance; fixed steps show its gradients."""


DEAR = (
    "bearing friction",
    "bridge of diodes",
    "diode",
    "fluid",
    "from rest",
    "neural coil",
    "neural gear",
    "sparse nonlinear loop",
    "state space",
)
"""Models whose gradients take longest to compile: with all combinations only."""


def cases_of(kind: str) -> list[Any]:
    """The models for ``parametrize``, in one kind of steps: a third of them, in turn, are slow tests."""
    cases = in_turn(CASES, len(IN_TURN), list(IN_TURN).index(kind), DEAR)
    return [case for case in cases if (case.values[0], kind) not in LEFT_OUT]


def paths_of(name: str, kind: str) -> list[str]:
    """The paths of a model: those of explicit, of implicit, or of adaptive steps."""
    if (name, kind) in LEFT_OUT:
        return []
    k, turn = list(CASES).index(name), IN_TURN[kind]
    return [*ALWAYS[kind], turn[(k + k // 6) % len(turn)]]


@dataclass(frozen=True)
class Compared:
    """A gradient beside its differences."""

    error: float
    gradient: np.ndarray
    differences: np.ndarray


def compare(
    name: str, path: Path, differences: np.ndarray | None, weights: np.ndarray | None
) -> tuple[Compared, np.ndarray]:
    """The gradient of a model on a path beside differences (those given, or its own), and the weights of its values."""
    s = subject(name)
    zero = jnp.zeros(s.size)

    def loss(shift: Array, weights: Array) -> tuple[Array, Array]:
        found = path.values(s, shift)
        return weights @ found, found

    def both(shift: Array, weights: Array) -> tuple[Array, Array]:
        if path.mode == "forward":
            tangents, found = jax.jacfwd(loss, has_aux=True)(shift, weights)
            return tangents, found
        return jax.grad(loss, has_aux=True)(shift, weights)

    if path.mode == "lanes":
        run = jax.jit(jax.vmap(both, (0, None)), compiler_options=QUICK)
        shifts = jnp.concatenate(
            [
                zero[None],
                1e-3 * jnp.asarray(np.random.default_rng(1).standard_normal((LANES - 1, s.size))),
            ]
        )
        assert weights is not None
        assert differences is not None
        gradient = np.asarray(run(shifts, jnp.asarray(weights))[0])[0]
        return judged(gradient, differences), weights
    run = jax.jit(both, compiler_options=QUICK)
    if weights is None:
        n = jax.eval_shape(lambda z: path.values(s, z), zero).shape[0]
        values = np.asarray(run(zero, jnp.zeros(n))[1])
        rng = np.random.default_rng(2)
        weights = rng.uniform(0.5, 1.5, n) / np.maximum(
            np.abs(values), 1e-6 * np.abs(values).max() + 1e-12
        )
    w = jnp.asarray(weights)
    gradient = np.asarray(run(zero, w)[0])
    if differences is None:
        differences = central(
            lambda shift: weights @ np.asarray(run(jnp.asarray(shift), w)[1]), s.size
        )
    return judged(gradient, differences), weights


def check(name: str, paths: list[str], record_property: Callable[[str, Any], None]) -> None:
    """Compare the gradients of a model on some paths."""
    known: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    for p in paths:
        path = PATHS[p]
        found, weights = compare(name, path, *known.get(path.reference, (None, None)))
        known[p] = found.differences, weights
        record_property("gradient", (p, found.error, name))
        assert found.error < path.bar, f"{name}, {p}: {found.gradient} beside {found.differences}"


def judged(gradient: np.ndarray, differences: np.ndarray) -> Compared:
    """The largest error, relative to the largest component (all are by relative changes of a parameter)."""
    scale = float(np.abs(differences).max())
    error = (
        float(np.abs(gradient - differences).max()) / scale
        if scale
        else float(np.abs(gradient).max())
    )
    return Compared(error, gradient, differences)


def central(function: Callable[[np.ndarray], float], size: int) -> np.ndarray:
    """Central differences by each number, extrapolated to a step of zero (Richardson).

    The error of a difference is ``a h**2 + b h**4 + rounding/h``; two steps, one half of the other, remove the first
    term. Of the steps, for each number that is taken where two neighbouring results agree best: for longer ones the
    truncation is larger, for shorter ones the rounding.
    """
    result = np.zeros(size)
    for i in range(size):
        unit = np.eye(size)[i]

        def difference(h: float, unit: np.ndarray = unit) -> float:
            return (function(h * unit) - function(-h * unit)) / (2 * h)

        found = [(4 * difference(h / 2) - difference(h)) / 3 for h in FRACTIONS]
        gaps = np.abs(np.diff(found))
        best = int(np.nanargmin(gaps)) if np.isfinite(gaps).any() else 0
        result[i] = found[best + 1]
    return result
