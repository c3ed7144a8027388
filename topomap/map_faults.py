"""What contradicts itself in a map, named as in a map file."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from topomap.directions import is_among
from topomap.errors import InputError

if TYPE_CHECKING:
    from topomap.map_elements import Edge, Vertex

__all__ = ["faults"]

KINDS = "base", "island", "passive", "active"


def faults(
    vertices: tuple[Vertex, ...], edges: tuple[Edge, ...]
) -> Iterator[InputError]:
    """Yield what contradicts itself in a map, named as in a map file."""
    by_id: dict[int, Vertex] = {}
    for k, vertex in enumerate(vertices):
        if vertex.id in by_id:
            yield InputError(
                "", f"vertices[{k}].id", vertex.id, "an id not used before"
            )
        by_id[vertex.id] = vertex
        yield from _vertex_faults(vertex, k)
    used: dict[int, list[float]] = {vertex.id: [] for vertex in vertices}
    for k, edge in enumerate(edges):
        yield from _length_faults(edge, k)
        yield from _incursion_faults(edge, k)
        for end, vertex_id, direction in (
            ("source", edge.source, edge.source_exit),
            ("target", edge.target, edge.target_exit),
        ):
            if vertex_id not in by_id:
                yield InputError("", f"edges[{k}].{end}", vertex_id, "a vertex's id")
            elif edge.is_incursion:
                if not math.isfinite(direction):
                    place = f"edges[{k}].{end}_exit_deg"
                    yield _angle_error(place, direction, "a finite angle")
            elif expected := _misused(direction, by_id[vertex_id], used[vertex_id]):
                yield _angle_error(f"edges[{k}].{end}_exit_deg", direction, expected)
            else:
                used[vertex_id].append(direction)


def _misused(direction: float, vertex: Vertex, used: list[float]) -> str:
    """Return what an edge's direction at a vertex should have been; else ''."""
    if not math.isfinite(direction):
        return "a finite angle"
    if not is_among(direction, vertex.exits):
        return f"an exit of vertex {vertex.id}"
    if is_among(direction, vertex.unexplored):
        return "an exit that is not marked unexplored"
    if is_among(direction, used):
        return "an exit that no other edge uses"
    return ""


def _vertex_faults(vertex: Vertex, index: int) -> Iterator[InputError]:
    for name, directions in (
        ("exits_deg", vertex.exits),
        ("unexplored_deg", vertex.unexplored),
    ):
        for k, direction in enumerate(directions):
            expected = ""
            if not math.isfinite(direction):
                expected = "a finite angle"
            elif is_among(direction, directions[:k]):
                expected = "a direction not named before"
            elif name == "unexplored_deg" and not is_among(direction, vertex.exits):
                expected = "one of the vertex's exits"
            if expected:
                yield _angle_error(
                    f"vertices[{index}].{name}[{k}]", direction, expected
                )
    if vertex.position is not None and not all(map(math.isfinite, vertex.position)):
        place = f"vertices[{index}].position"
        yield InputError("", place, vertex.position, "finite metres")
    for row in vertex.covariance or ():
        if not all(map(math.isfinite, row)):
            place = f"vertices[{index}].covariance"
            yield InputError("", place, vertex.covariance, "finite square metres")


def _length_faults(edge: Edge, index: int) -> Iterator[InputError]:
    if not edge.lengths:
        yield InputError("", f"edges[{index}].lengths", [], "at least one length")
    for k, length in enumerate(edge.lengths):
        if not 0 < length.value < math.inf:
            place = f"edges[{index}].lengths[{k}].value"
            yield InputError("", place, length.value, "a finite length above 0")
        if not 0 <= length.sigma < math.inf:
            place = f"edges[{index}].lengths[{k}].sigma"
            yield InputError("", place, length.sigma, "a finite length, not negative")
    if not math.isfinite(edge.shift):
        yield InputError("", f"edges[{index}].shift", edge.shift, "a finite length")


def _incursion_faults(edge: Edge, index: int) -> Iterator[InputError]:
    if edge.kind not in KINDS:
        expected = f"one of {', '.join(KINDS)}"
        yield InputError("", f"edges[{index}].kind", edge.kind, expected)
    if not 0 <= edge.sureness <= 1:
        place = f"edges[{index}].sureness"
        yield InputError("", place, edge.sureness, "a probability")
    if edge.is_incursion != (edge.reach is not None):
        expected = "metres for an incursion, and for no other edge"
        yield InputError("", f"edges[{index}].reach", edge.reach, expected)
    elif edge.reach is not None and not 0 < edge.reach < math.inf:
        place = f"edges[{index}].reach"
        yield InputError("", place, edge.reach, "a finite length above 0")
    for k, (until, width) in enumerate(edge.widths):
        if not (math.isfinite(until) and 0 <= width < math.inf):
            place = f"edges[{index}].widths[{k}]"
            yield InputError("", place, (until, width), "two finite lengths")


def _angle_error(field: str, direction: float, expected: str) -> InputError:
    return InputError("", field, round(math.degrees(direction), 3), expected)
