"""Whether two maps overlap, and how."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from merge.chance import by_luck, false_merge_probability
from merge.embedding import embed
from merge.hypotheses import Hypotheses, grow_hypotheses
from merge.layout import lay_out
from merge.options import Options
from merge.overlays import find_overlays
from merge.repeats import find_copies, told_by_copies
from merge.verification import verify

if TYPE_CHECKING:
    from merge.clustering import Cluster
    from merge.graph import Graph
    from merge.layout import Layout
    from merge.rigid import RigidTransform

__all__ = ["Match", "decide", "match"]

Floats = NDArray[np.float64]

CLASH = 4.0
"""How much a place at which the maps contradict each other counts against them."""


@dataclass(frozen=True, eq=False)
class Match:
    """What is known about the overlap of two maps."""

    accepted: bool
    """Whether the merge may be relied on."""
    reason: str
    """Why it was refused; empty where it was accepted."""
    false_merge_probability: float
    """How likely the best overlay is wrong, at most; in (0, 1]."""
    best: Cluster | None
    """The best overlay, or None where no hypothesis survived."""
    alternatives: tuple[Cluster, ...]
    """The other overlays, best first."""
    hypotheses: Hypotheses
    """All connected correspondences."""
    at_a: Floats
    """Shape (V_A, 2): where the first map's vertices lie in its frame, in metres."""
    at_b: Floats
    """Shape (V_B, 2): where the second map's vertices lie in its frame, in metres."""

    @property
    def transform(self) -> RigidTransform | None:
        """Takes the second map into the first one's frame, by the best overlay."""
        return None if self.best is None else self.best.transform

    @property
    def pairs(self) -> NDArray[np.int64]:
        """The matched vertices of the best overlay, shape (K, 2)."""
        return np.zeros((0, 2), np.int64) if self.best is None else self.best.pairs


def match(a: Graph, b: Graph, options: Options | None = None) -> Match:
    """Find how map `b` lies over map `a`, and accept or refuse that.

    Parameters
    ----------
    a, b : Graph
        Maps of robots that share no frame.
    options : Options, optional
        The defaults unless given.

    Returns
    -------
    Match
        Refused with the reason where nothing matches, where the match is no better
        than chance brings, or where another overlay is about as good.

    Examples
    --------
    Two halves of one maze, of which the second lies askew:

    >>> import numpy as np
    >>> from merge.makers import breadth_first, cut, perturb, turn
    >>> from merge.mazes import make_maze
    >>> rng = np.random.default_rng(7)
    >>> maze = make_maze(8, 8, rng)
    >>> one = perturb(cut(maze, breadth_first(maze, 0, 24)), 0.03, rng)
    >>> other = perturb(cut(maze, breadth_first(maze, 12, 24)), 0.03, rng)
    >>> other, _ = turn(other, 0.7, rng)
    >>> found = match(one, other)
    >>> found.accepted, round(found.transform.angle, 1)
    (True, -0.7)
    """
    options = options or Options()
    at_a = embed(a) if a.positions is None else a.positions
    at_b = embed(b) if b.positions is None else b.positions
    layouts = lay_out(a), lay_out(b)
    hypotheses = grow_hypotheses(*layouts, options)
    return decide(a, b, layouts, (at_a, at_b), hypotheses, options)


def decide(
    a: Graph,
    b: Graph,
    layouts: tuple[Layout, Layout],
    places: tuple[Floats, Floats],
    hypotheses: Hypotheses,
    options: Options,
) -> Match:
    """Accept or refuse the best overlay that the hypotheses allow."""
    at_a, at_b = places
    if len(hypotheses) == 0:
        reason = f"no {options.least} connected vertices of the maps correspond"
        return Match(False, reason, 1.0, None, (), hypotheses, at_a, at_b)
    edge = float(np.concatenate([a.lengths, b.lengths]).mean())
    overlays = find_overlays(hypotheses, at_a, at_b, options.reach * edge)
    overlays.sort(key=lambda c: (-c.score, c.residual, c.members))
    best, others = overlays[0], tuple(overlays[1:])
    # Of the ways to lay a vertex on another, each overlay is one for each of its pairs.
    trials = max(hypotheses.ways / len(best.pairs), 1.0)
    rivals = [
        min(best.score, other.score + float(by_luck(len(other.pairs))))
        for other in others
    ]
    doubt = false_merge_probability(best.score, rivals, trials)
    wrong = doubt + options.twins * (1.0 - doubt)
    if wrong > options.false_merge:
        reason = _why(best, others, (doubt, wrong), trials, options)
        return Match(False, reason, wrong, best, others, hypotheses, at_a, at_b)
    verified = verify(*layouts, at_a, at_b, best, options)
    copies = [
        find_copies(layout, best.pairs[:, side], options)
        for side, layout in enumerate(layouts)
    ]
    told = told_by_copies(copies, len(best.pairs), best.score)
    against = told + CLASH * len(verified.clashes)
    doubt = false_merge_probability(
        best.score - against, [score - told for score in rivals], trials
    )
    wrong = doubt + options.twins * (1.0 - doubt)
    reason = ""
    if wrong > options.false_merge:
        share = told / best.score
        reason = (
            f"{len(best.pairs)} vertices match, but parts of them that a map has more "
            f"than once tell {share:.0%} of that, and {len(verified.clashes)} others "
            f"clash: the overlay is wrong with probability {wrong:.2g}"
        )
    best = verified.cluster
    return Match(not reason, reason, wrong, best, others, hypotheses, at_a, at_b)


def _why(
    best: Cluster,
    others: tuple[Cluster, ...],
    wrong: tuple[float, float],
    trials: float,
    options: Options,
) -> str:
    """Say why an overlay is refused; how likely it is wrong without and with twins."""
    alone = false_merge_probability(best.score, [], trials)
    size = len(best.pairs)
    if alone > options.false_merge:
        return (
            f"the best overlay has {size} matching vertices, which maps of this size "
            f"can have by chance: it is wrong with probability {wrong[1]:.2g}"
        )
    if wrong[0] <= options.false_merge:
        return (
            f"{size} vertices match, but the building may have another part like "
            f"them: the overlay is wrong with probability {wrong[1]:.2g}"
        )
    return (
        f"the maps fit in more than one way: the best overlay has {size} matching "
        f"vertices, another {len(others[0].pairs)}; the best is wrong with "
        f"probability {wrong[1]:.2g}"
    )
