"""The old drawing on matplotlib axes still shows every part and every node, and says that it will go."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import pytest

import acausal as ac
from acausal.components import translational as tl
from examples.qvm.model import with_networks

OLD = pytest.warns(DeprecationWarning, match=r"use diagram\(model\)\.svg")


def test_every_part_is_a_box_and_every_node_a_dot() -> None:
    with OLD:
        ax = ac.diagram(with_networks(), plt.figure().add_subplot())
    labels = [text.get_text() for text in ax.texts]
    assert [label.split("\n")[0] for label in labels] == [
        "body", "suspension", "spring_nn", "damper_nn", "wheel", "tyre", "road",
    ]  # fmt: skip
    dots = [line for line in ax.lines if line.get_marker() == "o"]
    assert len(dots) == 4
    plt.close(ax.figure)


def test_positions_follow_the_chain() -> None:
    with OLD:
        ax = ac.diagram(with_networks(), ax=plt.figure().add_subplot())
    place = {text.get_text().split("\n")[0]: text.xy for text in ax.texts}
    along = [place[name][0] for name in ("body", "suspension", "wheel", "tyre", "road")]
    assert along == sorted(along)
    assert len({place[name][0] for name in ("suspension", "spring_nn", "damper_nn")}) == 1
    assert len({place[name][1] for name in ("suspension", "spring_nn", "damper_nn")}) == 3
    plt.close(ax.figure)


def test_an_empty_model_and_one_without_connections_can_be_drawn() -> None:
    alone = ac.Component()
    alone.mass = tl.Mass(m=1.0)
    for model, names in ((ac.Component(), []), (alone, ["mass"])):
        with OLD:
            ax = ac.diagram(model, ax=plt.figure().add_subplot())
        assert [text.get_text().split("\n")[0] for text in ax.texts] == names
        assert not ax.lines
        plt.close(ax.figure)


def test_axes_must_be_axes() -> None:
    with pytest.raises(ac.DataError, match="is not axes"):
        ac.diagram(ac.Component(), "axes")
    with pytest.raises(ac.ModelError, match="diagram needs a Component"):
        ac.diagram(3, plt.figure().add_subplot())
    plt.close("all")
