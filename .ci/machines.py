"""Trainings as other machines would do them: records with other last bits, other instructions, other optimizations.

    python .ci/machines.py                      all variations, and a table of margins
    python .ci/machines.py seed-1 AVX2          some of them
    python .ci/machines.py AVX2 -- -k tanks     arguments for pytest

Fails where a test does. Bars that are closer than a fifth to what is measured, and numbers of pages that are not
printed as they are shown, are listed. The table shows what moves most between variations, relative to its distance from
the bar. What a variation has measured is kept in out/machines/ for the commit that is
checked out: a run that was interrupted goes on with what is missing.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
QUICK = (
    "--xla_backend_optimization_level=0 --xla_llvm_disable_expensive_passes=true "
    "--xla_cpu_use_fusion_emitters=false"
)
SHORT = ("tests/training", "tests/test_docs.py", "tests/test_notebooks.py")
LONG = ("tests/examples",)
SEEDS = {f"seed-{seed}": (seed, "") for seed in range(1, 6)}
ISAS = {isa: (1, f"--xla_cpu_max_isa={isa}") for isa in ("AVX2", "SSE4_2")}
FINISHED = (0, 1, 5)  # all passed, some failed, none chosen
SWAPPED = "swapped"  # the programs that are optimized elsewhere are not, and the others are
VARIATIONS = {**SEEDS, **ISAS, SWAPPED: (1, "")}


def run(name: str, arguments: list[str], folder: Path) -> list[dict[str, list]]:
    """What both groups of files have measured in a variation."""
    seed, flags = VARIATIONS[name]
    found = []
    for files, quick in ((SHORT, name != SWAPPED), (LONG, name == SWAPPED)):
        target = folder / f"{name}-{len(found)}.json"
        if target.exists():
            print(f"== {name}: {' '.join(files)}, from {target.relative_to(ROOT)}", flush=True)
            found.append(json.loads(target.read_text(encoding="utf-8")))
            continue
        command = [
            *(sys.executable, "-m", "pytest", "-n", "auto", "--dist", "loadfile"),
            *("-m", "slow or not slow", "-p", "tests.support.machines"),
            *("-o", "enable_assertion_pass_hook=true", "--last-bits", str(seed)),
            *("--margins", str(target), *files, *arguments),
        ]
        environment = {
            **os.environ,
            "XLA_FLAGS": f"{QUICK if quick else ''} {flags}".strip(),
            # Assertions that say what they compare are compiled for themselves.
            "PYTHONPYCACHEPREFIX": str(folder / "compiled"),
            # Programs are the same for all records: the first variation with its flags compiles them for the next.
            "ACAUSAL_COMPILATION_CACHE": str(folder / "programs"),
        }
        print(f"== {name}: {' '.join(files)}", flush=True)
        code = subprocess.run(command, cwd=ROOT, env=environment, check=False).returncode
        if code not in FINISHED:
            target.unlink(missing_ok=True)
            raise SystemExit(code)
        found.append(json.loads(target.read_text(encoding="utf-8")))
    return found


def kept(arguments: list[str]) -> Path | None:
    """The folder of what this commit has measured; None for a changed tree and for a part of the tests."""
    command = ("git", "describe", "--always", "--dirty", "--exclude=*")
    commit = subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout.strip()
    changed = not commit or commit.endswith("-dirty")
    return None if changed or arguments else ROOT / "out" / "machines" / commit


def table(found: dict[str, list[dict[str, list]]]) -> list[str]:
    """By file of tests: how many bars it has, and the one that uses most of its margin.

    What counts is how far a measured value moves between variations, relative to its least distance from the bar.
    """
    distances: dict[tuple, list[float]] = defaultdict(list)
    for parts in found.values():
        seen: dict[tuple, int] = defaultdict(int)
        for test, place, text, measured, bar, _ in (row for p in parts for row in p["margins"]):
            again = seen[test, place, text] = seen[test, place, text] + 1
            distances[test, place, text, again].append(abs(measured - bar))
    by_file = defaultdict(list)
    for (test, place, text, _), apart in distances.items():
        moved, least = max(apart) - min(apart), min(apart)
        needed = moved / least if least > 0 else float(moved > 0)
        by_file[test.partition("::")[0]].append((needed, least, moved, text, place))
    rows = [
        "| file | bars | uses most of its margin | distance | moves by | share |",
        "|---|---|---|---|---|---|",
    ]
    for file, bars in sorted(by_file.items()):
        needed, least, moved, text, place = max(bars)
        said = f"`{text}`".replace("|", "\\|")
        line = place.partition(":")[2]
        rows.append(
            f"| {file.removeprefix('tests/')} | {len(bars)} | {said}{f' (line {line})' if line else ''} "
            f"| {least:.2g} | {moved:.2g} | {needed:.0%} |"
        )
    return rows


def main(words: list[str]) -> int:
    """Do the named variations, or all; 1 if a test has failed in one of them."""
    cut = words.index("--") if "--" in words else len(words)
    names, arguments = words[:cut] or list(VARIATIONS), words[cut + 1 :]
    if unknown := set(names) - {*VARIATIONS}:
        print(f"No variation {', '.join(unknown)}: there are {', '.join(VARIATIONS)}.")
        return 2
    with tempfile.TemporaryDirectory() as passing:
        folder = kept(arguments) or Path(passing)
        folder.mkdir(parents=True, exist_ok=True)
        found = {name: run(name, arguments, folder) for name in names}
    print("\n".join(table(found)))
    failed = [f"{n}: {test}" for n, parts in found.items() for p in parts for test in p["failed"]]
    digits = {
        f"{n}: {page} shows {shown}, prints {printed}"
        for n, parts in found.items()
        for p in parts
        for page, shown, printed in p["digits"]
    }
    print(*sorted(digits), *failed, sep="\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
