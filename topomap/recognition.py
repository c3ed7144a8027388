"""Whether two vertices of a growing map are one place met twice."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.stats import lognorm, ncx2, norm

from topomap.chart import Link
from topomap.embedding import embed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from behaviours.parameters import Parameters
    from topomap.chart import Chart

__all__ = ["Recognition", "expected_evidence", "recognise"]

SLOP = 0.02
"""Standard deviation, in metres, of where in a place a robot stops."""
COPIES = 0.01
"""Prior share of places that look like one met before, and are not."""
PRIOR = 0.5
"""Prior probability that a way leads back to where the robot has been."""
PARTITION = 0.1
"""Least thickness, in metres, of what is solid between two halls."""
VARIETY = 0.4
"""Least standard deviation of the logarithm of what lengths there are: of few that
happen to be alike, one must not conclude that all are."""
UNLIKELY = 1e-9
"""Candidates less likely than this are left out."""
TINY = 1e-300
"""Stands in for a probability too small for a float."""
MARGIN = 4.0
"""How much wider, in parts of r0, a map is than its vertices, which lie r0 from walls
that rooms go on behind."""


@dataclass(frozen=True, slots=True)
class Recognition:
    """What is made of one vertex that may be an earlier one."""

    vertex: int
    """The vertex in question."""
    candidates: tuple[tuple[int, float], ...]
    """Earlier vertices that it may be, with their probabilities, best first."""
    walls: int = 0
    """How many edges the robot had walked then."""

    @property
    def known(self) -> int | None:
        """The vertex that it most likely is; None for a new one."""
        if self.candidates and self.candidates[0][1] > self.new:
            return self.candidates[0][0]
        return None

    def is_sure(self, error: float) -> bool:
        """Return whether `known` is wrong with a probability below `error`."""
        return self.doubt < error

    @property
    def doubt(self) -> float:
        """Probability that `known` is wrong."""
        best = self.candidates[0][1] if self.candidates else 0.0
        return 1.0 - max(best, self.new)

    @property
    def new(self) -> float:
        """Probability that it is none of them."""
        return max(0.0, 1.0 - sum(p for _, p in self.candidates))


def recognise(
    chart: Chart, parameters: Parameters, sigma: float, vertex: int
) -> Recognition:
    r"""Weigh which earlier vertex a new one may be.

    Parameters
    ----------
    chart : Chart
        The map so far; the vertex is in it, joined to where the robot came from.
    parameters : Parameters
        Of the robot.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    vertex : int
        The new one.

    Returns
    -------
    Recognition
        With the posterior probability of each candidate.

    Notes
    -----
    A candidate x is of the same type, with the same ways, and can be the same: walked
    from both at once, the map never contradicts itself. Its weight against "a new
    place" is

    .. math:: \frac{N(\delta; 0, \Sigma)}{\rho\,P(|t| > r)} \cdot
              \frac{S}{c S + 1 - c}

    where :math:`\delta` is the way from x to the vertex in the embedded map and
    :math:`\Sigma` its covariance, :math:`\rho` how densely such places lie, r the
    least distance of two places that look the same, with t drawn about
    :math:`\delta`; S the likelihood ratio of all lengths that have been walked from
    both, and c the share of places that are copies of others. One embedding serves
    all candidates; its covariances cost O(V^2).
    """
    found = {
        x: pairs
        for x in chart.places
        if x != vertex and (pairs := chart.pairs(vertex, x)) is not None
    }
    if not found:
        return Recognition(vertex, ())
    at, spread, area = _whereabouts(chart, parameters, sigma, vertex)
    density = (len(found) + 1) / area
    lengths = np.array([link.length for link in chart.each_link()])
    weights = {}
    for x, pairs in found.items():
        position = _log_position(
            at[x], spread[x], density, _apart(parameters, at, pairs)
        )
        shape = sum(
            _log_shape(*links, sigma, lengths) for links in _common(chart, pairs)
        )
        weights[x] = position - np.logaddexp(
            math.log(COPIES), math.log1p(-COPIES) - shape
        )
    odds = math.log(PRIOR / (1 - PRIOR) / len(found))
    total = np.logaddexp.reduce([0.0, *(w + odds for w in weights.values())])
    ranked = sorted(
        ((x, math.exp(w + odds - total)) for x, w in weights.items()),
        key=lambda row: (-row[1], row[0]),
    )
    return Recognition(vertex, tuple((x, p) for x, p in ranked if p > UNLIKELY))


def _whereabouts(
    chart: Chart, parameters: Parameters, sigma: float, vertex: int
) -> tuple[dict[int, NDArray[np.float64]], dict[int, NDArray[np.float64]], float]:
    """Return where all vertices lie as seen from one, how surely, and on what area."""
    drawn = chart.as_map(parameters, sigma, first=vertex)
    places = embed(drawn)
    ids = [v.id for v in drawn.vertices]
    spread = places.covariances + SLOP**2 * np.eye(2)
    width, height = np.ptp(places.positions, axis=0) + MARGIN * parameters.r0
    return (
        dict(zip(ids, places.positions, strict=True)),
        dict(zip(ids, spread, strict=True)),
        float(width * height),
    )


def _apart(
    parameters: Parameters,
    at: dict[int, NDArray[np.float64]],
    pairs: dict[int, int],
) -> float:
    """Return how far apart, in metres, two places that look the same must be.

    Two halls have a wall between them; and rooms do not overlap.
    """
    extent = np.ptp([at[x] for x in pairs.values()], axis=0)
    return max(2 * parameters.r_w + PARTITION, float(extent.min()))


def _log_position(
    offset: NDArray[np.float64],
    spread: NDArray[np.float64],
    density: float,
    apart: float,
) -> float:
    """Return the log likelihood ratio of a way that should be zero."""
    near = -0.5 * (
        offset @ np.linalg.solve(spread, offset)
        + math.log(np.linalg.det(spread))
        + 2 * math.log(math.tau)
    )
    variance = float(np.linalg.eigvalsh(spread)[-1])
    beyond = ncx2.sf(apart**2 / variance, 2, float(offset @ offset) / variance)
    return float(near) - math.log(density) - math.log(max(float(beyond), TINY))


def _common(chart: Chart, pairs: dict[int, int]) -> Iterator[tuple[Link, Link]]:
    """Yield the two links of each edge that has been walked from both places."""
    for a, b in pairs.items():
        for quarters in range(4):
            first, second = (
                chart.links.get((a, quarters)),
                chart.links.get((b, quarters)),
            )
            if (
                first is not None
                and second is not None
                and first is not second
                and first.behaviour != "ENTER"
                and (
                    first.ends[0] == (a, quarters)
                    or first.beyond((a, quarters))[0] not in pairs
                )
            ):
                yield first, second


def expected_evidence(link: Link, sigma: float, lengths: NDArray[np.float64]) -> float:
    """Return how much it tells to walk an edge once more, if it is that edge.

    [K] 3.3.3: at a junction the robot is to choose the way that it expects to yield
    the most evidence. An edge of a length that few others have tells most.

    Parameters
    ----------
    link : Link
        As it has been measured.
    sigma : float
        Standard deviation of a measured length, as a part of the length.
    lengths : array, shape (E,)
        Of all edges, in metres.

    Returns
    -------
    float
        Log likelihood ratio of a length that repeats the edge's: of that edge, or of
        any.

    Examples
    --------
    One long hall among short ones:

    >>> short, long = Link(((0, 0), (1, 2)), "HF"), Link(((1, 0), (2, 2)), "HF")
    >>> short.lengths, long.lengths = [2.0], [9.0]
    >>> lengths = np.array([2.0, 2.0, 2.1, 9.0])
    >>> a, b = (expected_evidence(link, 0.06, lengths) for link in (short, long))
    >>> a < b
    True
    """
    return _log_ratio(link.length, 1, link, sigma, lengths)


def _log_shape(
    one: Link, other: Link, sigma: float, lengths: NDArray[np.float64]
) -> float:
    """Return the log likelihood ratio of two edges: that they are one, or any two."""
    return _log_ratio(one.length, len(one.lengths), other, sigma, lengths)


def _log_ratio(
    length: float, times: int, other: Link, sigma: float, lengths: NDArray[np.float64]
) -> float:
    """Return the log likelihood ratio of a length: of that edge, or of any."""
    share = 1 / times + 1 / len(other.lengths)
    deviation = math.hypot(sigma * other.length * math.sqrt(share), 2 * SLOP)
    same = norm.logpdf(length, other.length, deviation)
    logs = np.log(lengths)
    any_ = lognorm.logpdf(
        length, max(VARIETY, float(np.std(logs))), scale=math.exp(float(logs.mean()))
    )
    return float(same - any_)
