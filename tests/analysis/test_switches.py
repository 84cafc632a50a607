"""Parameters that act through switches, which have no gradient."""

import numpy as np
import pytest

import acausal as ac
from acausal.analysis import in_switches

pytestmark = pytest.mark.filterwarnings("ignore:The gradient by", "ignore:Values jump at")


class Switching(ac.Component):
    """A rate that depends on a limit, a gain and a step."""

    limit = ac.Parameter(1.0)
    gain = ac.Parameter(1.0)
    step = ac.Parameter(1.0)
    x = ac.Variable(fixed=True)

    def equations(self):
        steps = ac.sign(self.x - self.step)
        yield ac.Eq(ac.der(self.x), self.gain * ac.where(self.x > self.limit, 0.5, 1.0) + steps)


class Whole(ac.Component):
    """The limit is bound to a parameter of the whole."""

    height = ac.Parameter(1.0)
    beside = ac.Parameter(1.0)

    def __init__(self):
        super().__init__(height=0.5, beside=2.0)
        self.part = Switching(limit=2 * self.height, gain=self.beside, step=3.0)


def test_what_switches_depend_on():
    assert in_switches(ac.compile(Whole())) == {"part.limit", "part.step", "height"}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:The trained model is no better")
def test_a_switch_is_told_where_training_moves_nothing():
    data = ac.Data(np.linspace(0, 1, 11), {"x": np.linspace(0, 1, 11) ** 2})
    told = r"^Training did not move 'limit': a switch \(where, .*and has no gradient\. Smooth it"
    with pytest.warns(UserWarning, match=told):
        ac.fit(
            ac.compile(Switching(limit=0.5, gain=1.0)), data, "x", modifiers=["limit"], x0="model",
            strategy="whole_record", sequence_length=None, epochs=2, progress=False,
        )  # fmt: skip
