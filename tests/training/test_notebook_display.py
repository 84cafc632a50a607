"""The progress of a training in a notebook: one output, written anew now and then."""

import pytest

from acausal.training.history import Divergence
from acausal.training.progress import NotebookDisplay, Progress, bar, in_notebook


def report(epoch: int, *divergences: Divergence, events: int | None = None) -> Progress:
    return Progress(epoch, 100, 0.5, 0.25, 3.0 * epoch, 0.1, divergences, events)


def test_there_is_no_notebook_in_a_test() -> None:
    assert not in_notebook()


def test_the_output_is_updated_now_and_then_and_at_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    display = pytest.importorskip("IPython.display")
    shown: list[str] = []

    class Handle:
        def update(self, html: object) -> None:
            shown.append(html.data)  # type: ignore[attr-defined]

    monkeypatch.setattr(display, "display", lambda *a, **k: Handle())
    now = [0.0]
    bar_of = NotebookDisplay(100, clock=lambda: now[0])
    for epoch in range(1, 101):
        now[0] += 0.05
        bar_of.update(report(epoch))
    assert 20 <= len(shown) <= 25
    bar_of.close()
    assert "epoch 100/100" in shown[-1]
    assert "5:00" in shown[-1]
    assert "left" in shown[0]
    assert "left" not in shown[-1]


def test_divergences_are_listed_below_and_the_rest_counted() -> None:
    texts = [str(Divergence(i, 0.1, 1, False)) for i in range(7)]
    text = bar(3, 10, "loss <1>", texts)
    assert text.count("diverged") == 5
    assert "and 2 more" in text
    assert "loss &lt;1&gt;" in text
