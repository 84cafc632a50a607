"""``python -m examples.following_arm``: learn a friction, lead the arm with it, and draw what came of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from examples.following_arm.model import ANGLE, MOTOR
from examples.following_arm.study import compared, course

COLORS = {"viscous": "#c2571a", "learned": "#1f5c99"}


def main(folder: Path = Path("out/following_arm")) -> None:
    """Print a table, and write a picture."""
    found = compared()
    print(f"{'friction':10s}{'rms error':>14s}{'largest':>14s}")
    for name, outcome in found.items():
        print(f"{name:10s}{1e3 * outcome.rms:9.2f} mrad{1e3 * outcome.largest:9.2f} mrad")
    figure = Figure(figsize=(6.4, 5.4), layout="constrained")
    angle, error, torque = figure.subplots(3, 1, sharex=True)
    t = np.asarray(found["learned"].record.time)
    wanted = np.array([course(float(s)) for s in t])
    angle.plot(t, wanted, color="#8a949e", linewidth=3, label="course")
    for name, color in COLORS.items():
        record = found[name].record
        angle.plot(t, record[ANGLE], color=color, linewidth=1, label=f"{name} friction")
        error.plot(t, 1e3 * (np.asarray(record[ANGLE]) - wanted), color=color)
        torque.step(t, record[MOTOR], color=color, where="post")
    angle.set_ylabel("angle [rad]")
    angle.legend(frameon=False, ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    error.set_ylabel("error [mrad]")
    torque.set_ylabel("torque [N.m]")
    torque.set_xlabel("time [s]")
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / "following-arm.png", dpi=110)
    print(f"wrote {folder / 'following-arm.png'}")


if __name__ == "__main__":
    main()
