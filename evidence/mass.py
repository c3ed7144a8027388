"""What Dempster-Shafer evidence says about a finite set of possibilities.

A `MassFunction` spreads one unit of mass over *sets* of possibilities; mass on
the whole frame is ignorance. `combine` is Dempster's rule. Annex A of [K]_, after
[S]_.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009.
.. [S] G. Shafer, "A Mathematical Theory of Evidence", Princeton University
   Press, 1976.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, field

__all__ = [
    "MassFunction",
    "TotalConflictError",
    "belief",
    "combine",
    "conflict",
    "discount",
    "pignistic",
    "plausibility",
]

SUM_TOLERANCE = 1e-9
"""Masses whose sum is farther than this from 1 are refused."""


class TotalConflictError(ValueError):
    """Sources that exclude each other: no possibility is left to any of them."""

    def __init__(self, sources: int) -> None:
        super().__init__(
            f"the {sources} sources are in total conflict: "
            "no possibility has mass in all of them"
        )
        self.sources = sources
        """How many sources were to be combined."""


@dataclass(frozen=True, slots=True, init=False)
class MassFunction:
    """Basic probability assignment over the subsets of a frame, (A.3)-(A.4) of [K].

    Parameters
    ----------
    frame : iterable of hashable
        The possibilities, one of which is true; at least one, no two equal.
    masses : mapping
        From a subset to its mass. A subset is one name of the frame, or a tuple,
        set or frozenset of names. Masses are not negative and sum to 1 (within
        1e-9; they are then scaled to do so); subsets of mass 0 may be left out.

    Raises
    ------
    ValueError
        If the frame is empty or repeats a name, a subset is empty or names what
        is not in the frame, a mass is negative or not finite, or they do not
        sum to 1.

    Examples
    --------
    A loop closing hypothesis, correct or incorrect, of which little is known:

    >>> loop = MassFunction("CI", {"C": 0.2, ("C", "I"): 0.8})
    >>> belief(loop, "C"), plausibility(loop, "C"), loop.mass("I")
    (0.2, 1.0, 0.0)
    """

    frame: tuple[Hashable, ...]
    """The possibilities; possibility k is bit k of a subset's mask."""
    masses: tuple[tuple[int, float], ...] = field(repr=False)
    """Bit mask and mass of every subset that has mass, masks ascending."""

    def __init__(
        self, frame: Iterable[Hashable], masses: Mapping[Hashable, float]
    ) -> None:
        names = tuple(frame)
        if not names or len(set(names)) != len(names):
            raise ValueError(
                f"frame must hold at least one name, and no name twice; got {names}"
            )
        object.__setattr__(self, "frame", names)
        found: dict[int, float] = {}
        for subset, mass in masses.items():
            mask = self.mask(subset)
            if not (math.isfinite(mass) and mass >= 0):
                raise ValueError(
                    f"mass of {subset!r} must be finite and not negative; got {mass}"
                )
            if mask == 0:
                raise ValueError(f"the empty set must have no mass; got {mass}")
            found[mask] = found.get(mask, 0.0) + float(mass)
        total = math.fsum(found.values())
        if abs(total - 1) > SUM_TOLERANCE:
            raise ValueError(f"masses must sum to 1; got {total}")
        object.__setattr__(self, "masses", _scaled(found, total))

    @classmethod
    def vacuous(cls, frame: Iterable[Hashable]) -> MassFunction:
        """Return total ignorance: all mass on the whole frame."""
        names = tuple(frame)
        return cls(names, {frozenset(names): 1.0})

    def mask(self, subset: Hashable) -> int:
        """Return the bit mask of a subset: one name, or a tuple or set of names.

        Raises
        ------
        ValueError
            If a name is not in the frame.
        """
        names = self.frame
        if subset in names:
            return 1 << names.index(subset)
        mask = 0
        if isinstance(subset, (tuple, set, frozenset)):
            for name in subset:
                if name not in names:
                    raise ValueError(f"expected names of {names}; got {name!r}")
                mask |= 1 << names.index(name)
            return mask
        raise ValueError(
            f"expected a name of {names}, or a tuple or set of such; got {subset!r}"
        )

    def mass(self, subset: Hashable) -> float:
        """Return the mass that stands exactly on a subset."""
        return dict(self.masses).get(self.mask(subset), 0.0)

    def names(self, mask: int) -> frozenset[Hashable]:
        """Return the possibilities that a bit mask stands for."""
        return frozenset(name for k, name in enumerate(self.frame) if mask >> k & 1)


def combine(*sources: MassFunction) -> MassFunction:
    """Combine independent sources by Dempster's rule, (A.8)-(A.9) of [K].

    Commutative and associative; a vacuous source changes nothing.

    Parameters
    ----------
    *sources : MassFunction
        At least one, all over the same frame (in any order of names).

    Returns
    -------
    MassFunction
        Over the frame of the first source.

    Raises
    ------
    TotalConflictError
        If the sources exclude each other.
    ValueError
        If there is no source, or two frames differ.

    Notes
    -----
    O(a b) for sources of a and b focal sets; each source after the first is
    combined in turn, with the mass of conflict taken out each time.

    Examples
    --------
    The first wall measured after a wrong hypothesis, figure 5.3 of [K]:

    >>> initial = MassFunction("CI", {"C": 0.202, ("C", "I"): 0.798})
    >>> wall = MassFunction("CI", {"C": 0.0017, "I": 0.9799, ("C", "I"): 0.0184})
    >>> [round(combine(initial, wall).mass(s), 3) for s in ("C", "I")]
    [0.007, 0.975]
    """
    joint, _ = _combined(sources)
    return joint


def conflict(*sources: MassFunction) -> float:
    """Return the mass that the sources, taken together, put on nothing at all.

    In [0, 1]: 0 if they agree, 1 if they exclude each other. This is the
    denominator's subtrahend of (A.8) of [K], for all sources at once.
    """
    try:
        return _combined(sources)[1]
    except TotalConflictError:
        return 1.0


def belief(source: MassFunction, subset: Hashable) -> float:
    """Return the mass that proves a subset, (A.5) of [K]: its least probability."""
    mask = source.mask(subset)
    return math.fsum(mass for part, mass in source.masses if part & ~mask == 0)


def plausibility(source: MassFunction, subset: Hashable) -> float:
    """Return the mass that allows a subset, (A.6) of [K]: its greatest probability."""
    mask = source.mask(subset)
    return math.fsum(mass for part, mass in source.masses if part & mask)


def pignistic(source: MassFunction) -> dict[Hashable, float]:
    """Return a probability for each possibility: every set shares its mass evenly.

    Between belief and plausibility for every possibility, (A.7) of [K].
    """
    return {
        name: math.fsum(
            mass / part.bit_count() for part, mass in source.masses if part >> k & 1
        )
        for k, name in enumerate(source.frame)
    }


def discount(source: MassFunction, rate: float) -> MassFunction:
    """Return a source as it counts when it is unreliable with probability `rate`.

    Every mass shrinks by 1 - `rate`; what is lost goes to ignorance.

    Raises
    ------
    ValueError
        If `rate` is not in [0, 1].
    """
    if not 0 <= rate <= 1:
        raise ValueError(f"rate must be in [0, 1]; got {rate}")
    everything = (1 << len(source.frame)) - 1
    kept = {mask: (1 - rate) * mass for mask, mass in source.masses}
    kept[everything] = kept.get(everything, 0.0) + rate
    return _from_masks(source.frame, kept, math.fsum(kept.values()))


def _combined(sources: tuple[MassFunction, ...]) -> tuple[MassFunction, float]:
    """Return the combination and the mass of conflict of all sources together."""
    if not sources:
        raise ValueError("expected at least one source to combine; got none")
    joint, agreement = sources[0], 1.0
    for other in sources[1:]:
        both: dict[int, float] = {}
        for mask, mass in joint.masses:
            for part, weight in _in_frame(other, joint.frame):
                both[mask & part] = both.get(mask & part, 0.0) + mass * weight
        both.pop(0, None)
        kept = math.fsum(both.values())
        if kept <= 0:
            raise TotalConflictError(len(sources))
        agreement *= min(kept, 1.0)
        joint = _from_masks(joint.frame, both, kept)
    return joint, 1.0 - agreement


def _in_frame(
    source: MassFunction, frame: tuple[Hashable, ...]
) -> Iterable[tuple[int, float]]:
    """Return the masses of a source with its masks as `frame` numbers them."""
    if source.frame == frame:
        return source.masses
    if set(source.frame) != set(frame):
        raise ValueError(f"frames must be the same; got {frame} and {source.frame}")
    place = [1 << frame.index(name) for name in source.frame]
    return [
        (sum(bit for k, bit in enumerate(place) if mask >> k & 1), mass)
        for mask, mass in source.masses
    ]


def _from_masks(
    frame: tuple[Hashable, ...], masses: Mapping[int, float], total: float
) -> MassFunction:
    """Return a mass function from masks known to be good, scaled by 1 / total."""
    made = object.__new__(MassFunction)
    object.__setattr__(made, "frame", frame)
    object.__setattr__(made, "masses", _scaled(masses, total))
    return made


def _scaled(masses: Mapping[int, float], total: float) -> tuple[tuple[int, float], ...]:
    return tuple(
        (mask, masses[mask] / total) for mask in sorted(masses) if masses[mask]
    )
