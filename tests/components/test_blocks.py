"""Signal blocks: MSL's names and defaults, sources over time, functions at points, responses."""

import importlib
import inspect
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy import signal as scipy_signal

import acausal as ac
from acausal.components import blocks
from acausal.flattening.flat_model import flatten

signal: Any = scipy_signal  # its types are partly unknown

BASES = {
    *vars(importlib.import_module("acausal.components.blocks.interfaces")),
    "PartialColumns", "PartialConversionBlock", "PartialNoise",
}  # fmt: skip

# Parameters and options with their defaults, as in MSL 4.1.0 (`...` marks those without a default,
# `float` a default that follows from other parameters).
DEFAULTS: dict[str, dict[str, Any]] = {
    "Constant": {"k": ...},
    "ContinuousClock": {"offset": 0, "startTime": 0},
    "Step": {"height": 1, "offset": 0, "startTime": 0},
    "Ramp": {"height": 1, "duration": ..., "offset": 0, "startTime": 0},
    "Sine": {
        "amplitude": 1, "f": ..., "phase": 0, "continuous": False, "offset": 0, "startTime": 0,
    },
    "Cosine": {
        "amplitude": 1, "f": ..., "phase": 0, "continuous": False, "offset": 0, "startTime": 0,
    },
    "SineVariableFrequencyAndAmplitude": {
        "useConstantAmplitude": False, "constantAmplitude": 1, "useConstantFrequency": False,
        "constantFrequency": 1, "offset": 0,
    },
    "Sinc": {"amplitude": 1, "f": ..., "offset": 0, "startTime": 0},
    "ExpSine": {
        "amplitude": 1, "f": ..., "phase": 0, "damping": ..., "offset": 0, "startTime": 0,
    },
    "Exponentials": {
        "outMax": 1, "riseTime": ..., "riseTimeConst": 0.1, "fallTimeConst": float, "offset": 0,
    },
    "Pulse": {"amplitude": 1, "width": 50, "period": ..., "nperiod": -1, "offset": 0},
    "SawTooth": {"amplitude": 1, "period": ..., "nperiod": -1, "offset": 0, "startTime": 0},
    "Trapezoid": {
        "amplitude": 1, "rising": 0, "width": 0.5, "falling": 0, "period": ..., "nperiod": -1,
    },
    "LogFrequencySweep": {"wMin": ..., "wMax": ..., "startTime": 0, "duration": ...},
    "KinematicPTP": {"deltaq": [1], "qd_max": [1], "qdd_max": [1], "startTime": 0},
    "KinematicPTP2": {"q_begin": [0], "q_end": [1], "qd_max": [1], "qdd_max": [1], "startTime": 0},
    "TimeTable": {"timeScale": 1, "offset": 0, "startTime": 0, "shiftTime": float},
    "CombiTimeTable": {
        "smoothness": "LinearSegments", "extrapolation": "LastTwoPoints", "timeScale": 1,
        "offset": [0], "startTime": 0, "shiftTime": float,
    },
    "Gain": {"k": ...},
    "MatrixGain": {"K": [[1, 0], [0, 1]]},
    "Add": {"k1": 1, "k2": 1},
    "Add3": {"k1": 1, "k2": 1, "k3": 1},
    "Sum": {"nin": 1, "k": 1},
    "Log": {"base": np.e},
    "Power": {"base": np.e, "useExp": True},
    "WrapAngle": {"positiveRange": False},
    "Integrator": {"k": 1, "initType": "InitialState", "y_start": 0, "use_reset": False},
    "LimIntegrator": {"k": 1, "outMax": ..., "outMin": float, "initType": "InitialState"},
    "Derivative": {"k": 1, "T": 0.01, "initType": "NoInit", "x_start": 0, "y_start": 0},
    "FirstOrder": {"k": 1, "T": ..., "initType": "NoInit", "y_start": 0},
    "SecondOrder": {"k": 1, "w": ..., "D": ..., "initType": "NoInit", "y_start": 0, "yd_start": 0},
    "PI": {"k": 1, "T": ..., "initType": "NoInit", "x_start": 0, "y_start": 0},
    "PID": {
        "k": 1, "Ti": ..., "Td": ..., "Nd": 10, "initType": "InitialState", "xi_start": 0,
        "xd_start": 0, "y_start": 0,
    },
    "LimPID": {
        "controllerType": "PID", "k": 1, "Ti": 0.5, "Td": 0.1, "yMax": ..., "yMin": float, "wp": 1,
        "wd": 0, "Ni": 0.9, "Nd": 10, "withFeedForward": False, "kFF": 1, "initType": "NoInit",
        "xi_start": 0, "xd_start": 0, "y_start": 0, "strict": False, "homotopyType": "Linear",
    },
    "TransferFunction": {"b": [1], "a": [1], "initType": "NoInit", "x_start": 0, "y_start": 0},
    "StateSpace": {"A": ..., "B": ..., "C": ..., "D": 0, "initType": "NoInit", "x_start": 0},
    "LowpassButterworth": {"n": 2, "f": ..., "initType": "NoInit", "y_start": 0},
    "CriticalDamping": {"n": 2, "f": ..., "normalized": True, "initType": "NoInit"},
    "Filter": {
        "analogFilter": "CriticalDamping", "filterType": "LowPass", "order": 2, "f_cut": ...,
        "gain": 1, "A_ripple": 0.5, "f_min": 0, "normalized": True, "init": "SteadyState",
        "y_start": 0, "u_nominal": 1,
    },
    "Limiter": {"uMax": ..., "uMin": float},
    "DeadZone": {"uMax": ..., "uMin": float},
}  # fmt: skip

NEEDED: dict[str, dict[str, Any]] = {
    "CombiTimeTable": {"table": [[0, 1], [1, 2]]},
    "TimeTable": {"table": [[0, 1], [1, 2]]},
    "SampledSignal": {"values": [0, 1], "dt": 0.1},
    "RealExpression": {"y": 1.0},
    "StateSpace": {"A": [[-1.0]], "B": [[1.0]], "C": [[1.0]]},
    "Polynomial": {"c": [1.0, 2.0]},
    "MinMax": {"nu": 2},
    "MultiSwitch": {"nu": 2, "expr": [1.0, 2.0]},
    "RadioButtonSource": {"reset": [False]},
    "TerminateSimulation": {"condition": False},
    "BooleanExpression": {"y": True},
    "IntegerExpression": {"y": 2},
    "IntegerTable": {"table": [[0, 1], [1, 2]]},
    "CombiTable1Ds": {"table": [[0, 1], [1, 2]]},
    "CombiTable1Dv": {"table": [[0, 1], [1, 2]]},
    "CombiTable2Ds": {"table": [[0, 1], [1, 2]]},
    "CombiTable2Dv": {"table": [[0, 1], [1, 2]]},
}


def minimal(name):
    """An instance with the value 1 for all that must be given."""
    cls = getattr(blocks, name)
    needed = {
        n: 1.0
        for n, d in cls._declared.items()
        if isinstance(d, ac.Parameter) and d.default is None
    }
    return cls(**{**needed, **NEEDED.get(name, {})})


def classes():
    """Names of the blocks that can be made."""
    found = {n: getattr(blocks, n) for n in blocks.__all__ if n not in BASES}
    made = {n: c for n, c in found.items() if inspect.isclass(c) and issubclass(c, ac.Component)}
    return [n for n, c in made.items() if not issubclass(c, blocks.NeedsDiscreteStates)]


class Panel(ac.Component):
    """Blocks side by side, all fed with the inputs of the panel where they have such."""

    u1 = ac.Input()
    u2 = ac.Input()

    def __init__(self, **parts):
        super().__init__()
        for name, part in parts.items():
            setattr(self, name, part)
            for signals, own in (
                (("u", "u1", "u_s", "u_re", "u_abs"), self.u1),
                (("u2", "u_m", "u_im", "u_arg"), self.u2),
            ):
                for s in signals:
                    if s in type(part)._declared and not isinstance(getattr(part, s), np.ndarray):
                        self.connect(own, getattr(part, s))


def evaluated(model, outputs, points):
    """Outputs of a model without states at points ``(t, u1, u2)``, as arrays by name."""
    system = ac.compile(model)
    assert not system.states
    params = system.parameters()
    position = {"u1": 1, "u2": 2}

    @jax.jit
    @jax.vmap
    def observe(point):
        u = jnp.stack([point[position[n]] for n in system.inputs]) if system.inputs else None
        return system.observe(outputs, point[0], jnp.zeros(0), u, params)

    return dict(zip(outputs, np.asarray(observe(jnp.asarray(points))).T, strict=True))


# -- declarations ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", blocks.__all__)
def test_every_class_is_documented(name):
    assert inspect.getdoc(getattr(blocks, name))


@pytest.mark.parametrize("name", DEFAULTS)
def test_names_and_defaults_are_those_of_the_standard_library(name):
    for key, default in DEFAULTS[name].items():
        declared = getattr(blocks, name)._declared[key].default
        if default is ...:
            assert declared is None, key
        elif default is float:
            assert callable(declared), key
        else:
            assert np.array_equal(declared, default), key


@pytest.mark.parametrize("name", classes())
def test_every_class_has_as_many_equations_as_unknowns(name):
    model = flatten(minimal(name))
    unknowns = model.n_variables - len(model.inputs) - len(model.discrete)
    assert model.n_equations == unknowns


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: blocks.CombiTimeTable(), r"needs table=\[\[t, y, ...\], ...\]"),
        (lambda: blocks.CombiTimeTable(table=[[0, 1]], columns=[3]), "columns 2 to 2"),
        (lambda: ac.compile(blocks.SampledSignal(values=[1, 2])).parameters(), "either ts"),
        (lambda: flatten(blocks.TransferFunction(b=[1, 2], a=[1])), "numerator has 2"),
    ],
)
def test_wrong_data_are_refused(make, message):
    with pytest.raises(ac.DeclarationError, match=message):
        make()


# -- sources -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def over_time():
    parts = {
        "expression": blocks.RealExpression(y=2 * ac.sin(ac.time)),
        "constant": blocks.Constant(k=3),
        "clock": blocks.ContinuousClock(offset=1, startTime=0.5),
        "step": blocks.Step(height=2, offset=1, startTime=0.5),
        "ramp": blocks.Ramp(height=2, duration=0.5, offset=1, startTime=0.5),
        "sudden": blocks.Ramp(height=2, duration=0, startTime=0.5),
        "sine": blocks.Sine(amplitude=2, f=1.5, phase=0.3, offset=1, startTime=0.5),
        "held": blocks.Sine(amplitude=2, f=1.5, phase=0.3, startTime=0.5, continuous=True),
        "cosine": blocks.Cosine(amplitude=2, f=1.5, phase=0.3, startTime=0.5),
        "sinc": blocks.Sinc(amplitude=2, f=1.5, startTime=0.5),
        "exp_sine": blocks.ExpSine(f=1.5, damping=2, phase=0.3, startTime=0.5),
        "exponentials": blocks.Exponentials(riseTime=0.3, riseTimeConst=0.2, startTime=0.5),
        "pulse": blocks.Pulse(amplitude=2, width=25, period=0.4, offset=1, startTime=0.1),
        "pulses": blocks.Pulse(period=0.4, nperiod=2),
        "saw": blocks.SawTooth(amplitude=2, period=0.4, startTime=0.1),
        "trapezoid": blocks.Trapezoid(rising=0.1, width=0.2, falling=0.1, period=0.5),
        "box": blocks.Trapezoid(width=0.2, period=0.5),
        "sweep": blocks.LogFrequencySweep(wMin=1, wMax=100, startTime=0.5, duration=1),
        "table": blocks.TimeTable(
            table=[[0, 0], [1, 0], [1, 1], [2, 4], [3, 9]], timeScale=0.5, offset=1, startTime=0.25
        ),
        "combi": blocks.CombiTimeTable(
            table=[[0, 1, 5], [1, 3, 7], [2, 0, 9]], columns=[3, 2], extrapolation="HoldLastPoint"
        ),
        "steps": blocks.CombiTimeTable(
            table=[[0, 1], [1, 3], [2, 1]], smoothness="ConstantSegments", extrapolation="Periodic",
            timeScale=0.5,
        ),
        "smooth": blocks.CombiTimeTable(
            table=[[0, 0], [1, 1], [2, 4], [3, 9]], smoothness="ContinuousDerivative"
        ),
        "one_row": blocks.CombiTimeTable(table=[[0, 7]], offset=[1]),
        "sampled": blocks.SampledSignal(values=[0, 1, 4, 9], dt=0.5, interpolation="previous"),
        "timed": blocks.SampledSignal(values=[0, 1, 4], ts=[0, 0.5, 2.0]),
    }  # fmt: skip
    vectors = {"combi": 2, "steps": 1, "smooth": 1, "one_row": 1}
    outputs = [f"{n}.y" for n in parts if n not in vectors]
    outputs += [f"{n}.y[{i}]" for n, size in vectors.items() for i in range(1, size + 1)]
    t = np.linspace(0, 2, 401) + 1e-4  # off the jumps
    values = evaluated(Panel(**parts), outputs, np.stack([t, 0 * t, 0 * t], axis=1))
    return t, {n.removesuffix(".y"): v for n, v in values.items()}


def test_sources_follow_their_formulas(over_time):
    t, y = over_time
    s = t - 0.5
    on = s >= 0
    angle = 3 * np.pi * s + 0.3
    risen = 1 - np.exp(-0.3 / 0.2)
    expected = {
        "expression": 2 * np.sin(t),
        "constant": 3 + 0 * t,
        "clock": 1 + np.where(on, s, 0),
        "step": 1 + 2 * on,
        "ramp": 1 + 2 * np.clip(s / 0.5, 0, 1),
        "sudden": 2 * on,
        "sine": 1 + on * 2 * np.sin(angle),
        "held": np.where(on, 2 * np.sin(angle), 2 * np.sin(0.3)),
        "cosine": on * 2 * np.cos(angle),
        "sinc": on * 2 * np.sinc(3 * s),
        "exp_sine": on * np.exp(-2 * s) * np.sin(angle),
        "exponentials": on
        * np.where(s < 0.3, 1 - np.exp(-s / 0.2), risen * np.exp(-(s - 0.3) / 0.2)),
        "pulse": 1 + 2 * ((t > 0.1) & ((t - 0.1) % 0.4 < 0.1)),
        "pulses": (t < 0.8) & (t % 0.4 < 0.2),
        "saw": (t > 0.1) * 2 * ((t - 0.1) % 0.4) / 0.4,
        "trapezoid": np.interp(t % 0.5, [0, 0.1, 0.3, 0.4, 0.5], [0, 1, 1, 0, 0]),
        "box": t % 0.5 < 0.2,
        "sweep": 10 ** (2 * np.clip(s, 0, 1)),
    }
    for name, values in expected.items():
        assert np.allclose(y[name], values, atol=1e-12), name


def test_tables_interpolate_and_extrapolate(over_time):
    t, y = over_time
    s = (t - 0.25) / 0.5  # the table begins at startTime
    line = np.where(s < 1, 0, np.interp(s, [1, 2, 3], [1, 4, 9]))
    line = np.where(s > 3, 9 + 5 * (s - 3), line)
    assert np.allclose(y["table"], np.where(t < 0.25, 1, 1 + line), atol=1e-9)
    assert np.allclose(y["combi.y[1]"], 5 + 2 * np.minimum(t, 2))
    assert np.allclose(y["combi.y[2]"], np.interp(t, [0, 1, 2], [1, 3, 0]))
    assert np.allclose(y["steps.y[1]"], np.where(2 * t % 2 < 1, 1, 3))
    assert np.allclose(y["smooth.y[1]"], t**2)  # exact for a parabola
    assert np.allclose(y["one_row.y[1]"], 8)
    assert np.allclose(y["sampled"], np.array([0, 1, 4, 9, 9])[(t / 0.5).astype(int)])
    assert np.allclose(y["timed"], np.interp(t, [0, 0.5, 2], [0, 1, 4]))


@pytest.mark.slow
def test_motions_keep_their_limits_and_arrive_together():
    parts = {
        "ptp": blocks.KinematicPTP2(
            q_begin=[1, 0], q_end=[3, -1], qd_max=[0.8], qdd_max=[2, 1], startTime=0.5
        ),
        "short": blocks.KinematicPTP2(q_end=[0.1], startTime=0.5),
        "acceleration": blocks.KinematicPTP(
            deltaq=[2, -1], qd_max=[0.8], qdd_max=[2, 1], startTime=0.5
        ),
    }
    outputs = [f"ptp.{n}[{i}]" for n in ("q", "qd", "qdd") for i in (1, 2)]
    outputs += ["ptp.endTime", "short.q[1]", "short.qd[1]", "short.endTime"]
    outputs += ["acceleration.y[1]", "acceleration.y[2]"]
    t = np.linspace(0, 4, 4001)
    y = evaluated(Panel(**parts), outputs, np.stack([t, 0 * t, 0 * t], axis=1))
    for i, (begin, end) in enumerate([(1, 3), (0, -1)], start=1):
        q, qd, qdd = (y[f"ptp.{n}[{i}]"] for n in ("q", "qd", "qdd"))
        assert np.allclose((q[0], q[-1]), (begin, end))
        assert np.allclose(np.gradient(q, t)[1:-1], qd[1:-1], atol=2e-3)
        assert np.allclose(np.cumsum(qdd) * 1e-3, qd, atol=4e-3)
        assert np.allclose(q[t > y["ptp.endTime"]], end)
        assert np.allclose(y[f"acceleration.y[{i}]"], qdd)
    assert np.max(np.abs(y["ptp.qd[1]"])) == pytest.approx(0.8)
    assert np.max(np.abs(y["ptp.qdd[1]"])) == pytest.approx(2)
    assert y["ptp.endTime"][0] == pytest.approx(0.5 + 2 / 0.8 + 0.8 / 2)
    assert y["short.endTime"][0] == pytest.approx(0.5 + 2 * np.sqrt(0.1))
    assert np.max(y["short.qd[1]"]) == pytest.approx(np.sqrt(0.1), rel=1e-2)
    assert y["short.q[1]"][-1] == pytest.approx(0.1)


# -- functions ---------------------------------------------------------------------------------------

BINARY = {
    "Feedback": np.subtract,
    "Add": np.add,
    "Product": np.multiply,
    "Division": np.divide,
    "Atan2": np.arctan2,
    "Pythagoras": np.hypot,
    "Max": np.maximum,
    "Min": np.minimum,
}
UNARY = {
    "Abs": np.abs,
    "Sign": np.sign,
    "Sin": np.sin,
    "Cos": np.cos,
    "Tan": np.tan,
    "Asin": lambda u: np.arcsin(u / 10),
    "Acos": lambda u: np.arccos(u / 10),
    "Atan": np.arctan,
    "Sinh": np.sinh,
    "Cosh": np.cosh,
    "Tanh": np.tanh,
    "Exp": np.exp,
    "Power": np.exp,
}
POSITIVE = {"Sqrt": np.sqrt, "Log": np.log, "Log10": np.log10}


def test_functions_of_signals():
    class Board(Panel):
        def __init__(self):
            small = {"Asin", "Acos"}
            unary = {n: getattr(blocks, n)() for n in UNARY if n not in small}
            super().__init__(
                **{n: getattr(blocks, n)() for n in BINARY},
                **unary,
                Gain=blocks.Gain(k=-2),
                Limiter=blocks.Limiter(uMax=1),
                DeadZone=blocks.DeadZone(uMax=1, uMin=-0.5),
                Wrap=blocks.WrapAngle(),
                WrapPositive=blocks.WrapAngle(positiveRange=True),
                Polar=blocks.RectangularToPolar(),
                Rectangular=blocks.PolarToRectangular(),
                Polynomial=blocks.Polynomial(c=[2, 0, 1]),
                Leg=blocks.Pythagoras(u1IsHypotenuse=True),
                Dependency=blocks.LinearDependency(y0=1, k1=2, k2=3),
            )
            self.minus_two = blocks.Gain(k=-2)
            self.tenth, self.positive = blocks.Gain(k=0.1), blocks.Abs()
            for n in small:
                setattr(self, n, getattr(blocks, n)())
                self.connect(self.tenth.y, getattr(self, n).u)
            for n in POSITIVE:
                setattr(self, n, getattr(blocks, n)())
                self.connect(self.positive.y, getattr(self, n).u)
            self.matrix = blocks.MatrixGain(K=[[1, 2], [3, 4], [5, 6]])
            self.sum = blocks.Sum(nin=2, k=[1, -2])
            self.multi_sum = blocks.MultiSum(nu=2)
            self.product = blocks.MultiProduct(nu=2)
            self.extremes = blocks.MinMax(nu=2)
            self.add3 = blocks.Add3(k3=2)
            self.variable = blocks.VariableLimiter()
            for part in (self.matrix, self.sum, self.multi_sum, self.product, self.extremes):
                self.connect(self.u1, part.u[0])
                self.connect(self.u2, part.u[1])
            signals = (
                self.tenth.u,
                self.positive.u,
                self.variable.u,
                self.add3.u1,
                self.minus_two.u,
            )
            self.connect(self.u1, *signals)
            self.connect(self.u2, self.add3.u2, self.add3.u3, self.variable.limit1)
            self.connect(self.minus_two.y, self.variable.limit2)

    points = np.random.default_rng(0).uniform(-4, 4, (50, 3))
    u, v = points[:, 1], points[:, 2]
    expected = {f"{n}.y": f(u, v) for n, f in BINARY.items()}
    expected |= {f"{n}.y": f(u) for n, f in UNARY.items()}
    expected |= {f"{n}.y": f(np.abs(u)) for n, f in POSITIVE.items()}
    expected |= {
        "Gain.y": -2 * u,
        "Limiter.y": np.clip(u, -1, 1),
        "DeadZone.y": np.where(u > 1, u - 1, np.where(u < -0.5, u + 0.5, 0)),
        "Wrap.y": np.angle(np.exp(1j * u)),
        "WrapPositive.y": u % (2 * np.pi),
        "Polar.y_abs": np.hypot(u, v),
        "Polar.y_arg": np.arctan2(v, u),
        "Rectangular.y_re": u * np.cos(v),
        "Rectangular.y_im": u * np.sin(v),
        "Polynomial.y": 2 * u**2 + 1,
        "Leg.y": np.sqrt(np.maximum(u**2 - v**2, 0)),
        "Dependency.y": 1 + 2 * u + 3 * v,
        "matrix.y[3]": 5 * u + 6 * v,
        "sum.y": u - 2 * v,
        "multi_sum.y": u + v,
        "product.y": u * v,
        "extremes.yMax": np.maximum(u, v),
        "extremes.yMin": np.minimum(u, v),
        "add3.y": u + 3 * v,
        "variable.y": np.maximum(np.minimum(u, v), -2 * u),
    }
    y = evaluated(Board(), list(expected), points)
    for name, values in expected.items():
        assert np.allclose(y[name], values), name


# -- responses ---------------------------------------------------------------------------------------


class Responses(ac.Component):
    """Continuous blocks with a unit step, or a ramp where told, at their inputs."""

    def __init__(self):
        super().__init__()
        self.one, self.ramp = blocks.Constant(k=1), blocks.ContinuousClock()
        steps = {
            "integrator": blocks.Integrator(k=2, y_start=1),
            "limited": blocks.LimIntegrator(outMax=0.5),
            "lag": blocks.FirstOrder(k=3, T=0.5, initType="InitialOutput", y_start=1),
            "steady": blocks.FirstOrder(k=3, T=0.5, initType="SteadyState"),
            "second": blocks.SecondOrder(k=2, w=4, D=0.3, initType="InitialState"),
            "pi": blocks.PI(k=2, T=0.5, initType="InitialState"),
            "pid": blocks.PID(k=2, Ti=0.5, Td=0.2, Nd=4),
            "transfer": blocks.TransferFunction(b=[1, 2], a=[2, 3, 4]),
            "direct": blocks.TransferFunction(b=[2], a=[4]),
            "space": blocks.StateSpace(
                A=[[-1.5, -2], [1, 0]], B=[[0.5], [0]], C=[[1, 2]], x_start=[0.1, 0.2],
                initType="InitialState",
            ),
            "filter": blocks.Filter(f_cut=1, order=3, analogFilter="Bessel", filterType="HighPass"),
            "output": blocks.Derivative(k=2, T=0.5, initType="InitialOutput", y_start=1),
        }  # fmt: skip
        ramps = {"derivative": blocks.Derivative(k=2, T=0.5), "der": blocks.Der()}
        for source, parts in ((self.one, steps), (self.ramp, ramps)):
            for name, part in parts.items():
                setattr(self, name, part)
                signal_in = part.u[0] if isinstance(part.u, np.ndarray) else part.u
                self.connect(source.y, signal_in)
        self.wave = blocks.SineVariableFrequencyAndAmplitude(useConstantAmplitude=True)
        self.connect(self.ramp.y, self.wave.f)


@pytest.fixture(scope="module")
def responses():
    return ac.simulate(ac.compile(Responses()), t=(0, 2), rtol=1e-9, atol=1e-11)


@pytest.mark.slow
def test_step_and_ramp_responses(responses):
    t = np.asarray(responses.t)
    step = lambda b, a: signal.step(signal.TransferFunction(b, a), T=t)[1]  # noqa: E731
    space = signal.lsim(
        signal.StateSpace([[-1.5, -2], [1, 0]], [[0.5], [0]], [[1, 2]], [[0]]),
        np.ones_like(t), t, [0.1, 0.2],
    )[1]  # fmt: skip
    expected = {
        "integrator.y": 1 + 2 * t,
        "limited.y": np.minimum(t, 0.5),
        "lag.y": 3 - 2 * np.exp(-t / 0.5),
        "steady.y": 3 + 0 * t,
        "second.y": step([2 * 16], [1, 2 * 0.3 * 4, 16]),
        "pi.y": 2 * (1 + t / 0.5),
        "pid.y": 2 * (1 + t / 0.5 + 4 * np.exp(-t / 0.05)),
        "transfer.y": step([1, 2], [2, 3, 4]),
        "direct.y": 0.5 + 0 * t,
        "space.y[1]": space,
        "filter.y": 0 * t,
        "output.y": np.exp(-t / 0.5),
        "derivative.y": 2 * (1 - np.exp(-t / 0.5)),
        "der.y": 1 + 0 * t,
        "wave.y": np.sin(np.pi * t**2),
    }
    for name, values in expected.items():
        tolerance = 5e-3 if name == "limited.y" else 2e-6
        assert np.allclose(responses[name], values, atol=tolerance), name


FILTERS = {
    "butterworth": (blocks.LowpassButterworth(n=5, f=2), signal.butter(5, 4 * np.pi, analog=True)),
    "even": (blocks.LowpassButterworth(n=4, f=2), signal.butter(4, 4 * np.pi, analog=True)),
    "high": (
        blocks.Filter(analogFilter="Butterworth", filterType="HighPass", order=3, f_cut=2),
        signal.butter(3, 4 * np.pi, "highpass", analog=True),
    ),
    "band": (
        blocks.Filter(
            analogFilter="Butterworth", filterType="BandPass", order=3, f_min=1, f_cut=2, gain=2
        ),
        [2 * c for c in signal.butter(3, [2 * np.pi, 4 * np.pi], "bandpass", analog=True)[:1]]
        + list(signal.butter(3, [2 * np.pi, 4 * np.pi], "bandpass", analog=True)[1:]),
    ),
    "stop": (
        blocks.Filter(analogFilter="Butterworth", filterType="BandStop", order=3, f_min=1, f_cut=2),
        signal.butter(3, [2 * np.pi, 4 * np.pi], "bandstop", analog=True),
    ),
    "chebyshev": (
        blocks.Filter(
            analogFilter="ChebyshevI", order=4, f_cut=2, A_ripple=1, normalized=False
        ),
        [c * 10 ** (k / 20) for c, k in zip(signal.cheby1(4, 1, 4 * np.pi, analog=True), (1, 0), strict=True)],
    ),
    "bessel": (
        blocks.Filter(analogFilter="Bessel", order=5, f_cut=2, normalized=False),
        signal.bessel(5, 4 * np.pi, analog=True, norm="delay"),
    ),
    "critical": (
        blocks.CriticalDamping(n=3, f=2, normalized=False),
        ([(4 * np.pi) ** 3], np.poly([-4 * np.pi] * 3)),
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def frequency_responses():
    """Every filter's response to its input at some frequencies, from the linear model."""
    parts = {name: part for name, (part, _) in FILTERS.items()}
    for kind in ("CriticalDamping", "Bessel", "ChebyshevI"):
        for order in (1, 2, 5):
            parts[f"{kind}{order}"] = blocks.Filter(analogFilter=kind, order=order, f_cut=2)
    parts["critical2"] = blocks.CriticalDamping(f=2)
    system = ac.compile(Panel(**parts))
    params = system.parameters()
    outputs = [f"{name}.y" for name in parts]
    x, u = jnp.zeros(len(system.states)), jnp.zeros(len(system.inputs))
    A, B = jax.jacfwd(lambda x, u: system.vector_field(0.0, x, u, params), (0, 1))(x, u)
    C, D = jax.jacfwd(lambda x, u: system.observe(outputs, 0.0, x, u, params), (0, 1))(x, u)
    f = np.array([0.01, 0.5, 1.0, 1.4, 2.0, 3.0, 10.0])
    response = [(C @ np.linalg.solve(2j * np.pi * w * np.eye(len(x)) - A, B) + D)[:, 0] for w in f]
    return f, dict(zip(parts, np.asarray(response).T, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("name", FILTERS)
def test_filters_have_the_textbook_response(frequency_responses, name):
    f, responses = frequency_responses
    _, expected = signal.freqs(*FILTERS[name][1], 2 * np.pi * f)
    assert np.allclose(responses[name], expected, atol=1e-6)


@pytest.mark.slow
def test_normalized_filters_let_3_db_pass_less_at_the_cut_off(frequency_responses):
    _, responses = frequency_responses
    for kind in ("CriticalDamping", "Bessel", "ChebyshevI"):
        for order in (1, 2, 5):
            response = np.abs(responses[f"{kind}{order}"])
            assert response[0] == pytest.approx(1, abs=1e-3)
            assert response[4] == pytest.approx(10 ** (-3 / 20), abs=1e-4)
    assert np.abs(responses["critical2"][4]) == pytest.approx(0.5**0.5)


# -- controllers -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def controllers():
    shared = {"k": 2.0, "Ti": 0.5, "Td": 0.1, "yMax": 3.0, "wp": 0.5, "wd": 0.2}
    parts = {
        kind: blocks.LimPID(controllerType=kind, **shared) for kind in ("P", "PI", "PD", "PID")
    }
    model: Any = Panel(**parts)
    model.forward = blocks.LimPID(controllerType="P", withFeedForward=True, kFF=0.5, yMax=100)
    model.connect(model.u1, model.forward.u_s, model.forward.u_ff)
    model.connect(model.u2, model.forward.u_m)
    system = ac.compile(model)
    params = system.parameters()

    def observe(names, u_s, u_m, **states):
        x = [states.get(n.replace(".", "_"), 0.0) for n in system.states]
        values = system.observe(names, 0.0, jnp.asarray(x), jnp.asarray([u_s, u_m]), params)
        return np.asarray(values).tolist()

    return observe


def test_limited_controllers_add_their_parts(controllers):
    names = ["P.y", "PI.y", "PD.y", "PID.y", "PID.controlError"]
    u_s, u_m, integral, lagging = 1.0, 0.4, 0.3, 0.1
    d = 0.1 / 0.01 * (0.2 * u_s - u_m - lagging)
    p = 0.5 * u_s - u_m
    values = controllers(
        names, u_s, u_m, PI_I_y=integral, PID_I_y=integral, PD_D_x=lagging, PID_D_x=lagging
    )
    clip = lambda y: min(max(y, -3), 3)  # noqa: E731
    assert values == pytest.approx(
        [
            clip(2 * p),
            clip(2 * (p + integral)),
            clip(2 * (p + d)),
            clip(2 * (p + integral + d)),
            0.6,
        ]
    )


def test_a_limited_controller_winds_up_no_further(controllers):
    y, before, rate = controllers(["PI.y", "PI.addFF.y", "PI.addI.y"], 10.0, 0.0)
    assert (y, before) == (3.0, 10.0)
    assert rate == pytest.approx(10 + (3 - 10) / (2 * 0.9))


def test_feed_forward_is_added_before_the_limit(controllers):
    assert controllers(["forward.y"], 2.0, 0.5) == pytest.approx([1.5 + 0.5 * 2])


def test_parts_of_a_controller_can_be_modified():
    controller = blocks.LimPID(controllerType="PI", yMax=1, limiter={"u": ac.Start(0.5)})
    assert controller.limiter._node.modifiers["u"] == ac.Start(0.5)
    assert not hasattr(controller, "D")


class Starts(ac.Component):
    """A state space that starts by its output, a transfer function at rest, a check, a power."""

    def __init__(self) -> None:
        super().__init__()
        self.k, self.clock = blocks.Constant(k=2.0), blocks.ContinuousClock()
        self.space = blocks.StateSpace(
            A=A, B=B, C=C, D=[[0.3]], initType="InitialOutput", y_start=[3.0]
        )
        self.transfer = blocks.TransferFunction(
            b=[1.0, 2.0], a=[2.0, 3.0, 4.0], initType="SteadyState"
        )
        self.early = blocks.LessThreshold(threshold=0.5)
        self.check, self.cube = blocks.AssertCondition(), blocks.Exponentiation(exponent=3)
        self.connect(self.k.y, self.space.u[0], self.transfer.u)
        self.connect(self.clock.y, self.early.u, self.cube.u)
        self.connect(self.early.y, self.check.u)


A, B, C = [[1.0, 2.0], [-3.0, -1.0]], [[1.0], [0.5]], [[1.0, -2.0]]


@pytest.mark.slow
def test_starts_by_outputs_checks_and_powers() -> None:
    found = ac.simulate(ac.compile(Starts()), (0, 1), saveat=[0.0, 0.4, 1.0])
    a, b, c = map(np.asarray, (A, B, C))
    kkt = np.block([[a.T @ a, c.T], [c, np.zeros((1, 1))]])
    x = np.linalg.solve(kkt, np.append(-a.T @ b @ [2.0], 3 - 0.3 * 2))
    assert [found[f"space.x[{i}]"][0] for i in (1, 2)] == pytest.approx(list(x[:2]))
    assert found["transfer.x[2]"][-1] == pytest.approx(0.5)
    assert found["transfer.x_scaled[2]"][-1] == pytest.approx(2.0)
    assert list(found["check.failed"]) == [0, 0, 1]
    assert found["cube.y"][1] == pytest.approx(0.4**3)
