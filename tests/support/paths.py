"""Where the repository is, and the folder beside it that holds records and reference trajectories."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared"
