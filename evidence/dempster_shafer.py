"""Close the loop by the published rule: belief from walls that should be equal.

Sections 3.3 and B.2 of [K]_, with the readings of the text that were tried as named
options.

References
----------
.. [K] S. Kadi, "Exploration multi-robots dans des environnements partiellement
   connus", Université de Constantine, 2009.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import Enum

from evidence.mass import (
    MassFunction,
    TotalConflictError,
    combine,
    conflict,
)
from evidence.phi import Freedom, Variance, agreement, set_masses
from evidence.position import Position, mass_in_disc, walk
from evidence.walls import Decision, Hypothesis, RelativeError, Wall

__all__ = ["DempsterShaferCloser", "PublishedRule", "Readings"]

LOOP = ("C", "I")
TURN_TOLERANCE = 1e-3
"""Turns (radians) that differ by less are equal."""
SIMILAR = 0.05
"""A wall whose Phi with another exceeds this is not distinct from it."""


class Readings(Enum):
    """Which readings of a wall make up the set L, (B.1) of [K]."""

    PAIR = "newest and previous"
    ALL = "all"


@dataclass(frozen=True, slots=True)
class PublishedRule:
    """Thresholds and readings of the published rule.

    The defaults are the reading of the text that reproduces the published rates.

    Raises
    ------
    ValueError
        If `alpha` or `beta` is not in (0, 1), or `r_star` is not above 0.
    """

    alpha: float = 0.999
    """Mass of the position's confidence region. The source says 0.95, which by
    itself loses one true closure in twenty."""
    beta: float = 0.99
    """Accept when m(C), reject when m(I) is above."""
    r_star: float = 0.25
    """Least distance, in metres, of two equal vertices: `least_distance`."""
    readings: Readings = Readings.PAIR
    variance: Variance = Variance.MODEL
    freedom: Freedom = Freedom.ALL
    distinctive: bool = False
    """Whether a wall counts the less the more walls are like it, B.2.3 of [K]."""

    def __post_init__(self) -> None:
        for name in ("alpha", "beta"):
            value = getattr(self, name)
            if not 0 < value < 1:
                raise ValueError(f"{name} must be in (0, 1); got {value}")
        if not (self.r_star > 0 and math.isfinite(self.r_star)):
            raise ValueError(f"r_star must be above 0 metres; got {self.r_star}")


@dataclass(slots=True)
class _Live:
    """One hypothesis under test."""

    period: int
    mass: MassFunction
    agreed: float = 1.0
    """Product of 1 - conflict over the combinations so far."""


@dataclass(slots=True)
class DempsterShaferCloser:
    """The published rule as a `LoopCloser`.

    A hypothesis "v_k is v_0" opens where v_k has the type and turn of v_0, the
    robot has turned by exactly one full turn, and v_0 lies in the confidence region
    of v_k. Each wall after that is compared with the wall it should repeat.
    Hypotheses live side by side; that of the highest m(C) above beta is accepted,
    and kept until refuted.

    Parameters
    ----------
    error : RelativeError
        The odometry's. With sigma 0 lengths are exact: the first vertex within r*
        of v_0 closes the loop.
    rule : PublishedRule
        Thresholds, and how to read the text.

    Examples
    --------
    A room of 4 m by 3 m, entered at a corner, walked with exact odometry:

    >>> closer = DempsterShaferCloser(RelativeError(0.0))
    >>> closer.begin("INT", math.pi / 2)
    >>> for length in (4.0, 3.0, 4.0, 3.0):
    ...     decision = closer.observe(Wall(length, "INT", math.pi / 2))
    >>> decision.period, decision.hypotheses[0].belief
    (4, 1.0)
    """

    error: RelativeError
    rule: PublishedRule = field(default_factory=PublishedRule)
    _corners: list[tuple[str, float]] = field(default_factory=list, init=False)
    _lengths: list[float] = field(default_factory=list, init=False)
    _here: Position = field(default_factory=Position, init=False)
    _live: list[_Live] = field(default_factory=list, init=False)
    _accepted: int | None = field(default=None, init=False)

    def begin(self, kind: str, turn: float) -> None:
        """Start at v_0: its type, and the robot's turn there, in radians."""
        self._corners = [(kind, turn)]
        self._lengths = []
        self._here = Position()
        self._live = []
        self._accepted = None

    def observe(self, wall: Wall) -> Decision:
        """Take in the next wall, with v_k at its end, and decide.

        Raises
        ------
        ValueError
            If `begin` was not called.
        """
        if not self._corners:
            raise ValueError("begin must be called before observe")
        self._corners.append((wall.kind, wall.turn))
        self._lengths.append(wall.length)
        deviation = self.error.deviation(wall.length)
        self._here = walk(self._here, wall.length, deviation, wall.shift, wall.turn)
        refuted = [live.period for live in self._live if not self._test(live)]
        self._live = [live for live in self._live if live.period not in refuted]
        opened = self._open()
        return self._decide(refuted, opened)

    def _test(self, live: _Live) -> bool:
        """Take the newest wall into a hypothesis; return whether it survives."""
        k, period = len(self._lengths), live.period
        if not _same(self._corners[k], self._corners[k - period]):
            return False
        repeats = self._lengths[k - 1 :: -period]
        if self.rule.readings is Readings.PAIR:
            repeats = repeats[:2]
        phi = agreement(
            repeats,
            self.error.sigma,
            variance=self.rule.variance,
            freedom=self.rule.freedom,
        )
        correct, incorrect = set_masses(phi, self._distinctiveness())
        wall = MassFunction(
            LOOP, {"C": correct, "I": incorrect, LOOP: 1 - correct - incorrect}
        )
        live.agreed *= 1 - conflict(live.mass, wall)
        try:
            live.mass = combine(live.mass, wall)
        except TotalConflictError:
            return False
        return live.mass.mass("I") <= self.rule.beta

    def _open(self) -> bool:
        """Open the hypothesis that the newest vertex is v_0, if it may be."""
        k = len(self._lengths)
        full_turn = abs(abs(self._here.heading) - 2 * math.pi) < TURN_TOLERANCE
        if not (full_turn and _same(self._corners[k], self._corners[0])):
            return False
        if self.error.sigma > 0:
            reached = self._here.reaches_start(self.rule.alpha)
        else:
            reached = math.hypot(self._here.x, self._here.y) < self.rule.r_star
        if reached:
            near = mass_in_disc(self._here, self.rule.r_star)
            mass = MassFunction(LOOP, {"C": near, LOOP: 1 - near})
            self._live.append(_Live(k, mass))
        return reached

    def _decide(self, refuted: list[int], opened: bool) -> Decision:
        beliefs = sorted(
            (
                Hypothesis(
                    live.period,
                    live.mass.mass("C"),
                    live.mass.mass("I"),
                    1 - live.agreed,
                )
                for live in self._live
            ),
            key=lambda h: -h.correct,
        )
        if self._accepted in refuted:
            self._accepted = None
        best = beliefs[0] if beliefs else None
        if self._accepted is None and best and best.correct > self.rule.beta:
            self._accepted = best.period
        chosen = next((h for h in beliefs if h.period == self._accepted), best)
        wrong = 1.0 if chosen is None else 1.0 - chosen.correct
        reason = self._reason(chosen, refuted, opened)
        return Decision(self._accepted, wrong, tuple(beliefs), reason)

    def _reason(
        self, chosen: Hypothesis | None, refuted: list[int], opened: bool
    ) -> str:
        after = f"after {len(self._lengths)} walls"
        if chosen is None:
            gone = f"; refuted: {refuted}" if refuted else ""
            return f"{after} no vertex can be the start{gone}"
        numbers = (
            f"m(C) = {chosen.correct:.4f}, m(I) = {chosen.incorrect:.4f}, "
            f"conflict {chosen.conflict:.4f}"
        )
        if self._accepted == chosen.period:
            return f"{after} the loop has {chosen.period}: {numbers}"
        verb = (
            "was opened" if opened and chosen.period == len(self._lengths) else "waits"
        )
        return f"{after} the hypothesis of {chosen.period} {verb}: {numbers}"

    def _distinctiveness(self) -> float:
        """Return 1 over how many walls so far are like the newest, B.2.3 of [K].

        The one that it should repeat is always among them.
        """
        if not self.rule.distinctive:
            return 1.0
        newest, kind = self._lengths[-1], self._corners[-1][0]
        like = sum(
            self._corners[k + 1][0] == kind
            and agreement((newest, length), self.error.sigma) > SIMILAR
            for k, length in enumerate(self._lengths[:-1])
        )
        return 1.0 / max(like, 1)


def _same(a: tuple[str, float], b: tuple[str, float]) -> bool:
    return a[0] == b[0] and abs(a[1] - b[1]) < TURN_TOLERANCE
