"""Close the loop by likelihood: is this wall an old one, or a typical new one.

Every number of walls k that the loop may have is weighed against "the loop is still
open", by the probability of all that was measured:

* *closed after k walls*: each later wall is another reading of the wall k before it.
  The readings of one wall have the marginal likelihood
  ``E = integral of prod N(l_i; L, sigma L) dL / L``, exact by Gaussian moments, and a
  new reading the density E(all) / E(earlier). The way around k walls is zero: the
  density of what was measured of it, from the fused lengths, against that of a vertex
  somewhere else.
* *open*: each wall is a new one, with a length and a corner like those met so far, or
  repeats the wall d back in a run of walls, for every d: rooms, steps and teeth do.
  How often runs begin and end is learned. A run that has come round upon itself ends
  soon, since an open boundary does not overlap itself.

Sigma is one of five values about the given one, weighed by the same data; a length
may be an outlier, and a corner be seen wrong. A period is accepted when its posterior
leaves less than `epsilon`, and more walls have repeated than the longest run that
starts at v_0 and was met elsewhere; nothing is accepted on rows of equal things
before their end has been seen twice; and where corners may be missed, invented or seen
wrong, not before the walls were met again on which that would go unnoticed. At any
later time a posterior below one half takes the closure back.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from evidence.starts import later_starts
from evidence.walls import Decision, Hypothesis, RelativeError, Wall

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evidence.tracking import Track

__all__ = ["LikelihoodCloser", "LikelihoodRule", "later_rule"]

LEAST_SHOWN = 1e-9
"""Hypotheses of a smaller posterior are kept, and not reported."""

SPOILT = 0.01
"""Prior probability that a loop from v_0 is spoilt by a corner badly seen."""
BOLDEST = 1e-4
"""Largest epsilon for a later start, whatever is asked of v_0."""


@dataclass(frozen=True, slots=True)
class LikelihoodRule:
    """What the likelihood test takes for granted, and when it decides.

    Raises
    ------
    ValueError
        If `epsilon`, `hazard`, `outlier` or `misseen` is not in (0, 1), `slip` is not
        in [0, 1), `doubt` is negative or not finite, or `r_star` is not above 0.
    """

    epsilon: float = 1e-4
    """Accept when the posterior probability of being wrong is below."""
    full_lap: bool = False
    """Whether every wall of the loop must have been met twice before accepting.

    Two rooms that are exact twins, the second of them at v_0, can deceive a robot that
    comes to the first one before it has seen it; but not for a whole lap.
    """
    hazard: float = 0.1
    """Prior odds, against "open", that a vertex which may be v_0 is v_0."""
    outlier: float = 0.01
    """How often a length is not of the error model at all."""
    misseen: float = 0.002
    """How often a corner's type is seen wrong."""
    doubt: float = 0.35
    """Standard deviation of log(true sigma / given sigma); 0 trusts the given one.

    Five values are weighed, from half to twice the given one.
    """
    slip: float = 1 / 200
    """How often a corner is missed, invented or seen wrong; 0 if never.

    A slip on a wall that was met once goes unnoticed, so it is part of the error that
    must be below `epsilon`: with the default of 1 in 200 every wall is met twice. With
    0 the loop is closed as soon as its length is known. Above 0 it may begin at a
    later vertex, too, where one was missed before.
    """
    r_star: float = 0.25
    """Least distance, in metres, of two equal vertices: `least_distance`."""

    def __post_init__(self) -> None:
        for name in ("epsilon", "hazard", "outlier", "misseen"):
            value = getattr(self, name)
            if not 0 < value < 1:
                raise ValueError(f"{name} must be in (0, 1); got {value}")
        if not 0 <= self.slip < 1:
            raise ValueError(f"slip must be in [0, 1); got {self.slip}")
        if not 0 <= self.doubt < math.inf:
            raise ValueError(f"doubt must be finite and not negative; got {self.doubt}")
        if not 0 < self.r_star < math.inf:
            raise ValueError(f"r_star must be above 0 metres; got {self.r_star}")

    def row(self, sigma: float) -> NDArray[np.float64]:
        """Return the options as the compiled step reads them."""
        return np.array(
            [
                sigma,
                self.epsilon,
                self.hazard,
                self.outlier,
                self.misseen,
                self.r_star,
                float(self.full_lap),
                self.slip,
            ]
        )

    def log_prior(self) -> NDArray[np.float64]:
        """Return the log probability of each multiple of the given sigma."""
        steps = np.arange(-2, 3) * math.log(2) / 2
        logs = -0.5 * (steps / max(self.doubt, 1e-3)) ** 2
        return np.asarray(logs - np.log(np.exp(logs).sum()))


def later_rule(rule: LikelihoodRule) -> LikelihoodRule:
    """Return the options of the test when it is begun at a later vertex.

    Every wall must be met twice, and the error be smaller by the odds that there was
    a reason to begin anew: many starts have many chances of being deceived.
    """
    epsilon = SPOILT * min(rule.epsilon, BOLDEST)
    return replace(rule, full_lap=True, epsilon=epsilon)


@dataclass(slots=True)
class LikelihoodCloser:
    """The likelihood test as a `LoopCloser`.

    Parameters
    ----------
    error : RelativeError
        The odometry's; it may be wrong by a factor of two. With sigma 0 lengths are
        exact, and the first vertex at v_0 closes the loop.
    rule : LikelihoodRule
        Assumptions and thresholds.

    Notes
    -----
    A wall costs O(n) for n walls so far, and O(n) for each candidate; in a loop of 20
    corners some 50 microseconds in all. The code is compiled when first used.

    A corner whose type alone differs is taken for badly seen (`misseen`); one whose
    turn differs refutes. Missed or invented vertices shift the count: the closure is
    then refuted. So the test is begun anew at later vertices too (`later_starts`),
    where it asks for a full lap; `Decision.start` says where the loop begins. Only on a
    wall that was not met again before v_0 was accepted, a slip goes unnoticed:
    `LikelihoodRule.slip` keeps the probability of that below `epsilon`.

    Of the shifts of walls only the way around makes use.

    Examples
    --------
    An L-shaped room, and odometry that errs by 5 %:

    >>> closer = LikelihoodCloser(RelativeError(0.05))
    >>> closer.begin("INT", math.pi / 2)
    >>> lap = [(6.1, 1), (2.0, 1), (2.4, -1), (3.9, 1), (3.5, 1), (5.8, 1)]
    >>> for length, turn in lap + lap:
    ...     kind = "INT" if turn > 0 else "EXT"
    ...     decision = closer.observe(Wall(length, kind, turn * math.pi / 2))
    >>> decision.period, decision.error_probability < 1e-4
    (6, True)
    """

    error: RelativeError
    rule: LikelihoodRule = field(default_factory=LikelihoodRule)
    _tracks: dict[int, Track] = field(default_factory=dict, init=False)
    _walls: int = field(default=0, init=False)
    _symbols: dict[tuple[str, int], int] = field(default_factory=dict, init=False)

    def begin(self, kind: str, turn: float) -> None:
        """Start at v_0: its type, and the robot's turn there, in radians."""
        self._symbols, self._tracks, self._walls = {}, {}, 0
        self._start(self.rule, self._symbol(kind, turn))

    def observe(self, wall: Wall) -> Decision:
        """Take in the next wall, with v_k at its end, and decide.

        Raises
        ------
        ValueError
            If `begin` was not called.
        """
        from evidence.tracking import step, widened

        if not self._tracks:
            raise ValueError("begin must be called before observe")
        symbol = self._symbol(wall.kind, wall.turn)
        periods = {}
        for start, track in self._tracks.items():
            if track.state[0] == track.lags.shape[1]:
                self._tracks[start] = track = widened(track)
            periods[start] = int(
                step(track, wall.length, wall.shift, symbol, wall.turn)
            )
        self._walls += 1
        if self.rule.slip > 0 and self._walls in later_starts(self._walls + 1):
            self._start(later_rule(self.rule), symbol)
        accepted = min((s for s, k in periods.items() if k), default=0)
        return _decision(self._tracks[accepted], periods[accepted], accepted)

    def _start(self, rule: LikelihoodRule, symbol: int) -> None:
        """Take the vertex reached, of the given kind, for one where the loop begins."""
        from evidence.tracking import new_track, restart

        track = new_track(64, rule.row(self.error.sigma), rule.log_prior())
        restart(track, symbol)
        self._tracks[self._walls] = track

    def _symbol(self, kind: str, turn: float) -> int:
        """Return a small number for a kind of corner; very rare kinds share one."""
        from evidence.tracking import KINDS

        key = kind, round(turn * 1000)
        return self._symbols.setdefault(key, min(len(self._symbols), KINDS - 1))


def _decision(track: Track, period: int, start: int) -> Decision:
    """Put the numbers of a walk into words; `track` knows it from v_start on."""
    seen, live, _, guarded = track.state.tolist()
    walls = start + seen
    ranked = sorted(
        (posterior, k)
        for posterior, k in zip(
            track.weight[:live, -1].tolist(), track.period[:live].tolist(), strict=True
        )
        if posterior > LEAST_SHOWN
    )
    hypotheses = tuple(Hypothesis(k, p, 1.0 - p) for p, k in reversed(ranked))
    if not ranked:
        reason = f"after {walls} walls no vertex can be the start"
        return Decision(None, 1.0, (), reason)
    chosen = next((h for h in hypotheses if h.period == period), hypotheses[0])
    verb, note = "may have", ""
    if period:
        verb, note = "has", f"; {_checked(track, seen, period)}"
        note += f", those before v_{start} left out" if start else ""
    elif guarded:
        note = f", but {guarded} walls must repeat first"
    slip = _unnoticed(track, seen, chosen.period)
    reason = (
        f"after {walls} walls the loop {verb} {chosen.period}: "
        f"posterior error {chosen.incorrect:.2g}{note}"
    )
    error = min(chosen.incorrect + slip, 1.0)
    return Decision(period or None, error, hypotheses, reason, start)


def _unnoticed(track: Track, walls: int, period: int) -> float:
    """Return the probability of a slip on a wall of the loop that was met once."""
    from evidence.tracking import SLIP

    return float(track.rule[SLIP]) * max(2 * period - walls, 0)


def _checked(track: Track, walls: int, period: int) -> str:
    """Return how much of a closed loop was met twice, and what did not agree."""
    from evidence.tracking import SYMBOL

    kinds = track.walls[SYMBOL, : walls + 1]
    differ = int((kinds[period:] != kinds[:-period]).sum())
    again = min(walls - period, period)
    corners = f", {differ} corners seen differently" if differ else ""
    return f"{again} of its walls met again{corners}"
