"""How a map is written down: the records of the map file, and back."""

from __future__ import annotations

import math
from typing import Annotated, Literal, cast

import msgspec

from behaviours.parameters import Parameters
from behaviours.vertices import VertexType
from topomap.errors import InputError
from topomap.topological_map import Edge, Length, TopologicalMap, Vertex

__all__ = ["FORMAT", "VERSION", "MapRecord", "from_record", "to_record"]

FORMAT = "topomap-map"
VERSION = 1

Number = Annotated[float, msgspec.Meta(ge=-1e9, le=1e9)]
"""A finite number of a size that metres and degrees can have."""


class ParametersRecord(msgspec.Struct, forbid_unknown_fields=True):
    """The lengths the robot kept, in metres."""

    r0: Number
    r_min: Number
    r_max: Number
    r_w: Number


class VertexRecord(msgspec.Struct, omit_defaults=True, forbid_unknown_fields=True):
    """A vertex; angles in degrees."""

    id: int
    type: Literal["INT", "EXT", "PORTAL", "SPLIT", "TERM", "ILL"]
    exits_deg: list[Number]
    unexplored_deg: list[Number] = []
    position: tuple[Number, Number] | None = None
    covariance: tuple[tuple[Number, Number], tuple[Number, Number]] | None = None


class LengthRecord(msgspec.Struct, forbid_unknown_fields=True):
    """A measured length and its standard deviation, in metres."""

    value: Number
    sigma: Number


Kind = Literal["base", "island", "passive", "active"]


class EdgeRecord(msgspec.Struct, omit_defaults=True, forbid_unknown_fields=True):
    """An edge; angles in degrees, lengths in metres."""

    source: int
    target: int
    source_exit_deg: Number
    target_exit_deg: Number
    behaviour: str
    lengths: list[LengthRecord]
    clearance: Number | None = None
    shift: Number = 0.0
    kind: Kind = "base"
    sureness: Number = 1.0
    reach: Number | None = None
    widths: list[tuple[Number, Number]] = []


class MapRecord(msgspec.Struct, omit_defaults=True, forbid_unknown_fields=True):
    """A whole map file."""

    format: str
    version: int
    vertices: list[VertexRecord]
    edges: list[EdgeRecord]
    parameters: ParametersRecord | None = None


def to_record(chart: TopologicalMap) -> MapRecord:
    """Return the record of a map."""
    robot = chart.parameters
    robot_record = None
    if robot is not None:
        robot_record = ParametersRecord(robot.r0, robot.r_min, robot.r_max, robot.r_w)
    return MapRecord(
        FORMAT,
        VERSION,
        [
            VertexRecord(
                vertex.id,
                vertex.type.value,
                [_degrees(exit_) for exit_ in vertex.exits],
                [_degrees(exit_) for exit_ in vertex.unexplored],
                vertex.position,
                vertex.covariance,
            )
            for vertex in chart.vertices
        ],
        [
            EdgeRecord(
                edge.source,
                edge.target,
                _degrees(edge.source_exit),
                _degrees(edge.target_exit),
                edge.behaviour,
                [LengthRecord(length.value, length.sigma) for length in edge.lengths],
                edge.clearance,
                edge.shift,
                cast(Kind, edge.kind),
                edge.sureness,
                edge.reach,
                list(edge.widths),
            )
            for edge in chart.edges
        ],
        robot_record,
    )


def from_record(record: MapRecord) -> TopologicalMap:
    """Return the map that a record describes.

    Raises
    ------
    InputError
        If the record contradicts itself; the field is named as in the file.
    """
    return TopologicalMap(
        tuple(
            Vertex(
                vertex.id,
                VertexType(vertex.type),
                tuple(math.radians(exit_) for exit_ in vertex.exits_deg),
                tuple(math.radians(exit_) for exit_ in vertex.unexplored_deg),
                vertex.position,
                vertex.covariance,
            )
            for vertex in record.vertices
        ),
        tuple(
            Edge(
                edge.source,
                edge.target,
                math.radians(edge.source_exit_deg),
                math.radians(edge.target_exit_deg),
                tuple(Length(length.value, length.sigma) for length in edge.lengths),
                edge.behaviour,
                edge.shift,
                edge.clearance,
                edge.kind,
                edge.sureness,
                edge.reach,
                tuple(edge.widths),
            )
            for edge in record.edges
        ),
        None if record.parameters is None else _parameters(record.parameters),
    )


def _parameters(record: ParametersRecord) -> Parameters:
    try:
        return Parameters(record.r0, record.r_min, record.r_max, record.r_w)
    except ValueError as error:
        raise InputError(
            "", "parameters", None, f"consistent lengths: {error}"
        ) from None


def _degrees(angle: float) -> float:
    """Return an angle in degrees, free of the rounding of its radians."""
    return round(math.degrees(angle), 10)
