"""Dempster-Shafer evidence, and the decision that a loop is closed."""

from evidence.dempster_shafer import DempsterShaferCloser, PublishedRule, Readings
from evidence.likelihood import LikelihoodCloser, LikelihoodRule
from evidence.mass import (
    MassFunction,
    TotalConflictError,
    belief,
    combine,
    conflict,
    discount,
    pignistic,
    plausibility,
)
from evidence.phi import Freedom, Variance
from evidence.position import least_distance
from evidence.walls import Decision, Hypothesis, LoopCloser, RelativeError, Wall

__all__ = [
    "Decision",
    "DempsterShaferCloser",
    "Freedom",
    "Hypothesis",
    "LikelihoodCloser",
    "LikelihoodRule",
    "LoopCloser",
    "MassFunction",
    "PublishedRule",
    "Readings",
    "RelativeError",
    "TotalConflictError",
    "Variance",
    "Wall",
    "belief",
    "combine",
    "conflict",
    "discount",
    "least_distance",
    "pignistic",
    "plausibility",
]
