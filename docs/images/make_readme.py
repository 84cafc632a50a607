"""Draw docs/images/readme.png from a run of the example in README.md: python docs/images/make_readme.py."""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import jax
import matplotlib.pyplot as plt
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

import acausal as ac  # noqa: E402
from acausal.reporting import GUIDE, LEARNED, TRUTH  # noqa: E402
from tests.test_docs import blocks  # noqa: E402


def main() -> None:
    """Run the example, draw the motion and the force that was learned."""
    page: dict = {}
    exec(next(blocks(ROOT / "README.md")), page)
    t, true, system, fit = page["t"], page["true"], page["system"], page["fit"]

    def run(params: dict) -> ac.Solution:
        inputs = {"push.f": page["force"]}
        return ac.simulate(system, (0, 20), dt=0.01, inputs=inputs, params=params)

    figure, (left, right) = plt.subplots(
        1, 2, figsize=(10, 3.4), width_ratios=(3, 2), layout="constrained"
    )
    before, after = system.parameters(0), fit.params
    left.plot(t, true["mass.a"], color=TRUTH, lw=4, alpha=0.4, label="record")
    left.plot(t, run(before)["mass.a"], color=LEARNED[1], lw=1.2, ls="--", label="before training")
    left.plot(t, run(after)["mass.a"], color=LEARNED[0], lw=1.4, label="after training")
    left.set(
        xlim=(0, 8), ylim=(-16, 16), xlabel="time in s", ylabel="acceleration of the mass in m/s²"
    )
    left.set_title("one simulation from t = 0", fontsize=10)
    left.legend(framealpha=0.9, edgecolor="none", ncols=3, fontsize=9, loc="upper center")

    seen = fit.seen["damper.net"]
    low, high = (float(bound[0]) for bound in seen.interval(2.0))
    v = np.linspace(1.5 * low, 1.5 * high, 601)
    right.plot(v, 3 * np.tanh(v / 0.1) + 2 * v, color=TRUTH, lw=4, alpha=0.4, label="truth")
    right.plot(
        v,
        jax.vmap(before["damper.net"])(v),
        color=LEARNED[1],
        lw=1.2,
        ls="--",
        label="before training",
    )
    right.plot(
        v, jax.vmap(after["damper.net"])(v), color=LEARNED[0], lw=1.4, label="after training"
    )
    for side in (slice(None, 2), slice(2, None)):
        edges = np.asarray([v[0], low, high, v[-1]])[side]
        right.axvspan(*edges, color=GUIDE, alpha=0.12, lw=0)
    right.annotate(
        "shaded: beyond 2σ of the\nspeeds in the record",
        (0.97, 0.05),
        xycoords="axes fraction",
        ha="right",
        fontsize=8,
        color=GUIDE,
    )
    right.set(xlim=(v[0], v[-1]), xlabel="speed in m/s", ylabel="force in N")
    right.set_title("the force of the damper", fontsize=10)
    for ax in (left, right):
        ax.grid(alpha=0.25)
    figure.savefig(Path(__file__).with_name("readme.png"), dpi=130)


if __name__ == "__main__":
    main()
