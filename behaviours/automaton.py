"""Automata as tables: states are actions, rows are the arrows between them.

As in [K] Annex C a state stands for a primitive action and an arrow for the
condition under which that action ended. A table is plain data: it is checked
when it is defined, followed one step at a time, and printed or drawn from the
very rows that run.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any, Generic, TypeAlias, TypeVar

from behaviours.port import Behaviour, Outcome, Primitive

__all__ = ["Automaton", "Row", "perform"]

S = TypeVar("S", bound=Enum)


@dataclass(frozen=True, slots=True)
class Row(Generic[S]):
    """When the action of state `here` ended as `seen` says, go to `there`."""

    here: S
    seen: Callable[[Any], bool]
    """Holds for an action's result: an Outcome, or what a component returned."""
    there: S


@dataclass(frozen=True, slots=True)
class Automaton(Generic[S]):
    """Rows are tried from the top; the first that holds is taken.

    Raises
    ------
    ValueError
        If there is no start, a state can never be entered, an end is left, or
        a state that is no end is never left.

    Examples
    --------
    >>> from enum import Enum
    >>> from behaviours.port import Outcome, Readings, Reason
    >>> State = Enum("State", "KNOCK ENTER")
    >>> def opened(outcome): return outcome.reason is Reason.DONE
    >>> door = Automaton(
    ...     (State.KNOCK,), (Row(State.KNOCK, opened, State.ENTER),), (State.ENTER,)
    ... )
    >>> door.step(State.KNOCK, Outcome(0.0, Reason.DONE, Readings())).name
    'ENTER'
    """

    starts: tuple[S, ...]
    """Where it may begin."""
    rows: tuple[Row[S], ...]
    ends: tuple[S, ...]
    """Where it is over: these states have no action."""

    def __post_init__(self) -> None:
        if not self.starts:
            raise ValueError("an automaton needs a state to start in")
        states = set(type(self.starts[0]))
        left = {row.here for row in self.rows}
        if never := states - self._reachable():
            raise ValueError(f"never entered: {_names(never)}")
        if stuck := states - left - set(self.ends):
            raise ValueError(f"never left: {_names(stuck)}")
        if undone := left & set(self.ends):
            raise ValueError(f"ends that are left: {_names(undone)}")

    def step(self, state: S, result: object) -> S:
        """Return the state after `state`, whose action came to this result.

        Raises
        ------
        UnforeseenError
            If no row holds: the table has no answer to what happened.
        """
        for row in self.rows:
            if row.here is state and row.seen(result):
                return row.there
        raise UnforeseenError(state, result)

    def table(self) -> Iterator[str]:
        """Yield the rows as a Markdown table, line by line."""
        yield "| in | when | go to |"
        yield "|---|---|---|"
        for row in self.rows:
            yield f"| {row.here.name} | {_words(row)} | {row.there.name} |"

    def diagram(self) -> Iterator[str]:
        """Yield the automaton as a Mermaid state diagram, line by line."""
        yield "stateDiagram-v2"
        for start in self.starts:
            yield f"    [*] --> {start.name}"
        for row in self.rows:
            yield f"    {row.here.name} --> {row.there.name}: {_words(row)}"
        for end in self.ends:
            yield f"    {end.name} --> [*]"

    def _reachable(self) -> set[S]:
        reached: set[S] = set()
        todo = list(self.starts)
        while todo:
            state = todo.pop()
            if state not in reached:
                reached.add(state)
                todo += [row.there for row in self.rows if row.here is state]
        return reached


class UnforeseenError(RuntimeError):
    """An action ended in a way that its automaton has no arrow for."""

    def __init__(self, state: Enum, result: object) -> None:
        found = (
            f"{result.reason.value} after {result.distance:.2f} m"
            if isinstance(result, Outcome)
            else repr(result)
        )
        super().__init__(
            f"{type(state).__name__}.{state.name} has no arrow for {found}"
        )
        self.state = state
        self.result = result


Path: TypeAlias = list[tuple[S, Any]]
"""What was done so far: states, and what their actions came to."""
Action: TypeAlias = Primitive | Callable[[Path[S]], Primitive | Behaviour[Any]]
"""A primitive, or one that depends on the way so far, or a component: a behaviour."""
Actions: TypeAlias = Mapping[S, Action[S]]
"""What each state stands for; ends stand for nothing."""


def perform(
    automaton: Automaton[S], actions: Actions[S], start: S
) -> Generator[Primitive, Outcome, Path[S]]:
    """Carry out an automaton's actions from `start` until it ends.

    Parameters
    ----------
    automaton : Automaton
        Says which state follows which.
    actions : mapping of state to Primitive or callable
        One for each state that is no end. A callable is given what was done so
        far, and returns a primitive, or the behaviour of a component.
    start : state
        One of the automaton's starts.

    Returns
    -------
    list of (state, result)
        What was done, in order; the last entry is the end reached, with the
        last result once more.

    Yields
    ------
    Primitive
        The action of the present state, or the next one of its component.
    """
    done: Path[S] = []
    state = start
    while state not in automaton.ends:
        action = actions[state]
        now = action(done) if callable(action) else action
        result = (yield from now) if isinstance(now, Generator) else (yield now)
        done.append((state, result))
        state = automaton.step(state, result)
    return [*done, (state, done[-1][1])]


def _names(states: set[S]) -> str:
    return ", ".join(sorted(state.name for state in states))


def _words(row: Row[S]) -> str:
    return row.seen.__name__.replace("_", " ")
