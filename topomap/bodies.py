"""Bodies by name, for those who do not want to assemble one themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from behaviours.parameters import Parameters
from topomap.errors import InputError
from topomap.incursions.errors import Drift
from worlds.profile import Profile

if TYPE_CHECKING:
    import numpy as np

    from behaviours.port import Body
    from worlds.arena import Arena
    from worlds.pose import Pose
    from worlds.world import World

__all__ = [
    "BODIES",
    "body_drift",
    "body_parameters",
    "body_profile",
    "body_slip",
    "make_body",
]

BODIES = ("ideal", "physical", "generic", "generic5", "epuck")
"""The ideal body; the default physical robot; physical robots by profile."""
HEADING = 0.02
"""How surely a physical body that has followed a wall is parallel to it, in radians."""
SELDOM = 1e-6
"""How often a simulated physical body is taken to misjudge a corner: so seldom that
walls need not be met twice for it."""
STAND = 0.1
"""How surely it stands at a corner, in parts of r0."""


def body_parameters(name: str | Profile) -> Parameters:
    """Return the lengths that a body keeps unless told otherwise.

    Raises
    ------
    InputError
        If there is no such body.
    """
    profile = body_profile(name)
    return Parameters() if profile is None else profile.parameters


def body_drift(name: str | Profile, sigma: float) -> Drift:
    """Return what a body knows of its own errors.

    Parameters
    ----------
    name : str or Profile
        One of `BODIES`, or of your own.
    sigma : float
        Standard deviation of a measured length, as a part of the length.

    Returns
    -------
    Drift
        Of the ideal body, whose headings are exact, only of lengths.

    Raises
    ------
    InputError
        If there is no such body.
    """
    profile = body_profile(name)
    if profile is None:
        return Drift(sigma)
    return Drift(
        sigma,
        turn=profile.turn_error,
        heading=HEADING if profile.drift else 0.0,
        bend=profile.drift,
        stand=STAND * profile.parameters.r0,
    )


def body_slip(name: str | Profile) -> float:
    """Return how often a body misses, invents or misjudges a corner.

    The ideal body never does. Nor was a simulated physical one seen to, in the 200
    maps of `reproduce mapping-physical`; it is still ready for it, and its loops may
    begin at a later vertex. Of a real robot see `topomap.closers.SLIP`.

    Raises
    ------
    InputError
        If there is no such body.
    """
    return 0.0 if body_profile(name) is None else SELDOM


def make_body(
    name: str | Profile,
    world: World,
    start: Pose,
    rng: np.random.Generator,
    *,
    sigma: float = 0.06,
    parameters: Parameters | None = None,
    arena: Arena | None = None,
) -> Body:
    """Set a body down in a world.

    Parameters
    ----------
    name : {"ideal", "physical", "generic", "generic5", "epuck"} or Profile
        ``ideal`` is exact but for its lengths; ``physical`` is the ``generic``
        robot; the others are profiles of physical robots, as is one of your own.
    world : World
        Rectilinear for the ideal body.
    start : Pose
        In free space.
    rng : numpy.random.Generator
        Draws the body's errors.
    sigma : float
        Standard deviation of a leg's measured length, as a part of the length.
    parameters : Parameters, optional
        The lengths it keeps; `body_parameters` where None.
    arena : worlds.arena.Arena, optional
        Where other physical bodies are too; alone where None.

    Returns
    -------
    Body
        Ready to execute primitives.

    Raises
    ------
    InputError
        If there is no such body.
    """
    profile = body_profile(name)
    if profile is None:
        from worlds.ideal import IdealBody

        return IdealBody(world, start, parameters or Parameters(), rng, sigma)
    from worlds.arena import Arena
    from worlds.physical import PhysicalBody

    return PhysicalBody(
        arena or Arena(world), start, profile, rng, sigma=sigma, parameters=parameters
    )


def body_profile(name: str | Profile) -> Profile | None:
    """Return a physical body's profile; None for the ideal one.

    Raises
    ------
    InputError
        If there is no such body.
    """
    if isinstance(name, Profile):
        return name
    if name not in BODIES:
        raise InputError("", "body", name, f"one of {', '.join(BODIES)}")
    if name == "ideal":
        return None
    from worlds.profiles import PROFILES

    return PROFILES["generic" if name == "physical" else name]
