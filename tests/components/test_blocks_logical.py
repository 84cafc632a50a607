"""Truth values, tables of arguments, routing, conversions; blocks that need the past of a signal are refused."""

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks
from acausal.flattening.flat_model import flatten

# Parameters and options with their defaults, as in MSL 4.1.0 (`...` marks those without a default,
# `float` a default that follows from other parameters).
DEFAULTS = {
    "GreaterThreshold": {"threshold": 0},
    "LessEqualThreshold": {"threshold": 0},
    "BooleanConstant": {"k": True},
    "BooleanStep": {"startTime": 0, "startValue": False},
    "BooleanPulse": {"width": 50, "period": ..., "startTime": 0},
    "BooleanTable": {
        "table": (0, 1), "startValue": False, "extrapolation": "HoldLastPoint", "shiftTime": 0,
    },
    "IntegerConstant": {"k": ...},
    "IntegerStep": {"height": 1, "offset": 0, "startTime": 0},
    "IntegerTable": {"table": ..., "extrapolation": "HoldLastPoint", "shiftTime": 0},
    "BooleanToReal": {"realTrue": 1, "realFalse": 0},
    "BooleanToInteger": {"integerTrue": 1, "integerFalse": 0},
    "RealToBoolean": {"threshold": 0.5},
    "IntegerToBoolean": {"threshold": 1},
    "CombiTable1Ds": {
        "tableOnFile": False, "columns": ..., "smoothness": "LinearSegments",
        "extrapolation": "LastTwoPoints", "verboseRead": True, "verboseExtrapolation": False,
    },
    "CombiTable2Ds": {
        "tableOnFile": False, "smoothness": "LinearSegments", "extrapolation": "LastTwoPoints",
    },
    "SlewRateLimiter": {
        "Rising": 1, "Falling": float, "Td": 0.001, "initType": "SteadyState", "y_start": 0,
        "strict": False,
    },
    "PadeDelay": {"delayTime": ..., "n": 1, "m": ..., "balance": False},
    "ContinuousMean": {"t_eps": 1e-7},
    "Replicator": {"nout": 1},
    "ExtractSignal": {"nin": 1, "nout": 1},
    "Extractor": {"nin": 1, "allowOutOfRange": False, "outOfRangeValue": 1e10},
    "Multiplex": {"n": 0},
    "Multiplex6": {"n1": 1, "n6": 1},
    "DeMultiplex3": {"n1": 1, "n2": 1, "n3": 1},
}  # fmt: skip

REFUSED = [
    n
    for n in blocks.__all__
    if isinstance(c := getattr(blocks, n), type)
    and issubclass(c, blocks.NeedsDiscreteStates)
    and c is not blocks.NeedsDiscreteStates
]


@pytest.mark.parametrize("name", DEFAULTS)
def test_names_and_defaults_are_those_of_the_standard_library(name):
    for key, default in DEFAULTS[name].items():
        declared = getattr(blocks, name)._declared[key].default
        if default is ...:
            assert declared is None, key
        elif default is float:
            assert callable(declared), key
        else:
            assert declared == default, key


@pytest.mark.parametrize("name", REFUSED)
def test_blocks_that_need_more_are_refused(name):
    with pytest.raises(
        ac.DeclarationError, match=f"{name} needs .*, which acausal does not have yet"
    ):
        getattr(blocks, name)()


class Panel(ac.Component):
    """Blocks side by side, fed with the signals ``a``, ``b``, ``c`` of the panel, to all inputs in order."""

    a = ac.Input()
    b = ac.Input()
    c = ac.Input()

    def __init__(self, **parts):
        super().__init__()
        for name, part in parts.items():
            setattr(self, name, part)
            inputs = [k for k, d in type(part)._declared.items() if isinstance(d, ac.Input)]
            inputs = sorted(inputs)
            flat = []
            for key in inputs:
                value = getattr(part, key)
                flat += value.flat if isinstance(value, np.ndarray) else [value]
            for i, signal in enumerate(flat):
                self.connect((self.a, self.b, self.c)[i % 3], signal)


class Values:
    """What the blocks of a panel give at points."""

    def __init__(self, **parts):
        self.system = ac.compile(Panel(**parts))
        self.params = self.system.parameters()
        assert not self.system.states
        self.outputs = [v for v in self.system.variables if ".y" in v]

    def __call__(self, a=0.0, b=0.0, c=0.0, t=0.0):
        given = {"a": a, "b": b, "c": c}
        u = jnp.asarray([given[n] for n in self.system.inputs])
        values = self.system.observe(self.outputs, t, jnp.zeros(0), u, self.params)
        return dict(zip(self.outputs, np.asarray(values).tolist(), strict=True))


def test_logic():
    names = ("And", "Or", "Xor", "Nor", "Nand")
    values = Values(
        **{n.lower() + "_": getattr(blocks, n)() for n in names},
        negation=blocks.Not(), switch=blocks.Switch(), logical=blocks.LogicalSwitch(),
    )  # fmt: skip
    for a in (0.0, 1.0):
        for b in (0.0, 1.0):
            p, q, y = bool(a), bool(b), values(a, b, 0.25)
            assert y["and_.y"] == (p and q)
            assert y["or_.y"] == (p or q)
            assert y["xor_.y"] == (p != q)
            assert y["nor_.y"] == (not (p or q))
            assert y["nand_.y"] == (not (p and q))
            assert y["negation.y"] == (not p)
            assert y["switch.y"] == y["logical.y"] == (a if q else 0.25)


def test_comparisons():
    names = ("Greater", "GreaterEqual", "Less", "LessEqual")
    values = Values(
        **{n: getattr(blocks, n)() for n in names},
        **{f"{n}Threshold": getattr(blocks, f"{n}Threshold")(threshold=0.5) for n in names},
    )
    for a in (0.25, 0.5, 0.75):
        y = values(a, 0.5)
        expected = {
            "Greater": a > 0.5,
            "GreaterEqual": a >= 0.5,
            "Less": a < 0.5,
            "LessEqual": a <= 0.5,
        }
        for name, truth in expected.items():
            assert y[f"{name}.y"] == y[f"{name}Threshold.y"] == truth, (name, a)


def test_conversions():
    values = Values(
        nearest=blocks.RealToInteger(), same=blocks.IntegerToReal(),
        real=blocks.BooleanToReal(realTrue=3, realFalse=-1), integer=blocks.BooleanToInteger(),
        truth=blocks.RealToBoolean(), above=blocks.IntegerToBoolean(),
    )  # fmt: skip
    for a, nearest in ((2.5, 3), (2.4, 2), (-2.5, -3), (-2.4, -2), (0.0, 0), (0.6, 1)):
        y = values(a)
        assert (y["nearest.y"], y["same.y"]) == (nearest, a)
        assert (y["real.y"], y["integer.y"]) == ((3, 1) if a > 0.5 else (-1, 0))
        assert (y["truth.y"], y["above.y"]) == (a >= 0.5, a >= 1)


@pytest.mark.parametrize(
    ("unit", "si", "other"),
    [
        ("degC", 293.15, 20.0), ("degF", 273.15, 32.0), ("degRk", 100.0, 180.0), ("deg", np.pi, 180.0),
        ("rpm", np.pi, 30.0), ("kmh", 10.0, 36.0), ("day", 86400.0, 1.0), ("hour", 7200.0, 2.0),
        ("minute", 90.0, 1.5), ("litre", 0.5, 500.0), ("kWh", 3.6e6, 1.0), ("bar", 2e5, 2.0),
        ("gps", 0.3, 300.0),
    ],
)  # fmt: skip
def test_unit_conversions(unit, si, other):
    to, back = getattr(blocks, f"To_{unit}"), getattr(blocks, f"From_{unit}")
    assert to.factor * (si + to.shift) == pytest.approx(other)
    assert back.factor * (other + back.shift) == pytest.approx(si)
    assert to._declared["y"].unit
    assert back._declared["y"].unit
    assert to._declared["u"].unit == back._declared["u"].unit == ""  # one signal may feed several


def test_truth_and_integers_over_time():
    values = Values(
        always=blocks.BooleanConstant(), number=blocks.IntegerConstant(k=3),
        step=blocks.BooleanStep(startTime=0.5, startValue=True), up=blocks.IntegerStep(startTime=0.5, height=2),
        pulse=blocks.BooleanPulse(width=25, period=0.4, startTime=0.1),
        table=blocks.BooleanTable(table=[0.3, 0.6], shiftTime=0.1),
        late=blocks.BooleanTable(table=[0.3], startValue=True, startTime=0.2),
        steps=blocks.IntegerTable(table=[[0, 1], [0.5, 4]], extrapolation="Periodic"),
        expression=blocks.BooleanExpression(y=ac.where(ac.time > 0.5, 1, 0)),
    )  # fmt: skip
    for t in (0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75):
        y = values(t=t)
        assert (y["always.y"], y["number.y"], y["expression.y"]) == (1, 3, t > 0.5)
        assert (y["step.y"], y["up.y"]) == ((0, 2) if t > 0.5 else (1, 0))
        assert y["pulse.y"] == (t > 0.1 and (t - 0.1) % 0.4 < 0.1)
        assert y["table.y"] == (0.4 < t < 0.7)
        assert y["late.y"] == (0.2 < t < 0.3)
        assert y["steps.y"] == 1


TABLE = [[0, 1, 10], [1, 3, 20], [3, 3, 40]]
GRID = [[0, 0, 1, 3], [0, 1, 2, 3], [2, 5, 6, 7]]


@pytest.mark.slow
def test_tables_of_one_argument():
    values = Values(
        one=blocks.CombiTable1Ds(table=TABLE), two=blocks.CombiTable1Dv(table=TABLE),
        held=blocks.CombiTable1Ds(table=TABLE, columns=[3], extrapolation="HoldLastPoint"),
        step=blocks.CombiTable1Ds(table=TABLE, columns=[2], smoothness="ConstantSegments"),
    )  # fmt: skip
    for a in (-1.0, 0.0, 0.5, 2.0, 4.0):
        y = values(a, 0.5)
        line = 1 + 2 * a if a < 1 else 3
        assert y["one.y[1]"] == y["two.y[1]"] == pytest.approx(line)
        assert y["one.y[2]"] == pytest.approx(10 + 10 * a)
        assert y["two.y[2]"] == pytest.approx(15)
        assert y["held.y[1]"] == pytest.approx(10 + 10 * min(max(a, 0), 3))
    assert values(0.5)["step.y[1]"] == 1


@pytest.mark.slow
def test_tables_of_two_arguments():
    values = Values(
        plane=blocks.CombiTable2Ds(table=GRID), pair=blocks.CombiTable2Dv(n=1, table=GRID),
        held=blocks.CombiTable2Ds(table=GRID, extrapolation="HoldLastPoint"),
        step=blocks.CombiTable2Ds(table=GRID, smoothness="ConstantSegments"),
        line=blocks.CombiTable2Ds(table=[[0, 0, 1], [5, 2, 4]]),
    )  # fmt: skip
    for a, b in ((0.5, 0.5), (1.0, 2.0), (-1.0, 0.5), (3.0, 5.0)):
        y = values(a, b)
        along = b if b < 1 else 1 + (b - 1) / 2
        assert y["plane.y"] == y["pair.y[1]"] == pytest.approx(1 + 2 * a + along)
        inside = (min(max(b, 0), 3), min(max(a, 0), 2))
        along = inside[0] if inside[0] < 1 else 1 + (inside[0] - 1) / 2
        assert y["held.y"] == pytest.approx(1 + 2 * inside[1] + along)
        assert y["line.y"] == pytest.approx(2 + 2 * b)
    assert values(0.5, 1.5)["step.y"] == 2
    assert values(2.0, 3.0)["step.y"] == 7


def test_a_table_is_differentiated_where_the_model_needs_it():
    class Drive(ac.Component):
        def __init__(self):
            super().__init__()
            self.clock, self.table = blocks.ContinuousClock(), blocks.CombiTable1Ds(table=TABLE)
            self.rate = blocks.Der()
            self.connect(self.clock.y, self.table.u)
            self.connect(self.table.y[0], self.rate.u)

    system = ac.compile(Drive())
    rate = system.observe("rate.y", 0.5, jnp.zeros(0), None, system.parameters())
    assert float(rate) == pytest.approx(2)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: blocks.CombiTable1Ds(), r"CombiTable1Ds needs table="),
        (
            lambda: blocks.CombiTable1Ds(table=TABLE, tableOnFile=True),
            "fileName='NoName': there is no such file",
        ),
        (lambda: ac.compile(blocks.CombiTable2Ds()).parameters(), r"needs table=\[\[0, u2"),
        (
            lambda: ac.compile(blocks.CombiTable2Ds(table=[[0, 1, 0], [0, 1, 1]])).parameters(),
            "must ascend",
        ),
        (lambda: flatten(blocks.ExtractSignal(nin=2, extract=[3])), "must name 1 of 2 inputs"),
        (
            lambda: flatten(blocks.PadeDelay(delayTime=1, n=2, m=3)),
            "m=3 must lie between 1 and n=2",
        ),
        (lambda: ac.compile(blocks.IntegerTable()).parameters(), r"needs table=\[\[t, y\]"),
    ],
)
def test_wrong_data_are_refused(make, message):
    with pytest.raises(ac.DeclarationError, match=message):
        make()


def test_routing():
    values = Values(
        copies=blocks.Replicator(nout=2), chosen=blocks.ExtractSignal(nin=3, nout=2, extract=[3, 1]),
        first=blocks.ExtractSignal(nin=2), vector=blocks.Multiplex(n=3), scalars=blocks.DeMultiplex(n=3),
        joined=blocks.Multiplex3(n2=2), split=blocks.DeMultiplex2(n1=2), through=blocks.RealPassThrough(),
    )  # fmt: skip
    y = values(1.0, 2.0, 3.0)
    found = {n: [v for k, v in y.items() if k.startswith(n + ".")] for n in
             ("copies", "chosen", "first", "vector", "scalars", "joined", "split", "through")}  # fmt: skip
    assert found["copies"] == [1, 1]
    assert found["chosen"] == [3, 1]
    assert found["first"] == [1]
    assert found["vector"] == found["scalars"] == found["split"] == [1, 2, 3]
    assert found["joined"] == [1, 2, 3, 1]
    assert found["through"] == [1]


def test_an_extractor_follows_its_index():
    class Choice(ac.Component):
        index = ac.Input()

        def __init__(self):
            super().__init__()
            self.one = blocks.Extractor(nin=3)
            self.two = blocks.Extractor(nin=3, allowOutOfRange=True, outOfRangeValue=-1)
            self.values = [blocks.Constant(k=10 * i) for i in (1, 2, 3)]
            for extractor in (self.one, self.two):
                self.connect(self.index, extractor.index)
                self.connect([v.y for v in self.values], extractor.u)

    system = ac.compile(Choice())
    params = system.parameters()
    for index, expected in (
        (0, (10, -1)),
        (1, (10, 10)),
        (2.2, (20, 20)),
        (3, (30, 30)),
        (4, (30, -1)),
    ):
        u = jnp.asarray([float(index)])
        y = system.observe(["one.y", "two.y"], 0.0, jnp.zeros(0), u, params)
        assert tuple(np.asarray(y).tolist()) == expected


class Dynamics(ac.Component):
    """Blocks with states, at a sine or a step."""

    def __init__(self):
        super().__init__()
        self.sine = blocks.Sine(f=0.5, startTime=0)
        self.step = blocks.Step(height=2, offset=1, startTime=0.5)
        self.slow = blocks.SlewRateLimiter(Rising=2, Falling=-1, Td=0.005)
        self.delay = blocks.PadeDelay(delayTime=0.2, n=4)
        self.lag = blocks.PadeDelay(delayTime=0.2, n=3, m=2)
        self.mean, self.variance = blocks.ContinuousMean(t_eps=1e-3), blocks.Variance(t_eps=1e-3)
        self.deviation = blocks.StandardDeviation(t_eps=1e-3)
        for part in (self.delay, self.lag, self.mean, self.variance, self.deviation):
            self.connect(self.sine.y, part.u)
        self.connect(self.step.y, self.slow.u)


@pytest.mark.slow
def test_blocks_with_states():
    solution = ac.simulate(ac.compile(Dynamics()), t=(0, 2), dt=2e-3)
    names = [f"{n}.y" for n in ("slow", "delay", "lag", "mean", "variance", "deviation")]
    y = solution.to_dict(names)
    t = y["time"]
    rising = np.clip(1 + 2 * (t - 0.5), 1, 3)
    assert np.allclose(y["slow.y"], rising, atol=0.011)
    assert np.max(y["slow.y"]) < 3 + 1e-6
    later = t > 1
    for name in ("delay.y", "lag.y"):
        assert np.allclose(y[name][later], np.sin(np.pi * (t - 0.2))[later], atol=2e-3)
    assert y["mean.y"][-1] == pytest.approx(0, abs=2e-3)
    assert y["variance.y"][0] == 0
    mean = np.where(t > 0, (1 - np.cos(np.pi * t)) / (np.pi * np.maximum(t, 1e-9)), 0)
    assert np.allclose(y["mean.y"][50:], mean[50:], atol=2e-3)
    assert np.allclose(y["deviation.y"] ** 2, y["variance.y"], atol=1e-9)
    assert np.all(np.diff(y["variance.y"][100:500]) != 0)
