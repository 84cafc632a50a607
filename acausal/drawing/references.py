"""Grounds are drawn where they are needed, as on an engineer's sheet, instead of wired from afar."""

from __future__ import annotations

from dataclasses import replace

from acausal.drawing.scheme import Box, End, Footing, Net, Scheme


def with_local_references(scheme: Scheme) -> Scheme:
    """Draw a ground that is connected to several components once at each of them.

    Only a component whose icon says ``reference`` is repeated; all its copies have its path. It is drawn right
    at the port but where several ports share a side.
    """
    boxes: list[Box | None] = list(scheme.boxes)
    nets: list[Net] = []
    for net in scheme.nets:
        ground = next((e for e in net.ends if scheme.boxes[e.box].icon.reference), None)
        if ground is None or len(scheme.boxes[ground.box].ports) != 1:
            nets.append(net)
            continue
        own = scheme.boxes[ground.box]
        own_name = net.names[net.ends.index(ground)]
        boxes[ground.box] = None
        for end, name in zip(net.ends, net.names, strict=True):
            box = boxes[end.box]
            if end == ground or box is None:
                continue
            if _may_go_below(box, end.port):
                lowered = replace(box.ports[end.port], side="bottom")
                ports = (*box.ports[: end.port], lowered, *box.ports[end.port + 1 :])
                box = replace(box, ports=ports)
            if _has_room(box, end.port):
                footing = Footing(end.port, own.path, own.role, own.icon, (name, own_name))
                boxes[end.box] = replace(box, footings=(*box.footings, footing))
                continue
            copy = End(len(boxes), ground.port)
            boxes.append(own)
            nets.append(replace(net, ends=(end, copy), names=(name, own_name)))
    return _without_gaps(boxes, scheme, nets)


def _has_room(box: Box, port: int) -> bool:
    """Whether a port will have a side for itself: above or below, or as one of the two ends of an element."""
    level = any(p.side in ("left", "right") and p.kind == "connector" for p in box.ports)
    side = box.ports[port].side
    return not box.is_port and (side in ("top", "bottom") or (side is None and not level))


def _may_go_below(box: Box, port: int) -> bool:
    """Whether a ground fits below a closed box: one whose ports have no places of their own."""
    closed = box.icon.frame and box.inner is None and not box.icon.strokes
    return closed and not _has_room(box, port) and all(p.side != "bottom" for p in box.ports)


def _without_gaps(boxes: list[Box | None], scheme: Scheme, nets: list[Net]) -> Scheme:
    """The scheme with the boxes that are left."""
    kept = [number for number, box in enumerate(boxes) if box is not None]
    new = {old: number for number, old in enumerate(kept)}
    moved = tuple(
        replace(net, ends=tuple(End(new[e.box], e.port) for e in net.ends if e.box in new))
        for net in nets
    )
    return Scheme(tuple(box for box in boxes if box is not None), moved)
