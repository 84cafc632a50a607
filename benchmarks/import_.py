"""Modelica text of n components: processor seconds to parse, load and compile it, beside the same chain in Python.

Three files: a declaration and two connections for each part, of the library's classes or of classes of the text, and
arrays of parts that a loop connects. ``--library`` parses all files of a folder, too.
"""

from __future__ import annotations

import argparse
import gc
import json
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

import acausal as ac
from acausal.modelica import parse, read_source
from benchmarks.chain import Chain, by_hand_values

PARTS = """
  import Modelica.Mechanics.Translational.Components.{Fixed, Mass, SpringDamper};
"""
OWN = """
  model Mass "A sliding mass"
    parameter Real m(unit="kg", min=0) = 1;
    Modelica.Mechanics.Translational.Interfaces.Flange_a flange_a;
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange_b;
    Real s(unit="m"), v(unit="m/s");
  equation
    flange_a.s = s;
    flange_b.s = s;
    v = der(s);
    m*der(v) = flange_a.f + flange_b.f;
  end Mass;
  model SpringDamper "A spring with a damper"
    extends Modelica.Mechanics.Translational.Interfaces.PartialCompliantWithRelativeStates;
    parameter Real c(unit="N/m") = 1, d(unit="N.s/m") = 1;
  equation
    f = c*s_rel + d*v_rel;
  end SpringDamper;
  model Fixed = Modelica.Mechanics.Translational.Components.Fixed;
"""


def rows(n: int, parts: str) -> Iterator[str]:
    """A package with a chain of n parts: a declaration for each."""
    k = n // 2
    value = {name: array.tolist() for name, array in by_hand_values(k).items()}
    yield f"package Text{parts}  model Chain\n    Fixed wall;"
    for i in range(k):
        yield f"    SpringDamper leg{i}(c = {value['c'][i]}, d = {value['d'][i]!r});"
        yield f"    Mass mass{i}(m = {value['m'][i]!r});"
    yield "  equation\n    connect(wall.flange, leg0.flange_a);"
    for i in range(k):
        yield f"    connect(leg{i}.flange_b, mass{i}.flange_a);"
    for i in range(1, k):
        yield f"    connect(mass{i - 1}.flange_b, leg{i}.flange_a);"
    yield "  end Chain;\nend Text;"


def arrays(n: int) -> Iterator[str]:
    """The same by arrays, a comprehension for each parameter, and a loop of connections."""
    yield f"""package Text{PARTS}
  model Chain
    parameter Integer n = {n // 2};
    Fixed wall;
    SpringDamper leg[n](c = {{100 + mod(i, 7) for i in 0:n-1}}, d = {{1 + 0.1*mod(i, 5) for i in 0:n-1}});
    Mass mass[n](m = {{1 + 0.1*mod(i, 3) for i in 0:n-1}});
  equation
    connect(wall.flange, leg[1].flange_a);
    connect(mass[1:n-1].flange_b, leg[2:n].flange_a);
    for i in 1:n loop
      connect(leg[i].flange_b, mass[i].flange_a);
    end for;
  end Chain;
end Text;"""


FILES: dict[str, Callable[[int], Iterator[str]]] = {
    "library": lambda n: rows(n, PARTS),
    "own": lambda n: rows(n, OWN),
    "arrays": arrays,
}
TITLES = {
    "library": "parts of the library",
    "own": "parts of the text",
    "arrays": "arrays of parts",
    "python": "Python",
}


def timed(function: Callable[..., Any], *args: Any) -> tuple[Any, float]:
    gc.collect()
    begin = time.process_time()
    found = function(*args)
    return found, time.process_time() - begin


def measured(n: int) -> dict[str, dict[str, float]]:
    """Seconds of each form of a chain of n parts, and of the chain of Python."""
    found: dict[str, dict[str, float]] = {}
    for name, text in FILES.items():
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "Text.mo")
            file.write_text("\n".join(text(n)))
            _, parsing = timed(parse, read_source(file))
            model, loading = timed(ac.load, file)
            system, compiling = timed(ac.compile, model)
            size = file.stat().st_size / 1e6
        found[name] = {
            "megabytes": size,
            "parse_seconds": parsing,
            "load_seconds": loading,
            "compile_seconds": compiling,
            "states": len(system.states),
        }
    model, declaring = timed(Chain, n // 2)
    system, compiling = timed(ac.compile, model)
    found["python"] = {
        "load_seconds": declaring,
        "compile_seconds": compiling,
        "states": len(system.states),
    }
    return found


def speed(folder: Path) -> dict[str, float]:
    """Files of a folder: how many, their megabytes, and megabytes parsed in a second."""
    sources = [read_source(file) for file in sorted(folder.rglob("*.mo"))]
    size = sum(len(s.text.encode()) for s in sources) / 1e6
    _, seconds = timed(lambda: [parse(s) for s in sources])
    return {"files": len(sources), "megabytes": size, "megabytes_per_second": size / seconds}


def main() -> None:
    """Measure, print a table, and a line of JSON at the end."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--n", type=int, default=10000, help="components")
    parser.add_argument("--rounds", type=int, default=3, help="of which the median is taken")
    parser.add_argument("--library", type=Path, help="a folder whose files are parsed")
    options = parser.parse_args()
    measured(10)  # imports, and what is cached once
    rounds = [measured(options.n) for _ in range(options.rounds)]
    found: dict[str, Any] = {
        form: {key: statistics.median(r[form][key] for r in rounds) for key in rounds[0][form]}
        for form in TITLES
    }
    table = Table(f"{options.n} components", "MB", "parse", "load", "compile")
    for form, title in TITLES.items():
        row = found[form]
        text = [f"{row[k]:.2f}" if k in row else "" for k in ("megabytes", "parse_seconds")]
        table.add_row(title, *text, f"{row['load_seconds']:.2f}", f"{row['compile_seconds']:.2f}")
    text = found["library"]
    found["megabytes_per_second"] = text["megabytes"] / text["parse_seconds"]
    if options.library is not None:
        found["folder"] = speed(options.library)
    Console().print(table)
    print(json.dumps(found))


if __name__ == "__main__":
    main()
