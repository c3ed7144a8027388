"""Automata: what a robot with a few short-range sensors is able to do."""

from behaviours.follow_wall import Leg, follow_wall
from behaviours.move_to_wall import move_to_wall
from behaviours.parameters import Parameters
from behaviours.port import Body, Outcome, Primitive, Readings, Reason, run
from behaviours.vertices import VertexType

__all__ = [
    "Body",
    "Leg",
    "Outcome",
    "Parameters",
    "Primitive",
    "Readings",
    "Reason",
    "VertexType",
    "follow_wall",
    "move_to_wall",
    "run",
]
