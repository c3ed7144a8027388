"""What a command says: results on standard output, progress on standard error."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from pathlib import Path

    from evidence.walls import Decision, LoopCloser, Wall

__all__ = ["Progress", "naming", "note", "progress", "say", "show_json", "watched"]


def say(text: str) -> None:
    """Print a line of the result."""
    typer.echo(text)


def note(text: str) -> None:
    """Say something about the result, beside it: on standard error."""
    typer.echo(text, err=True)


def show_json(value: Mapping[str, object]) -> None:
    """Print one JSON object."""
    typer.echo(json.dumps(value, indent=2, allow_nan=False))


@contextmanager
def progress(task: str) -> Iterator[Progress]:
    """Show how far a long job is; silent where nobody looks."""
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        yield Progress(None)
        return
    with console.status(task) as status:
        yield Progress(lambda text: status.update(f"{task}: {text}"))


class Progress:
    """Where a job tells how far it is."""

    def __init__(self, show: Callable[[str], None] | None) -> None:
        self._show = show

    def update(self, text: str) -> None:
        """Say where the job is now."""
        if self._show is not None:
            self._show(text)


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Name the world's file in what is found wrong with the world."""
    from worlds.errors import WorldError

    try:
        yield
    except WorldError as error:
        raise WorldError(f"{path}: {error.field}", error.fault) from None


@contextmanager
def watched(closer: LoopCloser) -> Iterator[LoopCloser]:
    """Show the walls that a robot walks and what it believes."""
    with progress("walking") as shown:
        yield _Watched(closer, shown)


class _Watched:
    """A loop closer that tells how far the robot is."""

    def __init__(self, closer: LoopCloser, shown: Progress) -> None:
        self._closer = closer
        self._shown = shown
        self._walls = 0

    def begin(self, kind: str, turn: float) -> None:
        """Pass on v_0."""
        self._closer.begin(kind, turn)

    def observe(self, wall: Wall) -> Decision:
        """Pass on a wall, and show what was made of it."""
        decision = self._closer.observe(wall)
        self._walls += 1
        self._shown.update(f"{self._walls} walls; {decision.reason}")
        return decision
