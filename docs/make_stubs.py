"""Write what type checkers and editors know of the component library: python docs/make_stubs.py.

Each package of `components/`, and each public module of one, gets a stub that is made from the declarations of its
public classes: what can be given where a component is made, and what can be read from it.
tests/components/test_stubs.py tells when it has to be run again.

A base that others extend takes any keyword, so that the parameters of your own element are no errors; every other class
takes what it declares, and mappings for its parts.
"""

from __future__ import annotations

import importlib
import inspect
import re
import shutil
import subprocess
import sys
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import acausal as ac
import acausal.components
from acausal.modeling import declarations_of, signature

ROOT = Path(__file__).resolve().parent.parent
LIBRARY = acausal.components.__name__
HEADER = '''"""{title}

Made by docs/make_stubs.py from the declarations of the classes; do not edit it.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, ClassVar, Literal, SupportsFloat, SupportsIndex

import acausal as ac
{imports}
'''
NUMBER, NUMBERS = "SupportsFloat | ac.Start", "SupportsFloat | Iterable[Any]"
START, PART, LAW = "ac.Start | Mapping[str, Any]", "Mapping[str, Any]", "Callable[..., Any]"
BASES = ("interfaces", "bases")
"""Modules whose classes are for others to extend."""


@cache
def modules() -> tuple[str, ...]:
    """Names of the library's packages that have public classes, and of their public modules that have some."""
    packages = sorted(p.parent.name for p in (ROOT / "components").glob("*/__init__.py"))
    found = [name for name in packages if hasattr(_module(name), "__all__")]
    inner = [f"{name}.{m}" for name in found for m in _inner(_module(name))]
    return (*found, *inner)


def _inner(package: ModuleType) -> list[str]:
    """The public modules of a package that declare components."""
    public = {name: getattr(package, name) for name in package.__all__}
    return [
        name
        for name, module in public.items()
        if inspect.ismodule(module)
        and any(_is_element(v) for n, v in vars(module).items() if n in module.__all__)
    ]


def path_of(module: str) -> Path:
    """Where a module's stub is."""
    file = ROOT / "components" / module.replace(".", "/")
    return file / "__init__.pyi" if file.is_dir() else file.with_suffix(".pyi")


def stub(module: str) -> str:
    """The text of a module's stub."""
    return Stub(_module(module)).text()


@dataclass
class Stub:
    """A stub that is being written.

    Attributes:
        module: the package or module that it describes.
        names: by public class, the name that it has there.
        modules: others whose classes it mentions.
    """

    module: ModuleType
    names: dict[type, str] = field(default_factory=dict)
    modules: set[str] = field(default_factory=set)

    def text(self) -> str:
        """All of it."""
        public: dict[str, Any] = {n: getattr(self.module, n) for n in self.module.__all__}
        classes: dict[str, type] = {n: v for n, v in public.items() if isinstance(v, type)}
        own = {n: c for n, c in classes.items() if self._is_own(c)}
        for name, cls in classes.items():
            if name == cls.__name__ or cls not in self.names:
                self.names[cls] = name
        chosen = sorted(set(own.values()), key=lambda c: (len(c.__mro__), self.names[c]))
        body = [text for cls in chosen for text in self._class(cls)]
        aliases = [f"{n} = {self.names[c]}" for n, c in own.items() if self.names[c] != n]
        imports = [f"from . import {n} as {n}" for n, v in public.items() if inspect.ismodule(v)]
        imports += [
            f"from {c.__module__} import {c.__name__} as {n}"
            for n, c in classes.items()
            if n not in own
        ]
        others = [_import(name) for name in sorted(self.modules)]
        functions = [_function(f) for f in public.values() if inspect.isfunction(f)]
        title = (self.module.__doc__ or "").strip().partition("\n")[0]
        listed = f"__all__ = {sorted(public)!r}"
        header = HEADER.format(title=title, imports="\n".join([*others, *sorted(imports)]))
        return formatted("\n".join([header, listed, *body, *aliases, *functions]))

    def _is_own(self, cls: type) -> bool:
        own, home = self.module.__name__, cls.__module__
        elsewhere = home != own and home.removeprefix(f"{LIBRARY}.") in modules()
        return _is_element(cls) and f"{home}.".startswith(f"{own}.") and not elsewhere

    def _class(self, cls: type) -> Iterator[str]:
        found = list(dict.fromkeys(self._bases(cls)))
        bases = [b for b in found if not any(b is not c and issubclass(c, b) for c in found)]
        yield f"\nclass {self.names[cls]}({', '.join(map(self._reference, bases))}):"
        known = {n: d for base in reversed(bases) for n, d in declarations_of(base).items()}
        lines = list(self._doc(cls))
        for element, declared in declarations_of(cls).items():
            name, _, first = element.partition("[")
            if first.strip("1,]"):  # of a connector's vector, all elements but the first
                continue
            if known.get(name) is not declared and not name.startswith("_"):
                lines += self._attribute(name, declared)
        if issubclass(cls, ac.Component):
            lines += self._parts(cls, declarations_of(cls))
            lines += self._init(cls)
        yield from (f"    {line}" for line in lines or ["..."])

    def _doc(self, cls: type) -> Iterator[str]:
        text = inspect.cleandoc(cls.__doc__ or "").partition("\n\n")[0]
        if text:
            yield from f'"""{text}"""'.replace("\\", "\\\\").splitlines()

    def _bases(self, cls: type) -> Iterator[type]:
        """The nearest bases that a stub can name."""
        for base in cls.__bases__:
            if base in self.names or base in (ac.Component, ac.Connector) or self._home(base):
                yield base
            elif issubclass(base, ac.Component | ac.Connector):
                yield from self._bases(base)

    def _home(self, cls: type) -> str | None:
        """The package or module that exports a class of the library, or None."""
        if not cls.__module__.startswith(f"{LIBRARY}.") or cls.__name__.startswith("_"):
            return None
        own = cls.__module__.split(".")[2]
        exporting = [m for m in modules() if getattr(_module(m), cls.__name__, None) is cls]
        return min(exporting, key=lambda m: (m.split(".")[0] != own, "." in m), default=None)

    def _reference(self, cls: type) -> str:
        """How this stub names a class; what is not public is a component."""
        if cls in self.names:
            return self.names[cls]
        home = self._home(cls)
        if home:
            self.modules.add(home)
            return f"{_alias(home)}.{cls.__name__}"
        if cls.__module__.startswith(LIBRARY):
            public = [b for b in cls.__mro__[1:] if b in self.names or self._home(b)]
            if public:
                return self._reference(public[0])
        return "ac.Connector" if issubclass(cls, ac.Connector) else "ac.Component"

    def _attribute(self, name: str, declared: Any) -> Iterator[str]:
        if isinstance(declared, ac.Connector):
            yield f"{name}: {self._reference(type(declared))}"
            return
        yield f"{name}: ClassVar[ac.{_kind(declared)}]"
        unit = f" [{declared.unit}]" if declared.unit not in ("", "1") else ""
        if declared.doc or unit:
            yield f'"""{declared.doc}{unit}"""'.replace("\\", "\\\\")

    def _parts(self, cls: type[ac.Component], declared: Any) -> Iterator[str]:
        """The parts that the component makes by default."""
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                made = cls()
        except Exception:  # bases, and what needs arguments
            return
        for name, value in vars(made).items():
            if name in declared or name.startswith("_"):
                continue
            if isinstance(value, ac.Component):
                yield f"{name}: {self._reference(type(value))}"
            elif isinstance(value, list) and value and isinstance(value[0], ac.Component):
                yield f"{name}: list[{self._reference(type(value[0]))}]"

    def _init(self, cls: type[ac.Component]) -> Iterator[str]:
        declared, given = declarations_of(cls), [*signature(cls).parameters.values()]
        if cls.__module__.rpartition(".")[2] in BASES or cls.__name__.startswith("Partial"):
            declared, given = {}, [*inspect.signature(cls.__init__).parameters.values()][1:]
        named = [p for p in given if p.kind is p.KEYWORD_ONLY]
        arguments = [self._argument(p, declared) for p in given]
        if named:
            arguments.insert(given.index(named[0]), "*")
        yield f"def __init__({', '.join(['self', *arguments])}) -> None: ..."

    def _argument(self, parameter: inspect.Parameter, declared: Any) -> str:
        """One argument of ``__init__``."""
        name = parameter.name
        if parameter.kind is parameter.VAR_KEYWORD:
            return f"**{name}: {PART if declared else 'Any'}"
        if name in declared:  # a value may also be given later, or from above
            return f"{name}: {_taken(declared[name])} = ..."
        optional = "" if parameter.default is parameter.empty else " = ..."
        return f"{name}: {_annotation(parameter.annotation)}{optional}"


def _kind(declared: Any) -> str:
    return next(c.__name__ for c in type(declared).__mro__ if getattr(ac, c.__name__, None) is c)


def _taken(declared: Any) -> str:
    """The type of what gives a declaration its value."""
    if isinstance(declared, ac.Parameter):
        return NUMBER if declared.shape is None else NUMBERS
    if isinstance(declared, ac.Option):
        return _option(declared)
    if isinstance(declared, ac.Module):
        return LAW
    return PART if isinstance(declared, ac.Connector) else START


def _option(declared: ac.Option) -> str:
    if declared.choices:
        return f"Literal[{', '.join(map(repr, declared.choices))}]"
    if isinstance(declared.default, bool):
        return "bool"
    return "SupportsIndex" if isinstance(declared.default, int) else "Any"


def _annotation(annotation: Any) -> str:
    if annotation is inspect.Parameter.empty:
        return "Any"
    text = annotation if isinstance(annotation, str) else inspect.formatannotation(annotation)
    text = re.sub(r"acausal\.modeling\.\w+\.", "ac.", text)
    return re.sub(r"(collections\.abc|typing)\.", "", text)


def _is_element(value: Any) -> bool:
    return isinstance(value, type) and issubclass(value, ac.Component | ac.Connector)


def _alias(module: str) -> str:
    return f"_{module.replace('.', '_')}"


def _import(module: str) -> str:
    package, _, name = f"{LIBRARY}.{module}".rpartition(".")
    return f"from {package} import {name} as {_alias(module)}"


def _function(function: Any) -> str:
    """A function with its arguments and result."""
    stated = inspect.signature(function)
    arguments = [
        f"{p.name}: {_annotation(p.annotation)}{'' if p.default is p.empty else ' = ...'}"
        for p in stated.parameters.values()
    ]
    result = _annotation(stated.return_annotation)
    return f"def {function.__name__}({', '.join(arguments)}) -> {result}: ..."


def _module(name: str) -> ModuleType:
    return importlib.import_module(f"{LIBRARY}.{name}")


def formatted(text: str) -> str:
    """The text in ruff's format, without imports that nothing uses."""
    ruff = shutil.which("ruff", path=str(Path(sys.executable).parent)) or "ruff"
    for command in (("check", "--fix", "--quiet", "--select=I,F401"), ("format", "--quiet")):
        done = subprocess.run(
            [ruff, *command, "--stdin-filename", "components/__init__.pyi", "-"],
            input=text, stdout=subprocess.PIPE, text=True, check=True, cwd=ROOT,
        )  # fmt: skip
        text = done.stdout
    return text


def main() -> None:
    """Write everything."""
    for module in modules():
        path_of(module).write_text(stub(module), encoding="utf-8")


if __name__ == "__main__":
    main()
