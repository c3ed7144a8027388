"""How several bodies in one arena carry out their behaviours at the same time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from behaviours.port import Behaviour, Outcome
    from worlds.arena import Arena
    from worlds.physical import PhysicalBody

__all__ = ["run_together"]

T = TypeVar("T")


def run_together(
    arena: Arena, crew: Sequence[tuple[Behaviour[T], PhysicalBody]]
) -> list[T]:
    """Let several bodies carry out their behaviours at the same time.

    Parameters
    ----------
    arena : Arena
        In which all the bodies are.
    crew : sequence of (behaviour, body)
        Behaviours not yet started, each with the body that carries it out.

    Returns
    -------
    list
        What the behaviours return, in the order of the crew. A robot whose
        behaviour has ended stands where it is.
    """
    results: dict[int, T] = {}

    def hand_over(k: int, outcome: Outcome | None) -> None:
        """Give a behaviour its outcome and its body the next primitive."""
        behaviour, body = crew[k]
        try:
            body.begin(next(behaviour) if outcome is None else behaviour.send(outcome))
        except StopIteration as end:
            results[k] = end.value

    for k in range(len(crew)):
        hand_over(k, None)
    while len(results) < len(crew):
        for k, (_, body) in enumerate(crew):
            while k not in results and (outcome := body.poll()) is not None:
                hand_over(k, outcome)
        if len(results) < len(crew):
            arena.step()
    return [results[k] for k in range(len(crew))]
