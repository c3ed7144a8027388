"""Close the loop by likelihood: is this wall an old one, or a typical new one."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from evidence.walls import Decision, Hypothesis, RelativeError, Wall

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evidence.tracking import Track

__all__ = ["LikelihoodCloser", "LikelihoodRule"]


@dataclass(frozen=True, slots=True)
class LikelihoodRule:
    """What the likelihood test takes for granted, and when it decides."""

    epsilon: float = 1e-4
    """Accept when the posterior probability of being wrong is below."""
    full_lap: bool = False
    """Whether every wall of the loop must have been met twice before accepting."""
    hazard: float = 0.1
    """Prior odds that a vertex which may be v_0 is v_0."""
    outlier: float = 0.01
    """How often a length is not of the error model at all."""
    misseen: float = 0.002
    """How often a corner's type is seen wrong."""
    doubt: float = 0.35
    """Standard deviation of log(true sigma / given sigma); 0 trusts the given one."""
    r_star: float = 0.25
    """Least distance, in metres, of two equal vertices: `least_distance`."""

    def __post_init__(self) -> None:
        for name in ("epsilon", "hazard", "outlier", "misseen"):
            value = getattr(self, name)
            if not 0 < value < 1:
                raise ValueError(f"{name} must be in (0, 1); got {value}")
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
            ]
        )

    def log_prior(self) -> NDArray[np.float64]:
        """Return the log probability of each multiple of the given sigma."""
        steps = np.arange(-2, 3) * math.log(2) / 2
        logs = -0.5 * (steps / max(self.doubt, 1e-3)) ** 2
        return np.asarray(logs - np.log(np.exp(logs).sum()))


@dataclass(slots=True)
class LikelihoodCloser:
    """A likelihood test as a `LoopCloser`."""

    error: RelativeError
    rule: LikelihoodRule = field(default_factory=LikelihoodRule)
    _track: Track | None = field(default=None, init=False)
    _symbols: dict[tuple[str, int], int] = field(default_factory=dict, init=False)

    def begin(self, kind: str, turn: float) -> None:
        """Start at v_0: its type, and the robot's turn there, in radians."""
        from evidence.tracking import new_track, restart

        rule = self.rule
        self._symbols = {}
        self._track = new_track(64, rule.row(self.error.sigma), rule.log_prior())
        restart(self._track, self._symbol(kind, turn))

    def observe(self, wall: Wall) -> Decision:
        """Take in the next wall, with v_k at its end, and decide."""
        from evidence.tracking import step, widened

        if self._track is None:
            raise ValueError("begin must be called before observe")
        if self._track.state[0] == self._track.lags.shape[1]:
            self._track = widened(self._track)
        symbol = self._symbol(wall.kind, wall.turn)
        period = step(self._track, wall.length, wall.shift, symbol, wall.turn)
        return _decision(self._track, int(period))

    def _symbol(self, kind: str, turn: float) -> int:
        key = kind, round(turn * 1000)
        return self._symbols.setdefault(key, len(self._symbols))


def _decision(track: Track, period: int) -> Decision:
    live = int(track.state[1])
    walls = int(track.state[0])
    ranked = sorted(
        (
            (float(p), int(k))
            for p, k in zip(track.weight[:live, -1], track.period[:live], strict=True)
            if p > 1e-9
        ),
        reverse=True,
    )
    hypotheses = tuple(Hypothesis(k, p, 1.0 - p) for p, k in ranked)
    if not ranked:
        return Decision(
            None, 1.0, (), f"after {walls} walls no vertex can be the start"
        )
    chosen = next((h for h in hypotheses if h.period == period), hypotheses[0])
    guarded = int(track.state[3])
    wait = f", but {guarded} walls must repeat first" if guarded else ""
    verb = "the loop has" if period else "the loop may have"
    reason = (
        f"after {walls} walls {verb} {chosen.period}: "
        f"posterior error {chosen.incorrect:.2g}{wait}"
    )
    return Decision(period or None, chosen.incorrect, hypotheses, reason)
