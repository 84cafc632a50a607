"""The demo: derive the equations, measure a ride, learn the missing forces, show the result."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.reporting import Page, write_json
from examples.qvm import figures
from examples.qvm.experiments import DEMO, fit
from examples.qvm.judge import judge, loss
from examples.qvm.model import linear, with_networks
from examples.qvm.record import ride

PAPER_LOSS = 0.035
NOISE = 0.02
OUT = Path("out/qvm")


def run(started: float, seed: int = 0, out: Path = OUT) -> dict[str, Any]:
    """Run the demo; ``started`` is the time the process started. Returns the report's figures."""
    console = Console()
    system = ac.compile(with_networks())
    console.print("[bold]Equations derived from the connected components[/]")
    for equation in system.equations:
        console.print(f"  {_plain(equation)}", highlight=False, soft_wrap=True)

    with console.status("driving the true vehicle over a rough road"):
        data = ride(NOISE)
        base = ac.compile(linear())
        loss_linear = loss(base, base.parameters(), data.measured, data)
    reached = _Reached(started)
    trained = fit(DEMO, data, seed=seed, observers=[reached])
    verdict = judge(trained, data)
    report = {
        "loss": verdict.loss,
        "loss_linear": loss_linear,
        "loss_clean": verdict.loss_clean,
        "noise_floor": NOISE * 2**0.5,
        "spring_error_newton": verdict.spring_error,
        "damper_error_newton": verdict.damper_error,
        "training_seconds": trained.seconds,
        "seconds_to_paper_loss": reached.seconds,
        "epochs": trained.history.epochs,
        "seed": seed,
        "seconds": time.time() - started,
    }
    _table(console, report)
    _page(out, system, data, trained, report)
    report["seconds"] = time.time() - started
    write_json(out / "report.json", report)
    console.print(f"\n{out / 'index.html'} shows it all.")
    return report


class _Reached:
    """Notes when the loss over the whole record first reaches the paper's."""

    def __init__(self, started: float) -> None:
        self.started = started
        self.seconds: float | None = None

    def __call__(self, progress: Any) -> None:
        if self.seconds is None and progress.best <= PAPER_LOSS:
            self.seconds = time.time() - self.started


def _plain(equation: Any) -> str:
    text = f"{equation.lhs.args[0]}' = {equation.rhs}"
    for name, short in figures.MATHS.items():
        text = text.replace(name, short)
    return text


def _rows(report: dict[str, Any]) -> list[tuple[str, str, str]]:
    seconds = report["seconds_to_paper_loss"]
    return [
        ("loss of the linear model", f"{report['loss_linear']:.4f}", "0.44"),
        ("loss of the PeN-ODE", f"{report['loss']:.4f}", "0.035"),
        ("... the noise alone", f"{report['noise_floor']:.4f}", ""),
        ("... against outputs without noise", f"{report['loss_clean']:.4f}", ""),
        (
            "seconds to the paper's loss",
            "not reached" if seconds is None else f"{seconds:.0f}",
            "16 200",
        ),
        ("spring, RMS error within 2σ", f"{report['spring_error_newton']:.2f} N", ""),
        ("damper, RMS error within 2σ", f"{report['damper_error_newton']:.2f} N", ""),
    ]


def _table(console: Console, report: dict[str, Any]) -> None:
    table = Table("", "here", "paper")
    for row in _rows(report):
        table.add_row(*row)
    console.print(table)


def _page(out: Path, system: ac.System, data: Any, trained: ac.Fit, report: dict[str, Any]) -> None:
    out.mkdir(parents=True, exist_ok=True)
    page = Page(
        "A quarter vehicle learns its suspension",
        "Components connected in Python, differential equations derived from the graph, two small networks that learn "
        "what the linear suspension lacks. After Kamp, Ultsch and Brembeck (2023), doi 10.5220/0012160100003543.",
    )
    page.section("The model")
    drawing = ac.diagram(system)
    drawing.save(out / "model.svg")
    page.drawing(drawing.svg, "The connected components; tinted ones hold a network.")
    page.text(
        "From this graph the differential equations follow. z and v are positions and speeds of body (b), wheel (w) "
        "and road (r); u is the road's vertical speed."
    )
    page.equations(system.equations, figures.MATHS)
    page.section("The result")
    page.table(["", "here", "paper"], _rows(report))
    page.text(
        "The loss (21) is the root mean square of the errors of both accelerations, each relative to its standard "
        "deviation. The record has Gaussian noise of 2 % of every signal, so that a perfect model would be left with "
        f"{report['noise_floor']:.4f}. The paper's 0.035 took 4.5 hours on a notebook in its fastest form."
    )
    page.figure(
        figures.forces({"learned": trained}),
        "What the networks have learned (less their value at zero) and the truth. Dashed lines: 1σ of the inputs seen "
        "in training; solid lines: 2σ. In the shaded regions the networks extrapolate.",
        out / "forces.png",
    )
    page.figure(
        figures.trajectories(trained, data),
        "The body from 4 to 8 s of one simulation of all 42 s: the truth, the linear model, the trained model.",
        out / "trajectories.png",
    )
    page.figure(
        figures.losses(
            {"whole record": trained}, {"paper 0.035": PAPER_LOSS, "noise": report["noise_floor"]}
        ),
        "Losses in training: of random batches (thin) and of one simulation of the whole record (dots).",
        out / "losses.png",
    )
    page.section("What the data cannot tell")
    page.text(GAUGE)
    page.write(
        out / "index.html",
        f"Every figure on this page is in report.json beside it. Seed {report['seed']}.",
    )


GAUGE = (
    "Multiplying both masses, the tyre's stiffness and damping and the force of the suspension by one factor changes "
    "neither acceleration. With trained parameters the networks can supply that factor, since c_s z_s + d_s v_s and "
    "they act side by side. So the data fix the ratios of these parameters, not their common factor. What picks it is "
    "what is known beforehand. Here that is the start: modifiers at zero and networks that give almost no force. Where "
    "a mass was weighed, leave it out of the trained parameters, and all the others are determined."
)
