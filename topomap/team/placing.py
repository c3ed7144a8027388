"""With which bodies a team is set down in a world."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from topomap.bodies import body_profile
from topomap.errors import InputError

if TYPE_CHECKING:
    import numpy as np

    from behaviours.parameters import Parameters
    from worlds.arena import Arena
    from worlds.crew_body import CrewBody
    from worlds.ideal import IdealBody
    from worlds.lookout import Signal
    from worlds.pose import Pose
    from worlds.world import World

__all__ = ["Bodies", "place"]


class Bodies(NamedTuple):
    """The bodies of a team, and what they stand in."""

    bodies: tuple[IdealBody | CrewBody, ...]
    arena: Arena | None
    """Which all physical bodies share; ideal bodies are each alone."""


def place(
    name: str,
    world: World,
    starts: Sequence[Pose],
    parameters: Parameters,
    sigma: float,
    rng: np.random.Generator,
) -> Bodies:
    """Set the bodies of a team down.

    Raises
    ------
    InputError
        If there is no such body, or several of it could not pass each other.
    """
    profile = body_profile(name)
    rngs = rng.spawn(len(starts))
    if profile is None:
        from worlds.ideal import IdealBody

        ideal = (
            IdealBody(world, start, parameters, own, sigma)
            for start, own in zip(starts, rngs, strict=True)
        )
        return Bodies(tuple(ideal), None)
    from worlds.arena import Arena
    from worlds.crew_body import CrewBody, can_pass

    if len(starts) > 1 and not can_pass(profile.radius, parameters.r_w):
        expected = f"bodies of which two pass in a hall of {2 * parameters.r_w:g} m"
        raise InputError("", "body", name, f"{expected}, or one robot")
    arena = Arena(world)
    signals: list[Signal] = []
    crew = tuple(
        CrewBody(arena, signals, start, profile, own, sigma, parameters)
        for start, own in zip(starts, rngs, strict=True)
    )
    return Bodies(crew, arena)
