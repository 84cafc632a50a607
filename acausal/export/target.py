"""What is exported: a network, a right-hand side or an observer's step, as a function of named arrays."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import Array, export as jax_export
from jax.extend.core import ClosedJaxpr

from acausal._jax import need_known
from acausal.analysis import Observer, ObserverMemory
from acausal.errors import DataError, known_name, need_compiled, shown
from acausal.export.needs import all_parameters, need_exportable
from acausal.modeling import Component, ModuleCall, Reference, each, full_name, names_in
from acausal.networks import EnergyLaw, law_of
from acausal.system import System


@dataclass(frozen=True)
class TargetPort:
    """An argument or a result.

    Attributes:
        name: its own name. shape: its sizes.
        elements, units: names and units of its elements; empty for arrays of weights.
        default: the value of a parameter, which need not be given.
    """

    name: str
    shape: tuple[int, ...] = ()
    elements: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    default: np.ndarray | None = None

    @property
    def batched(self) -> bool:
        """Whether it has one value for every point of a batch."""
        return self.default is None


@dataclass(frozen=True)
class Target:
    """A function with named arguments and results.

    Attributes:
        title: what it is. call: from arrays, in the order of ``inputs``, to a tuple in the order of ``outputs``.
    """

    title: str
    call: Callable[..., tuple[Array, ...]]
    inputs: tuple[TargetPort, ...]
    outputs: tuple[TargetPort, ...]

    def batch(self) -> Callable[..., tuple[Array, ...]]:
        """The function of arrays with a leading dimension, except for parameters."""
        return jax.vmap(self.call, in_axes=tuple(0 if p.batched else None for p in self.inputs))


def target_of(
    model: System | Observer | Callable[..., Any],
    params: Mapping[str, Any] | None,
    network: str | None,
    inputs: Sequence[str] | None,
    outputs: Sequence[str],
    units: Mapping[str, str] | None,
    parameters: bool,
    function: str,
) -> Target:
    """A right-hand side, an observer's step, a network of a system, or a network; arguments as of ``export.onnx``.

    Raises:
        DataError: for an unknown name, or arguments that do not fit; it names the ``function`` that was called.
        ModelError: for a model that is not compiled.
    """
    need_known(f"export.{function}", model, params)
    units = {} if units is None else units
    if not isinstance(units, Mapping):
        raise DataError(
            f"export: units are texts by name, such as {{'s_rel': 'm'}}, not {shown(units)}"
        )
    if isinstance(model, Observer):
        if any(a is not None for a in (params, network, inputs)) or parameters:
            raise DataError(
                f"export.{function}: of an observer only outputs can be named; it has its own parameters."
            )
        return _of_observer(model, names_in(outputs, "export: outputs"))
    if isinstance(model, System):
        given = all_parameters(model, params)
        if network is None:
            need_exportable(model, function)
            if inputs is not None:
                raise DataError(
                    "export: inputs=... names the arguments of a network; give network=..., too"
                )
            return _of_system(model, given, outputs, parameters)
        law = given[known_name(network, model.layout.module_names, "export: there is no network")]
        found = _called_with(model, network)
        names, output, known = found or (_arguments(law), "y", {})
        return _network(
            law, names if inputs is None else inputs, outputs, output, {**known, **units}
        )
    if isinstance(model, Component | type) or not callable(model):
        need_compiled(model, f"export.{function}")
        raise DataError(f"export.{function}: {shown(model, 40)} is no system and no network")
    if network is not None or params is not None or parameters:
        raise DataError(
            "export: params, network and parameters are of a system; of a network only inputs and outputs can be named"
        )
    names = _arguments(model) if inputs is None else inputs
    return _network(model, names, outputs, "y", units)


def _network(
    law: Callable[..., Any],
    inputs: Sequence[str],
    outputs: Sequence[str],
    output: str,
    units: Mapping[str, str],
) -> Target:
    results = names_in(outputs, "export: outputs")
    if len(results) > 1:
        raise DataError(f"export: a network has one result, not {len(results)}; give one name")
    return _of_network(law, names_in(inputs, "export: inputs"), *(results or (output,)), units)


def _arguments(network: Callable[..., Any]) -> tuple[str, ...]:
    """``x``, or ``x1``, ``x2`` and so on: as many as the network takes."""
    count = _count(network)
    return ("x",) if count == 1 else tuple(f"x{i}" for i in range(1, count + 1))


def _count(network: Any) -> int:
    """How many arguments a network takes.

    Raises:
        DataError: where it does not say so.
    """
    inner = network
    while inner is not None:
        size = getattr(inner, "in_size", None)
        if isinstance(size, int):
            return size
        inner = getattr(inner, "net", None)
    try:
        own = inspect.signature(law_of(network)).parameters.values()
    except (TypeError, ValueError):
        own = ()
    if own and all(p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD) for p in own):
        return len(own)
    raise DataError(
        f"export: {shown(network, 40)} does not say how many arguments it takes; name them: inputs=('s_rel',)"
    )


def _of_system(
    system: System, params: Mapping[str, Any], outputs: Sequence[str], parameters: bool
) -> Target:
    """The right-hand side: ``t``, ``x``, ``u``, ``d`` and parameters to ``der(x)`` and ``y``.

    Arguments:
        params: all of them. outputs: names of the variables of ``y``.
        parameters: whether parameters are arguments, too.

    Raises:
        DataError: if there is nothing to compute. ModelError: for an unknown output.
    """
    outputs = names_in(outputs, "export: outputs")
    for name in outputs:
        system.unit(name)
    ports = [TargetPort("t", (), ("time",), ("s",))]
    ports += _vector("x", system.states, system) + _vector("u", system.inputs, system)
    start = system.program.discrete_start
    if len(start):
        names = tuple(system.reduced.name(int(i)) for i in system.reduced.discrete)
        ports.append(TargetPort("d", (len(start),), names, ("",) * len(names)))
    variables = len(ports)
    leaves, rebuild = _numbers(params) if parameters else ((), lambda _: params)
    ports += leaves

    def call(*arrays: Array) -> tuple[Array, ...]:
        given = dict(zip([p.name for p in ports[:variables]], arrays, strict=False))
        t, x = given["t"], given.get("x", jnp.zeros(0))
        values = system.values(t, x, given.get("u"), rebuild(arrays[variables:]))
        values = values._replace(d=given.get("d"))
        if not outputs:
            return (system.rates(values),)
        dx, y = system.rates_and_read(outputs, values)
        return (dx, y) if system.states else (y,)

    results = _vector("der(x)", tuple(f"der({n})" for n in system.states), system)
    results += _vector("y", outputs, system)
    if not results:
        raise DataError("export: the model has no states; name its outputs=[...].")
    return Target(type(system.model).__name__, _flat(call, results), tuple(ports), tuple(results))


def _of_observer(observer: Observer, outputs: tuple[str, ...]) -> Target:
    """The step: ``t``, ``u`` and ``y``, where NaN is not measured, and what it remembers, which is also its result.

    Raises:
        ModelError: for an unknown output.
    """
    step = observer.step_of_arrays
    system, names, start = step.model.system, step.names, step.start
    units = tuple(map(system.unit, names))
    ports = [TargetPort("t", (), ("time",), ("s",)), *_vector("u", system.inputs, system)]
    ports += _vector("y", step.model.sensors, system)
    pairs = tuple(f"{a}, {b}" for a in names for b in names)
    products = tuple(f"{a} {b}".strip() for a in units for b in units)
    remembered = [
        TargetPort("t_before", (), ("time",), ("s",), np.asarray(start.t)),
        *(replace(p, name="u_before", default=np.asarray(start.u)) for p in ports if p.name == "u"),
        TargetPort("mean", (len(names),), names, units, np.asarray(start.mean)),
        TargetPort("covariance", (len(names),) * 2, pairs, products, np.asarray(start.covariance)),
    ]

    def call(*arrays: Array) -> tuple[Array, ...]:
        given = dict(zip([p.name for p in (*ports, *remembered)], arrays, strict=True))
        nothing = jnp.zeros(0)
        before = ObserverMemory(
            given["t_before"], given.get("u_before", nothing), given["mean"], given["covariance"]
        )
        after = step.after(before, given["t"], given.get("u", nothing), given["y"])
        found = [after.t, *([after.u] if system.inputs else []), after.mean, after.covariance]
        return (*found, step.read(outputs, after)) if outputs else tuple(found)

    results = [replace(p, default=None) for p in remembered] + _vector("values", outputs, system)
    title = f"{type(system.model).__name__} observer"
    return Target(title, _flat(call, results), (*ports, *remembered), tuple(results))


def _of_network(
    network: Callable[..., Any], inputs: Sequence[str], output: str, units: Mapping[str, str]
) -> Target:
    """A law of named quantities, with units by name; of an energy, its derivative, which is the law.

    Raises:
        DataError: for a network that cannot be called with as many numbers.
    """
    law = law_of(network)
    try:
        shape = jax.eval_shape(law, *[jax.ShapeDtypeStruct((), float)] * len(inputs)).shape
    except Exception as error:  # an exception of the user's own code
        reason = str(error).splitlines()[0]
        raise DataError(
            f"export: {shown(network, 40)} cannot be called with {len(inputs)} numbers ({reason}); name its arguments: "
            "inputs=('s_rel',)"
        ) from None
    ports = tuple(TargetPort(n, (), (n,), (units.get(n, ""),)) for n in inputs)
    elements = (output,) if not shape else tuple(f"{output}[{i + 1}]" for i in range(shape[0]))
    result = TargetPort(output, shape, elements, (units.get(output, ""),) * len(elements))
    kind = "energy's law" if isinstance(network, EnergyLaw) else "law"
    return Target(f"{kind} {network!r}"[:200], lambda *a: (law(*a),), ports, (result,))


def arguments(target: Target, batch: str | None, function: str) -> list[jax.ShapeDtypeStruct]:
    """Shapes of the arguments, with a symbolic leading one if there is a batch.

    Raises:
        DataError: if the batch has no name.
    """
    if batch is not None and not (isinstance(batch, str) and batch.isidentifier()):
        raise DataError(
            f"export.{function}: batch={shown(batch)} names a dimension; give a name such as batch='N'"
        )
    leading: tuple[Any, ...] = () if batch is None else tuple(jax_export.symbolic_shape(batch))
    return [
        jax.ShapeDtypeStruct((*leading, *p.shape) if p.batched else p.shape, float)
        for p in target.inputs
    ]


def traced(target: Target, batch: str | None, function: str) -> ClosedJaxpr:
    """The jaxpr of what is exported, in double precision."""
    call = target.call if batch is None else target.batch()
    return jax.make_jaxpr(call)(*arguments(target, batch, function))


def _vector(name: str, elements: tuple[str, ...], system: System) -> list[TargetPort]:
    units = tuple(system.unit(e) for e in elements)
    return [TargetPort(name, (len(elements),), elements, units)] if elements else []


def _flat(
    call: Callable[..., tuple[Array, ...]], results: Sequence[TargetPort]
) -> Callable[..., tuple[Array, ...]]:
    return lambda *arrays: tuple(
        jnp.reshape(a, p.shape) for a, p in zip(call(*arrays), results, strict=True)
    )


def _numbers(
    params: Mapping[str, Any],
) -> tuple[list[TargetPort], Callable[[Sequence[Array]], dict[str, Any]]]:
    """Parameters and weights as arguments, and how the parameters are built from them."""
    found, tree = jax.tree_util.tree_flatten_with_path(dict(params))
    ports: list[TargetPort] = []
    places: list[int] = []
    for place, (path, leaf) in enumerate(found):
        if isinstance(leaf, float | int | np.ndarray | np.number | jax.Array):
            name = "".join(_key(path))
            value = np.asarray(leaf, dtype=float)
            ports.append(TargetPort(name, value.shape, (name,), ("",), value))
            places.append(place)
    leaves = [leaf for _, leaf in found]

    def rebuild(arrays: Sequence[Array]) -> dict[str, Any]:
        new = list(leaves)
        for place, array in zip(places, arrays, strict=True):
            new[place] = array
        return jax.tree_util.tree_unflatten(tree, new)

    return ports, rebuild


def _key(path: Sequence[Any]) -> Iterator[str]:
    """A leaf's name: ``spring_nn.net.weights[1]``, counted from 1 as in Modelica."""
    for i, key in enumerate(path):
        match key:
            case jax.tree_util.DictKey():
                yield str(key.key) if i == 0 else f"[{key.key}]"
            case jax.tree_util.SequenceKey():
                yield f"[{key.idx + 1}]"
            case _:
                yield str(key)


# -- networks in equations ----------------------------------------------------------------------------


def _called_with(
    system: System, network: str
) -> tuple[tuple[str, ...], str, dict[str, str]] | None:
    """Names of the arguments and of the result of a network, and their units, from the first equation that calls it.

    Arguments:
        network: its name in the model, such as ``"spring_nn.net"``.

    Returns:
        ``(inputs, output, units)``; an argument that is an expression is ``x1``, ``x2``; a result within one is ``y``.
        None where no equation of its own component calls it.
    """
    owner, _, name = network.rpartition(".")
    layout = system.flat.layout
    if owner not in layout.number:
        return None
    units: dict[str, str] = {}

    def named(expression: Any, otherwise: str) -> str:
        if not isinstance(expression, Reference):
            return otherwise
        full = full_name(expression.owner.path, expression.path)
        units[full] = expression.declaration.unit
        return full

    for equation in each(layout.components[layout.number[owner]].equations()):
        for left, right in (_sides(equation), _sides(equation)[::-1]):
            for call in _calls(right, name):
                arguments = call.args[2:]
                if len(arguments) == 1:
                    inputs = (named(arguments[0], "x"),)
                else:
                    inputs = tuple(named(a, f"x{i}") for i, a in enumerate(arguments, start=1))
                output = named(left, "y") if call == right else "y"
                return inputs, output, units
    return None


def _sides(equation: Any) -> tuple[Any, Any]:
    return getattr(equation, "lhs", None), getattr(equation, "rhs", None)


def _calls(expression: Any, name: str) -> list[Any]:
    """Calls of a network, that without other operations around it first."""
    if not hasattr(expression, "atoms"):
        return []
    calls = [c for c in expression.atoms(ModuleCall) if getattr(c.args[0], "path", "") == name]
    return sorted(calls, key=lambda c: (c != expression, str(c)))
