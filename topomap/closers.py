"""Loop closers by name, set up for a robot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evidence.dempster_shafer import DempsterShaferCloser, PublishedRule
from evidence.likelihood import LikelihoodCloser, LikelihoodRule
from evidence.position import least_distance
from evidence.walls import RelativeError
from topomap.errors import InputError

if TYPE_CHECKING:
    from behaviours.parameters import Parameters
    from evidence.walls import LoopCloser

__all__ = ["CLOSINGS", "SLIP", "make_closer"]

CLOSINGS = (
    "likelihood",
    "likelihood-full-lap",
    "dempster-shafer",
    "dempster-shafer-95",
)
"""The likelihood test, and the one that asks for a whole second lap though no corner
may be seen wrong; the published rule, with a gate that practically never misses
(99.9 %), and with the literal one (95 %)."""
SLIP = 1 / 200
"""How often a robot of which nothing is known misses, invents or misjudges a corner."""


def make_closer(
    name: str,
    sigma: float,
    parameters: Parameters,
    *,
    epsilon: float = 1e-4,
    slip: float = SLIP,
) -> LoopCloser:
    """Make the loop closer of a name.

    Parameters
    ----------
    name : str
        One of `CLOSINGS`.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    parameters : Parameters
        Of the robot: they decide how near two equal corners can be.
    epsilon : float
        The likelihood test closes when the probability of being wrong is below.
    slip : float
        How often the robot misses, invents or misjudges a corner; see
        `LikelihoodRule.slip` and `topomap.bodies.body_slip`.

    Returns
    -------
    LoopCloser
        Not yet begun.

    Raises
    ------
    InputError
        If there is no closer of that name, or sigma is out of range.
    """
    if name not in CLOSINGS:
        raise InputError("", "closing", name, f"one of {', '.join(CLOSINGS)}")
    try:
        error = RelativeError(sigma)
    except ValueError:
        expected = "a part of the length from 0 to 0.5"
        raise InputError("", "sigma", sigma, expected) from None
    nearest = least_distance(parameters.r0, parameters.r_min, parameters.r_max)
    if name.startswith("likelihood"):
        full_lap = name == "likelihood-full-lap"
        rule = LikelihoodRule(
            epsilon=epsilon, full_lap=full_lap, slip=slip, r_star=nearest
        )
        return LikelihoodCloser(error, rule)
    gate = 0.95 if name.endswith("95") else 0.999
    return DempsterShaferCloser(error, PublishedRule(alpha=gate, r_star=nearest))
