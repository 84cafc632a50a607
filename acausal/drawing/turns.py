"""Other ways to turn single boxes, to be tried where wires cross."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from acausal.drawing.facing import Faced, Facing
from acausal.drawing.scheme import OPPOSITE, Scheme

Turn = tuple[int, Facing]
"""A box, and how it may be turned instead."""


def turns(scheme: Scheme, faced: Faced) -> Iterator[Turn]:
    """Ports above may go below, pictures upside down; gates, and blocks and sensors that feed back, the other way."""
    back = set(_feeding_back(scheme, faced))
    for number, (box, facing) in enumerate(zip(scheme.boxes, faced.boxes, strict=True)):
        gate = box.is_port and box.ports[0].kind == "connector"
        if gate or (number in back and len(box.ports) <= 2):
            sides = {
                port: OPPOSITE[side] if side in ("left", "right") else side
                for port, side in facing.sides.items()
            }
            yield number, replace(facing, sides=sides, mirrored=not facing.mirrored)
        if box.icon.places and not facing.upright:
            sides = {
                p: OPPOSITE[s] if s in ("top", "bottom") else s for p, s in facing.sides.items()
            }
            yield number, replace(facing, sides=sides, flipped=not facing.flipped)
        for port, side in facing.sides.items():
            if side in ("top", "bottom") and box.ports[port].name not in box.icon.sides:
                yield number, replace(facing, sides={**facing.sides, port: OPPOSITE[side]})


def turned(faced: Faced, turn: Turn) -> Faced:
    """The facings with one box turned."""
    number, facing = turn
    return replace(faced, boxes=(*faced.boxes[:number], facing, *faced.boxes[number + 1 :]))


def _feeding_back(scheme: Scheme, faced: Faced) -> Iterator[int]:
    """Boxes whose signal goes to one that is not further right."""
    for net in scheme.nets:
        source, *sinks = net.ends
        place = faced.boxes[source.box].place
        if net.signal and any(faced.boxes[sink.box].place <= place for sink in sinks):
            yield source.box
