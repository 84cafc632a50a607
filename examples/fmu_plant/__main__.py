"""``python -m examples.fmu_plant``: train a parameter of an FMU, and a friction beside it; the FMU is native code."""

from __future__ import annotations

import argparse
from pathlib import Path

from examples.fmu_plant import study


def main() -> None:
    about = "A mass, a spring and a damper in an FMU, with a friction beside it that is learned."
    parser = argparse.ArgumentParser(prog="python -m examples.fmu_plant", description=about)
    parser.add_argument("--fmu", type=Path, help="Mass_Damper.fmu, if gemseo-fmu is not installed")
    path = parser.parse_args().fmu or study.found()
    if path is None:
        print(
            f"skipped: there is no package '{study.PACKAGE}', whose FMU this is about; {study.REMEDY}"
        )
        return
    outcome = study.run(path)
    print(
        f"spring      {outcome.spring:8.0f} N/m, true {study.SPRING:.0f}, in the FMU {study.DECLARED:.0f}"
    )
    print(
        f"error of y  {1e3 * outcome.rms:8.2f} mm, noise {1e3 * study.NOISE:.2f}, before {1e3 * outcome.rms_before:.2f}"
    )
    for v, learned in zip(study.SPEEDS, outcome.friction, strict=True):
        print(f"friction    {learned:8.0f} N at {v:.0f} m/s, true {study.friction(v):.0f}")
    print(f"trained in  {outcome.seconds:8.1f} s")


if __name__ == "__main__":
    main()
