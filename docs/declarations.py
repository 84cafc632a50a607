"""Reference pages: the names that a package re-exports, and the declarations of a component as one table.

Two extensions of griffe, which reads the sources for mkdocstrings (mkdocs.yml names this file).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import griffe

import acausal.components

KINDS = ("Parameter", "Option", "Module", "Input", "Output", "Potential", "Flow", "Variable")
"""What a declaration may be, in the order of the table; connectors come before inputs."""
Row = tuple[str, str, str, str]


class Exports(griffe.Extension):
    """Shows what a package re-exports, ``from .room import Name as Name`` in `__init__.py` or `__init__.pyi`."""

    def on_package(self, *, pkg: griffe.Module, **kwargs: Any) -> None:
        """Called when griffe has read a package."""
        for package in _packages(pkg):
            assert isinstance(package.filepath, Path)
            stub = package.filepath.with_suffix(".pyi")
            source = stub if stub.exists() else package.filepath
            found = exported(source.read_text(encoding="utf-8"), package.path)
            if found:
                package.exports = [*found]
            for name, target in found.items():
                if _is_module_of_that_name(pkg, target, name):
                    _redirect(package, name, f"{target}.{name}")


def exported(source: str, package: str) -> dict[str, str]:
    """The names that a package's file imports as themselves, and where from."""
    found: dict[str, str] = {}
    for node in ast.parse(source).body:
        if isinstance(node, ast.ImportFrom):
            base = f"{package}.{node.module or ''}".rstrip(".") if node.level else node.module
            found |= {n.name: f"{base}.{n.name}" for n in node.names if n.name == n.asname}
    return found


def _is_module_of_that_name(pkg: griffe.Module, path: str, name: str) -> bool:
    """Whether a path leads to a module that defines something of its own name, such as `fit.fit`."""
    if not path.startswith(f"{pkg.path}."):
        return False
    found = pkg
    for part in path.removeprefix(f"{pkg.path}.").split("."):
        if part not in found.members or not isinstance(found.members[part], griffe.Module):
            return False
        found = found.members[part]
    return name in found.members and not found.members[name].is_alias


def _redirect(package: griffe.Module, name: str, target: str) -> None:
    """Griffe finds the module where a package imports the function of the same name."""
    line = package.members[name].lineno if package.members[name].is_alias else None
    package.members[name] = griffe.Alias(name, target, lineno=line, parent=package)


def _packages(module: griffe.Module) -> Iterator[griffe.Module]:
    if module.is_init_module:
        yield module
    for member in module.members.values():
        if isinstance(member, griffe.Module):
            yield from _packages(member)


class Declarations(griffe.Extension):
    """Moves class attributes such as ``c = ac.Parameter(unit="N/m")``, inherited ones too, below the docstring."""

    def on_module_members(self, *, mod: griffe.Module, **kwargs: Any) -> None:
        """Called when griffe has read a module: the library's stubs say nothing that the sources do not."""
        if mod.path.startswith(acausal.components.__name__) and _is_stub(mod):
            mod.members.clear()
            mod.exports = None

    def on_package(self, *, pkg: griffe.Module, **kwargs: Any) -> None:
        """Called when griffe has read a package."""
        _list_exports(pkg)
        classes = list(_classes(pkg))
        own = {cls.path: _rows(cls) for cls in classes}
        for cls in classes:
            rows: dict[str, Row] = {}
            for base in (cls, *_bases(cls)):
                for name, row in own.get(base.path, {}).items():
                    rows.setdefault(name, row)
            if rows:
                _append(cls, _table(rows))
        for cls in classes:
            for name in own[cls.path]:
                del cls.members[name]


def _is_stub(module: griffe.Module) -> bool:
    return isinstance(module.filepath, Path) and module.filepath.suffix == ".pyi"


def _list_exports(pkg: griffe.Module) -> None:
    """Tell griffe what the library's packages export: not what ``*`` brings besides."""
    for package in acausal.components.PACKAGES if pkg.path == "acausal" else ():
        read = pkg[f"components.{package}"]
        exports = import_module(f"{acausal.components.__name__}.{package}").__all__
        read.exports = list(exports)
        for name, member in list(read.members.items()):
            if member.is_alias and name not in exports:
                del read.members[name]


def _classes(scope: griffe.Module | griffe.Class) -> Iterator[griffe.Class]:
    for member in list(scope.members.values()):
        if member.is_alias:
            continue
        if isinstance(member, griffe.Class):
            yield member
        if isinstance(member, griffe.Module | griffe.Class):
            yield from _classes(member)


def _bases(cls: griffe.Class) -> list[griffe.Class]:
    try:
        return cls.mro()
    except ValueError:
        return []


def _rows(cls: griffe.Class) -> dict[str, Row]:
    rows = {n: _row(member) for n, member in cls.members.items() if not n.startswith("__")}
    return {name: row for name, row in rows.items() if row is not None}


def _row(member: Any) -> Row | None:
    """Kind, unit, default and description of an attribute that declares something."""
    if member.is_alias or not member.is_attribute or member.value is None:
        return None
    try:
        call = ast.parse(str(member.value), mode="eval").body
    except SyntaxError:
        return None
    if not isinstance(call, ast.Call):
        return None
    kind = ast.unparse(call.func).rpartition(".")[2]
    is_connector = kind[:1].isupper() and not call.args
    if kind not in KINDS and not is_connector:
        return None
    given = {k.arg: k.value for k in call.keywords if k.arg}
    default = ast.unparse(call.args[0]) if call.args else _text(given.get("start"))
    unit, doc, when = (_text(given.get(k)) for k in ("unit", "doc", "when"))
    if when and not when.startswith("_"):
        doc = "; ".join(filter(None, (doc, f"only with `{when}`")))
    shown = default if len(default) < 24 else "…"
    return (
        kind.lower() if kind in KINDS else f"`{kind}`",
        _code(unit),
        _code(shown),
        doc.replace("|", "\\|"),
    )


def _text(node: ast.expr | None) -> str:
    if node is None:
        return ""
    return str(node.value) if isinstance(node, ast.Constant) else ast.unparse(node)


def _code(text: str) -> str:
    return f"`{text}`" if text else ""


def _table(rows: dict[str, Row]) -> str:
    order = {kind.lower(): i for i, kind in enumerate(KINDS)}
    ranked = sorted(rows.items(), key=lambda item: order.get(item[1][0], order["input"] - 0.5))
    lines = [f"| `{name}` | {' | '.join(row)} |" for name, row in ranked]
    return "\n".join(["| | | unit | default | |", "|---|---|---|---|---|", *lines])


def _append(cls: griffe.Class, table: str) -> None:
    old = cls.docstring
    text = f"{old.value}\n\n{table}" if old else table
    settings = {"parser": old.parser, "parser_options": old.parser_options} if old else {}
    cls.docstring = griffe.Docstring(text, parent=cls, **settings)
