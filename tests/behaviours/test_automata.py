"""Automata: checked when defined, printed as they run, stopped by the unforeseen."""

import importlib
from enum import Enum, auto

import pytest

from behaviours.automaton import Automaton, Row, UnforeseenError, perform
from behaviours.conditions import blocked, done, receded
from behaviours.follow_broken_wall import follow_broken_wall
from behaviours.follow_wall import follow_wall
from behaviours.parameters import Parameters
from behaviours.port import Move, Outcome, Readings, Reason
from behaviours.vertices import VertexType


class State(Enum):
    GO = auto()
    WAIT = auto()
    END = auto()


GO = Outcome(1.0, Reason.DONE, Readings())
STOP = Outcome(0.5, Reason.BLOCKED, Readings())


def automaton(*rows, starts=(State.GO,), ends=(State.END,)):
    return Automaton(starts, rows, ends)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: automaton(Row(State.GO, done, State.END)), "never entered: WAIT"),
        (
            lambda: automaton(
                Row(State.GO, done, State.END), Row(State.GO, blocked, State.WAIT)
            ),
            "never left: WAIT",
        ),
        (
            lambda: automaton(
                Row(State.GO, done, State.WAIT),
                Row(State.WAIT, done, State.END),
                Row(State.END, done, State.GO),
            ),
            "ends that are left: END",
        ),
        (lambda: automaton(starts=()), "a state to start in"),
    ],
)
def test_a_faulty_table_is_refused_when_defined(make, message):
    with pytest.raises(ValueError, match=message):
        make()


TABLE = automaton(
    Row(State.GO, done, State.END),
    Row(State.GO, blocked, State.WAIT),
    Row(State.WAIT, done, State.GO),
)


def test_performing_yields_the_actions_and_returns_the_path():
    actions = {State.GO: Move(1.0), State.WAIT: Move(0.0)}
    behaviour = perform(TABLE, actions, State.GO)
    assert next(behaviour) == Move(1.0)
    assert behaviour.send(STOP) == Move(0.0)
    assert behaviour.send(GO) == Move(1.0)
    with pytest.raises(StopIteration) as end:
        behaviour.send(GO)
    states = [state for state, _ in end.value.value]
    assert states == [State.GO, State.WAIT, State.GO, State.END]


def test_what_the_table_does_not_foresee_is_an_error_that_says_so():
    bump = Outcome(0.25, Reason.BUMPED, Readings())
    with pytest.raises(UnforeseenError) as raised:
        TABLE.step(State.GO, bump)
    assert str(raised.value) == "State.GO has no arrow for bumped after 0.25 m"


def test_the_first_row_that_holds_is_taken():
    table = automaton(
        Row(State.GO, lambda _: True, State.END),
        Row(State.GO, receded, State.WAIT),
        Row(State.WAIT, done, State.END),
    )
    assert table.step(State.GO, Outcome(0, Reason.RECEDED, Readings())) is State.END


TABLES = [
    pytest.param(importlib.import_module(f"behaviours.{name}"), id=name)
    for name in [
        "enter",
        "examine_corner",
        "explore",
        "explore_opening",
        "follow_broken_wall",
        "follow_hall",
        "follow_wall",
        "hall_opening",
        "leave_hall",
        "move_to_wall",
        "opposite",
        "probe",
    ]
]


def table_of(module):
    return getattr(module, module.__name__.partition(".")[2].upper())


@pytest.mark.parametrize("module", TABLES)
def test_the_docstring_shows_the_table_that_runs(module):
    table = table_of(module)
    assert "\n".join(table.table()) in module.__doc__


@pytest.mark.parametrize("name", ["follow_wall", "move_to_wall"])
def test_every_state_but_the_ends_has_an_action(name):
    module = importlib.import_module(f"behaviours.{name}")
    table = table_of(module)
    assert set(module.actions(Parameters())) == set(module.State) - set(table.ends)


@pytest.mark.parametrize("module", TABLES)
def test_the_diagram_has_an_arrow_for_every_row_start_and_end(module):
    table = table_of(module)
    arrows = [line for line in table.diagram() if "-->" in line]
    assert len(arrows) == len(table.rows) + len(table.starts) + len(table.ends)
    for row in table.rows:
        assert any(f"{row.here.name} --> {row.there.name}" in line for line in arrows)


@pytest.mark.parametrize("place", [VertexType.PORTAL, VertexType.TERM, VertexType.ILL])
def test_no_wall_is_followed_from_where_none_leads_on(place):
    with pytest.raises(
        ValueError, match=f"INT, EXT, SPLIT or None; got .*{place.name}"
    ):
        next(follow_broken_wall(Parameters(), place))
    with pytest.raises(ValueError, match=f"INT, EXT or None; got .*{place.name}"):
        next(follow_wall(Parameters(), place))
