"""EXPLORE: map a closed rectilinear world of open spaces and halls.

The automaton, whose drawing is lost and was designed again from table C.4 and
sections 3.2.2 and 3.4 of [K]_:

| in | when | go to |
|---|---|---|
| LOOK | in open space | MTW |
| LOOK | in a hall | HF |
| MTW | over | WF |
| WF | over | LOOP |
| HF | over | GOTO |
| LOOP | known | GOTO |
| LOOP | given up | RET |
| GOTO | at an exit | OUT |
| GOTO | no exit left | RET |
| OUT | over | PLACE |
| PLACE | known | GOTO |
| PLACE | given up | RET |

Purpose: explore a closed rectilinear world and put its vertices into a map.
Preconditions: none. Postcondition: no exit of the map is unexplored, or the robot
has given up. Arguments: the robot's lengths. Returns the map.

The states are behaviours that need the map, and so live with it
(`topomap.exploring`): LOOP walks along a wall until the base loop is known to be
closed; GOTO drives to the nearest unexplored exit by the shortest way in the map;
OUT goes through it to the next vertex; PLACE finds out whether that is one met
before, and closes the base loop there if it is a new one. So a base loop is closed
before the halls and rooms beyond it are entered ([K]_ 3.4), and loops stay short.
Where what is met refutes the map, it is begun anew in LOOP or GOTO.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009, sections 3.2.2, 3.4 and Annex C.1.
"""

from __future__ import annotations

from enum import Enum, auto

from behaviours.automaton import Automaton, Row

__all__ = ["EXPLORE", "State"]


class State(Enum):
    """What the robot is doing."""

    LOOK = auto()
    """Go forward until a wall is in range."""
    MTW = auto()
    WF = auto()
    """To a first vertex, along a wall."""
    HF = auto()
    """To the first vertex, along a hall."""
    LOOP = auto()
    """Close the base loop."""
    GOTO = auto()
    """To the nearest unexplored exit."""
    OUT = auto()
    """Through it, to the next vertex."""
    PLACE = auto()
    """Find out whether that vertex was met before."""
    RET = auto()


def in_open_space(is_hall: bool) -> bool:
    """The walls are not on both sides."""
    return not is_hall


def in_a_hall(is_hall: bool) -> bool:
    """Walls stand on both sides, at most 2 r0 apart."""
    return is_hall


def over(_: object) -> bool:
    """It has come to its end."""
    return True


def known(is_known: bool) -> bool:
    """The base loop is closed, or the place is recognised or known to be new."""
    return is_known


def given_up(is_known: bool) -> bool:
    """The walls that the robot may walk were used up before."""
    return not is_known


def at_an_exit(quarters: int | None) -> bool:
    """The robot stands at an unexplored exit."""
    return quarters is not None


def no_exit_left(quarters: int | None) -> bool:
    """Every exit of the map is explored."""
    return quarters is None


# fmt: off
EXPLORE = Automaton((State.LOOK, State.LOOP, State.GOTO), (
    #   in           when           go to
    Row(State.LOOK,  in_open_space, State.MTW),
    Row(State.LOOK,  in_a_hall,     State.HF),
    Row(State.MTW,   over,          State.WF),
    Row(State.WF,    over,          State.LOOP),
    Row(State.HF,    over,          State.GOTO),
    Row(State.LOOP,  known,         State.GOTO),
    Row(State.LOOP,  given_up,      State.RET),
    Row(State.GOTO,  at_an_exit,    State.OUT),
    Row(State.GOTO,  no_exit_left,  State.RET),
    Row(State.OUT,   over,          State.PLACE),
    Row(State.PLACE, known,         State.GOTO),
    Row(State.PLACE, given_up,      State.RET),
), (State.RET,))
# fmt: on
