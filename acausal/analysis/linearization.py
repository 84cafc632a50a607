"""Linearization of a model: its modes and frequency response."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, cast

import jax
import jax.numpy as jnp
import numpy as np
from jax.typing import ArrayLike
from jaxtyping import Array, Complex, Float, Inexact
from scipy.linalg import expm, qr, solve_continuous_are

from acausal._jax import array, check_time, compiled, is_real, known
from acausal.analysis.operating_point import OperatingPoint
from acausal.analysis.tracking import numbers_by_name
from acausal.codegen import Values
from acausal.errors import DataError, cut_short, listing, need_compiled, need_package, shown, warn
from acausal.modeling import antiderivatives, names_in, with_elements

if TYPE_CHECKING:
    from control import StateSpace
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from acausal.system import Params, System


FREQUENCIES = 400
"""Points of a Bode plot, besides those around resonances."""

STEP_TIMES = 400
"""Points of a step response."""

SETTLED = 7.0
"""After so many time constants a mode has settled: to a thousandth."""

NEGLIGIBLE = 1e-9
"""Eigenvalues below this part of the largest count as zero."""


MOST_STATES = 10
"""Matrices of more states are not shown, nor are more modes."""


@dataclass(frozen=True, eq=False, repr=False)
class Linearization:
    """A model near a point: ``d(dx)/dt = A dx + B du``, ``dy = C dx + D du``.

    Attributes:
        A, B, C, D: arrays of shapes (n, n), (n, m), (p, n), (p, m).
        states, inputs, outputs: names of rows and columns.
        x, u: the point, shapes (n,) and (m,).
    """

    A: Float[Array, "n_states n_states"]
    B: Float[Array, "n_states n_inputs"]
    C: Float[Array, "n_outputs n_states"]
    D: Float[Array, "n_outputs n_inputs"]
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x: Float[Array, " n_states"]
    u: Float[Array, " n_inputs"]

    def __iter__(self) -> Iterator[Float[Array, "rows columns"]]:
        """The four matrices, so that ``A, B, C, D = linearize(...)`` works."""
        return iter((self.A, self.B, self.C, self.D))

    def eigenvalues(self) -> Complex[np.ndarray, " n_states"]:
        """Eigenvalues of A (the poles), in 1/s, slowest first; complex numbers even where all are real."""
        values = np.linalg.eigvals(np.asarray(self.A)).astype(complex)
        return values[np.lexsort((np.imag(values), np.abs(values)))]

    def damping(self) -> Float[np.ndarray, " n_states"]:
        """Damping ratio of every eigenvalue, ``-Re / |.|``; 1 for an integrator."""
        values = self.eigenvalues()
        size = np.abs(values)
        return np.divide(-np.real(values), size, out=np.ones_like(size), where=size > 0)

    def frequency_response(
        self, omega: Float[ArrayLike, " n"]
    ) -> Complex[np.ndarray, "n n_outputs n_inputs"]:
        """``C (jw - A)^-1 B + D`` at angular frequencies [rad/s], shape (len(omega), p, m).

        Where the model has derivatives of an input as inputs, ``der(u)``, that of ``u`` is with them, times ``jw``.

        Raises:
            DataError: for what is not frequencies, or one at which the model has an undamped pole.
        """
        if (
            not is_real(omega)
            or np.ndim(omega) > 1
            or not np.size(omega)
            or not np.isfinite(omega).all()
        ):
            raise DataError(f"omega={shown(omega)} are not frequencies; give numbers, in rad/s.")
        A, B, C, D = (np.asarray(m) for m in (self.A, self.B, self.C, self.D))
        identity, rates = np.eye(len(A)), self._rates()

        def response(w: float) -> Complex[np.ndarray, "n_outputs n_inputs"]:
            moved = np.eye(B.shape[1], dtype=complex)
            for rate, column, order in rates:
                moved[rate, column] = (1j * w) ** order
            try:
                return (C @ np.linalg.solve(1j * w * identity - A, B) + D) @ moved
            except np.linalg.LinAlgError:
                raise DataError(
                    f"omega={w:g} rad/s is an undamped pole of the model, where there is no response; leave it out."
                ) from None

        return np.stack([response(w) for w in np.atleast_1d(omega)])

    def _rates(self) -> list[tuple[int, int, int]]:
        """Inputs that are derivatives of others: their places, those of the others, and how often."""
        chains = enumerate(map(antiderivatives, self.inputs))
        return [
            (place, self.inputs.index(chain[-1]), len(chain) - 1)
            for place, chain in chains
            if len(chain) > 1 and chain[-1] in self.inputs
        ]

    def step_response(
        self, t: Float[ArrayLike, " n"] | float | None = None
    ) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, "n n_outputs n_inputs"]]:
        """The outputs after a unit step of each input, as deviations from the point; exact at every time.

        Arguments:
            t: times [s], equally spaced from 0, or the last of `STEP_TIMES` such times; by default as long as the
                slowest mode takes to settle.

        Returns:
            The times, and the outputs, shape (n, p, m).

        Raises:
            DataError: for what is not times.
        """
        if rates := self._rates():
            warn(
                f"step_response: the model takes {listing(self.inputs[i] for i, *_ in rates)}, which a step has only "
                "at its instant: that is left out."
            )
        A, B, C, D = (np.asarray(m) for m in (self.A, self.B, self.C, self.D))
        times = _times(t, self.eigenvalues())
        n, m = B.shape
        step = expm(np.block([[A, B], [np.zeros((m, n + m))]]) * (times[1] - times[0]))
        x = np.zeros((len(times), n, m))
        for i in range(1, len(times)):
            x[i] = step[:n, :n] @ x[i - 1] + step[:n, n:]
        return times, C @ x + D

    def bode(
        self, omega: Float[ArrayLike, " n"] | None = None, *, axes: Sequence[Axes] | None = None
    ) -> Figure:
        """Draw magnitude and phase of every output by every input over the frequency.

        Arguments:
            omega: angular frequencies [rad/s]; by default around the model's modes.
            axes: two matplotlib axes; by default a new figure's.

        Returns:
            The matplotlib figure.

        Raises:
            DataError: without inputs or outputs, and for what is not frequencies.
        """
        from acausal.reporting import plot_bode

        omega = self._frequencies(omega)
        return plot_bode(omega, self._curves(self.frequency_response(omega)), axes=axes)

    def nyquist(
        self, omega: Float[ArrayLike, " n"] | None = None, *, ax: Axes | None = None
    ) -> Figure:
        """Draw the frequency response in the complex plane, with the point -1; arguments and errors as of `bode`."""
        from acausal.reporting import plot_nyquist

        omega = self._frequencies(omega)
        return plot_nyquist(self._curves(self.frequency_response(omega)), ax=ax)

    def step(
        self,
        t: Float[ArrayLike, " n"] | float | None = None,
        *,
        axes: Sequence[Axes] | None = None,
    ) -> Figure:
        """Draw the outputs after a unit step of each input, each output in a diagram of its own.

        Arguments:
            t: as of `step_response`.
            axes: matplotlib axes, one for each output; by default a new figure's.

        Returns:
            The matplotlib figure.

        Raises:
            DataError: without inputs or outputs, and for what is not times.
        """
        from acausal.reporting import plot_steps

        self._need_signals()
        times, y = self.step_response(t)
        curves = {
            output: {f"step of {u}": y[:, i, j] for j, u in enumerate(self.inputs)}
            for i, output in enumerate(self.outputs)
        }
        return plot_steps(times, curves, axes=axes)

    def lqr(
        self, states: Mapping[str, float], inputs: Mapping[str, float]
    ) -> Float[np.ndarray, "n_inputs n_states"]:
        """The gain K of the feedback ``u - K (state - x)`` with the least ``∫ Σ w x² + Σ w u² dt`` of deviations.

        Arguments:
            states: their weights, by name; 0 for others.
            inputs: the weights of all inputs, by name.

        Raises:
            DataError: for a name or weight that does not fit, or a mode that the inputs cannot stabilize.
        """
        w = _weights(states, self.states, "states")
        r = _weights(inputs, self.inputs, "inputs", all_of_them=True)
        B = np.asarray(self.B)
        return (B.T @ self._riccati(np.asarray(self.A), B, w, r, "inputs")) / r[:, None]

    def kalman(
        self, noise: Mapping[str, float], sensors: Mapping[str, float]
    ) -> Float[np.ndarray, "n_states n_outputs"]:
        """The gain L of the steady filter ``d(dx)/dt = A dx + B du + L (dy - C dx - D du)``.

        Arguments:
            noise: of the process, by state: the standard deviation of a random walk after one second; 0 for others.
            sensors: of all outputs, by name: the standard deviation of their noise times the root of the sample time.

        Raises:
            DataError: for a name or number that does not fit, or a mode that the outputs do not show.
        """
        q = _weights(noise, self.states, "noise") ** 2
        r = _weights(sensors, self.outputs, "sensors", all_of_them=True) ** 2
        C = np.asarray(self.C)
        return self._riccati(np.asarray(self.A).T, C.T, q, r, "outputs") @ C.T / r

    @staticmethod
    def _riccati(
        A: Float[np.ndarray, "n n"],
        B: Float[np.ndarray, "n m"],
        q: Float[np.ndarray, " n"],
        r: Float[np.ndarray, " m"],
        what: str,
    ) -> Float[np.ndarray, "n n"]:
        try:
            return solve_continuous_are(A, B, np.diag(q), np.diag(r))
        except np.linalg.LinAlgError:
            raise DataError(
                f"There is no gain: a mode that does not decay is not reached by the {what}, or has no weight; "
                f"give more {what}, or more weights."
            ) from None

    def to_control(self) -> StateSpace:
        """The same for the package python-control, with the names of states, inputs and outputs.

        Its names have no dots: ``motor.w`` is ``motor_w`` there.

        Raises:
            DataError: if python-control is not installed.
        """
        StateSpace = need_package("control", "to_control", "control").StateSpace
        names = {
            kind: [name.replace(".", "_") for name in given]
            for kind, given in (
                ("states", self.states), ("inputs", self.inputs), ("outputs", self.outputs),
            )
        }  # fmt: skip
        return StateSpace(*(np.asarray(m) for m in self), **names)

    def _need_signals(self) -> None:
        for what, names in (("inputs", self.inputs), ("outputs", self.outputs)):
            if not names:
                raise DataError(
                    f"The linearization has no {what}; "
                    + (
                        "the model has none."
                        if what == "inputs"
                        else "give linearize(..., outputs=[...])."
                    )
                )

    def _frequencies(self, omega: Float[ArrayLike, " n"] | None) -> Float[ArrayLike, " n"]:
        self._need_signals()
        return frequencies(self.eigenvalues()) if omega is None else np.atleast_1d(omega)

    def _curves(
        self, values: Inexact[np.ndarray, "n n_outputs n_inputs"]
    ) -> dict[str, Inexact[np.ndarray, " n"]]:
        """The responses by a label for each pair of output and input."""
        return {
            f"{y} by {u}" if len(self.inputs) > 1 else y: values[:, i, j]
            for i, y in enumerate(self.outputs)
            for j, u in enumerate(self.inputs)
        }

    def __repr__(self) -> str:
        shape = f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        modes = [f"  {text}" for text in self._modes()]
        small = len(self.states) <= MOST_STATES
        matrices = [
            f"  {name} = " + np.array2string(np.asarray(m) + 0.0, precision=4, prefix=" " * 6)
            for name, m in zip("ABCD", self, strict=True)
            if small and m.size
        ]
        return "\n".join([f"Linearization({shape})", *modes, *matrices])

    def _modes(self) -> list[str]:
        """The first modes, in words: a pair of complex eigenvalues is one."""
        values = [
            (v, z) for v, z in zip(self.eigenvalues(), self.damping(), strict=True) if v.imag >= 0
        ]
        return cut_short(values, MOST_STATES, lambda mode: f"mode {_in_words(*mode)}")

    def _repr_html_(self) -> str:
        from acausal.reporting import View, html_table

        view = View("Linearization", "; ".join(self._modes()))
        rows = {"A": self.states, "B": self.states, "C": self.outputs, "D": self.outputs}
        columns = {"A": self.states, "B": self.inputs, "C": self.states, "D": self.inputs}
        for (name, down), m in zip(rows.items(), self, strict=True):
            if m.size and len(self.states) <= MOST_STATES:
                cells = [(n, *row) for n, row in zip(down, np.asarray(m).tolist(), strict=True)]
                view.folded(name, html_table(("", *columns[name]), cells), opened=True)
        return str(view)


def _in_words(eigenvalue: complex, damping: float) -> str:
    damping = 0.0 if abs(damping) < 1e-12 else damping  # of rounding, with a sign
    if eigenvalue.imag:
        frequency = abs(eigenvalue) / (2 * np.pi)
        shown = f"{eigenvalue.real + 0.0:.4g} ± {eigenvalue.imag:.4g}j"
        return f"{shown}: {frequency:.4g} Hz, damping {damping:.3g}"
    rate = eigenvalue.real
    return f"{rate:.4g}" + (f": time constant {-1 / rate:.4g} s" if rate < 0 else "")


def _weights(
    given: Mapping[str, float], names: tuple[str, ...], argument: str, *, all_of_them: bool = False
) -> Float[np.ndarray, " n"]:
    """Numbers by name that are not negative; above zero where all are needed."""
    by_name = numbers_by_name(given, names, argument, "in the linearization")
    found = np.array([float(by_name.get(n, 0.0)) for n in names])
    if all_of_them and not (len(names) and (found > 0).all()):
        lacking = next((n for n, v in zip(names, found, strict=True) if not v > 0), None)
        raise DataError(
            f"{argument}: give a number above zero for '{lacking}'."
            if lacking
            else f"{argument}: the linearization has none; give linearize(..., outputs=[...])."
        )
    return found


def frequencies(modes: Complex[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Angular frequencies [rad/s] that show a model's modes: a decade to either side, closer around resonances."""
    size = np.abs(modes)[np.abs(modes) > NEGLIGIBLE * np.max(np.abs(modes), initial=0.0)]
    low, high = (np.log10(size.min()), np.log10(size.max())) if len(size) else (0.0, 0.0)
    omega = np.logspace(np.floor(low - 0.5), np.ceil(high + 0.5), FREQUENCIES)
    resonant = modes[np.abs(np.imag(modes)) > np.abs(np.real(modes))]
    around = np.multiply.outer(np.abs(resonant), 1 + np.linspace(-0.1, 0.1, 40))
    return np.unique(np.concatenate([omega, around.ravel()]))


def _times(
    t: Float[ArrayLike, " n"] | float | None, modes: Complex[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Equal steps from 0."""
    if t is None:
        rates = -np.real(modes)
        damped = rates[rates > NEGLIGIBLE * np.max(np.abs(modes), initial=0.0)]
        t = SETTLED / damped.min() if len(damped) else 1.0
    if not is_real(t):
        raise DataError(f"t={shown(t)} are not times; give seconds.")
    times = np.asarray(t, float)
    times = np.linspace(0.0, times, STEP_TIMES) if times.ndim == 0 else times
    wrong = times.ndim != 1 or len(times) < 2 or not np.isfinite(times).all() or times[-1] <= 0
    if wrong or times[0] or not np.allclose(np.diff(times), times[-1] / (len(times) - 1)):
        raise DataError(f"t={shown(t)} are not times; give equal steps from 0, or the last time.")
    return times


Where: TypeAlias = "Mapping[str, ArrayLike] | Float[ArrayLike, ' n_states'] | OperatingPoint | Literal['steady'] | None"
"""States by name or all as an array, an operating point, the model's rest, or (``None``) its initial state."""


def point_of(
    system: System,
    x: Where,
    inputs: Mapping[str, Any] | Float[ArrayLike, " n_inputs"] | None,
    params: Params | None,
    t: float | None,
) -> Values:
    """The values of a model where it is linearized, with what holds there; arguments and errors as of `linearize`."""
    if isinstance(x, OperatingPoint):
        if inputs is None and params is None and t is None:
            return x.values
        params, t = x.values.packed if params is None else params, x.time if t is None else t
        inputs = x.u if inputs is None else inputs
        x = x.x
    t = 0.0 if t is None else t
    check_time(t)
    packed, given = system.pack(params), system.inputs_at(t, inputs)
    system.check(packed)
    state = system.initial_state(packed, x, inputs=given, t0=t)
    begun = system.initializer.discrete_starts(packed, x)
    return system.in_modes(system.values(t, state, given, packed)._replace(d=begun))


def linearize(
    system: System,
    x: Where = None,
    inputs: Mapping[str, Any] | Float[ArrayLike, " n_inputs"] | None = None,
    *,
    outputs: str | Sequence[str] = (),
    params: Params | None = None,
    t: float | None = None,
) -> Linearization:
    """Linearize a model at a point, with the conditions as they are there: switches, diodes, frictions.

    Arguments:
        system: a compiled model.
        x: states by name (the rest from the model's starts) or all as an array; by default the model's initial state.
            ``"steady"`` is its rest. An `OperatingPoint` gives states, inputs, parameters and time, unless these are
            given, too.
        inputs: by name, numbers or functions of time (the rest zero), or all as an array; by default zero.
        outputs: variables to take as outputs; the name of an array stands for all of its elements.
        params: parameters, by default the model's own.
        t: time [s], by default 0.

    Raises:
        DataError: if ``x`` or ``inputs`` do not fit the model, or where it or its derivatives are not finite.
        ModelError: for an output that the model does not have, and for a model that is not compiled.
    """
    need_compiled(system, "linearize")
    outputs = with_elements(names_in(outputs, "outputs"), system.variables)
    at = point_of(system, x, inputs, params, t)
    system.warn_of_sampled("linearize")
    at = at._replace(t=array(at.t))  # one program for all times
    (a, b), (c, d) = _matrices(system, outputs, at)
    _need_finite(system, outputs, at, (a, b, c, d))
    n = system.reduced.n_independent
    if system.reduced.gaps:
        chosen, along = _independent(system, at)
        a, c = a @ along, c @ along
    else:  # the guesses of loops follow from the other states
        chosen, a, c = np.arange(n), a[:, :n], c[:, :n]
    names = tuple(system.states[i] for i in chosen.tolist())
    x = at.x[chosen]
    return Linearization(a[chosen], b[chosen], c, d, names, system.inputs, outputs, x, at.u)


def _need_finite(
    system: System, outputs: tuple[str, ...], at: Values, matrices: tuple[Array, ...]
) -> None:
    """Refuse a point at which the model has no derivatives; in a trace nothing is known of them.

    Raises:
        DataError: that names the equation, or the derivative.
    """
    rows = [*(f"der({name})" for name in system.states), *outputs]
    a, b, c, d = map(known, matrices)
    if a is None or b is None or c is None or d is None:
        return
    all_of = np.vstack([np.hstack([a, b]), np.hstack([c, d])])
    bad = np.argwhere(~np.isfinite(all_of))
    if not len(bad):
        return
    if reason := system.explain_nonfinite(at) or (
        system.explain_nonfinite(at, outputs) if outputs else None
    ):
        raise DataError(f"linearize: {reason}")
    i, j = bad[0]
    by = [*system.states, *system.inputs][j]
    raise DataError(
        f"linearize: the derivative of '{rows[i]}' by '{by}' is {all_of[i, j]} at this point; choose another (x=...)."
    )


def _independent(system: System, at: Values) -> tuple[np.ndarray, Array]:
    """As many projected and other states as there are degrees of freedom, and how all states move with these."""
    n = system.reduced.n_independent
    moved = np.asarray(jax.jacfwd(lambda x: system.closed(at._replace(x=x)))(at.x))
    _, order = cast(Any, qr(moved[:n].T, pivoting=True, mode="r"))
    chosen = np.sort(order[: n - len(system.reduced.gaps)])
    return chosen, jnp.asarray(moved @ np.linalg.pinv(moved[chosen]))


@compiled
def _matrices(
    system: System, outputs: tuple[str, ...], at: Values
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """The derivatives of the rates by states and inputs, and those of the outputs."""

    def rates_and_outputs(x: Array, u: Array) -> tuple[Array, Array]:
        values = at._replace(x=x, u=u)
        observed = system.read(outputs, values) if outputs else jnp.zeros(0)
        return system.rates(values), observed

    return jax.jacfwd(rates_and_outputs, argnums=(0, 1))(at.x, at.u)
