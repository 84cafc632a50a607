"""Models as Modelica text."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from acausal._jax import need_double_precision, need_known
from acausal.errors import ModelError, need_flag, shown
from acausal.export.needs import all_parameters, need_exportable, need_unchanged
from acausal.files import file_to_write, write_files
from acausal.modeling import Component, InitialParameter, element_name
from acausal.system import System, compile


def modelica(
    model: System | Component,
    path: str | Path,
    params: Mapping[str, Any] | None = None,
    *,
    selfcontained: bool = False,
) -> Path:
    """Write a model as a Modelica package: parts, connections, parameters, and one block for each network.

    Parts of the library have their names of the Modelica Standard Library 4.1.0. All others, such as your own classes
    and neural elements, become classes of the package with the equations that they state. The package has the name of
    the file; its last class is the model. An element ``m[2]`` of a list of parts is called ``m_2``. Inputs that
    nothing feeds are inputs of the model: ``road.v_ref`` is ``road_v_ref``.

    Arguments:
        model: a model, or its compiled system.
        path: the file, usually ``….mo``.
        params: values and networks, such as ``fit.params``; by default those of the model.
        selfcontained: whether to write the parts of the library as classes, too, from acausal's equations, so that
            the file needs no library.

    Returns:
        The path.

    Raises:
        DataError: in one sentence, for parameters that do not fit, a network's operation that has no counterpart in
            Modelica, or what is no path of a file.
        ModelError: for an equation that Modelica cannot state, or a system whose model was modified after it was
            compiled. ExportError: for a model with an FMU in it.
    """
    need_double_precision()
    target = file_to_write(path, "export.modelica")
    from acausal.export.modelica_text import Package, class_name, package_of
    from acausal.export.modelica_text.standard import standard_connector, standard_part

    if not isinstance(model, System | Component):
        raise ModelError(f"export.modelica needs a model or a system, not {shown(model, 40)}")
    system = model if isinstance(model, System) else compile(model)
    need_exportable(system, "modelica")
    if system is model:
        need_unchanged(system, "modelica")
    need_known("export.modelica", params)
    is_alone = need_flag(selfcontained, "selfcontained")
    given = all_parameters(system, params)
    packed, layout = system.pack(given), system.layout
    networks = {
        layout.model.layout.module(i): packed.modules[int(m)]
        for i, m in enumerate(layout.module_of)
    }
    changed = _with_values(system, given)
    package = Package(
        networks,
        (lambda model, name: None) if is_alone else standard_part,
        (lambda kind, name: None) if is_alone else standard_connector,
    )
    title = class_name(target.stem)
    name = changed._node.title or type(changed).__name__
    text = package_of(changed, title, f"{name}, written by acausal", package, system.inputs)
    write_files({target: text})
    return target


def _with_values(system: System, given: Mapping[str, Any]) -> Component:
    """A copy of the model with the values of parameters that differ from its own."""
    from acausal.export.modelica_text.declared import parts_of

    own = system.parameters()
    differing = [n for n in system.layout.names if float(given[n]) != float(own[n])]
    if not differing:
        return system.model
    model = copy.deepcopy(system.model)
    vectors: dict[tuple[str, str], np.ndarray] = {}
    parts = {part._node.path: part for part in parts_of(model)}
    for name in differing:
        owner = name
        while owner and owner not in parts:
            owner = owner.rpartition(".")[0]
        local = name[len(owner) :].removeprefix(".")
        base, _, index = local.partition("[")
        part = parts[owner]
        if isinstance(part._node.declaration(base), InitialParameter):
            continue
        if not index:
            part.modify(**{base: float(given[name])})
            continue
        whole = vectors.get((owner, base))
        if whole is None:
            prefix = f"{owner}.{base}" if owner else base
            shape = part._node.shape(base, part._node.declaration(base))  # pyright: ignore[reportArgumentType]
            whole = vectors[owner, base] = np.empty(shape or (), dtype=object)
            for place in np.ndindex(*(shape or ())):
                whole[place] = float(given.get(element_name(prefix, place), 0.0))
        part.modify(**{base: whole})
    return model
