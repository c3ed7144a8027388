"""How often the likelihood test closes many walks rightly: a compiled loop.

Plain arrays in, plain arrays out: row t is one walk along one boundary. The loop runs
the compiled step that the library runs, wall by wall.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numba import njit

from evidence import tracking
from evidence.likelihood import later_rule
from evidence.rows import check_rows
from evidence.starts import later_starts
from evidence.tracking import POSTERIOR, SLIP, Track, new_track, restart, step

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evidence.likelihood import LikelihoodRule

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

__all__ = ["likelihood_trials"]

LEAST_LOOP = 8
"""Two laps of at least four walls: a later start finds nothing before."""


def likelihood_trials(
    lengths: Floats,
    symbols: Integers,
    turns: Floats,
    sigma: float,
    rule: LikelihoodRule,
) -> tuple[Integers, Integers, Floats, Integers]:
    """Decide many walks by the likelihood test.

    Parameters
    ----------
    lengths : ndarray, shape (T, W)
        Measured walls of T walks, in metres.
    symbols : ndarray of int, shape (T, W + 1)
        Kinds of the corners v_0 to v_W, below 16.
    turns : ndarray, shape (T, W)
        Turns at v_1 to v_W, in radians.
    sigma : float
        Standard deviation that the rule is told, as a part of the length.
    rule : LikelihoodRule
        Its options.

    Returns
    -------
    periods : ndarray of int, shape (T,)
        Accepted number of walls; 0 where undecided at the end.
    walls : ndarray of int, shape (T,)
        After how many walls it was accepted.
    errors : ndarray, shape (T,)
        Stated error probability then.
    starts : ndarray of int, shape (T,)
        The vertex at which the accepted loop begins.

    Raises
    ------
    ValueError
        If a symbol is out of range, or the shapes do not belong together.
    """
    check_rows(lengths, symbols, turns)
    count, room = lengths.shape
    periods, starts = np.zeros((2, count), dtype=np.int64)
    walls, errors = np.full(count, room), np.ones(count)
    later = later_starts(room) if rule.slip > 0 else []
    for each, begins in ((rule, [0]), (later_rule(rule), later)):
        _loop(
            new_track(room, each.row(sigma), each.log_prior()),
            np.array(begins, dtype=np.int64),
            *(lengths, symbols, turns, periods, walls, errors, starts),
        )
    return periods, walls, errors, starts


def _loop_of(stamp: int) -> Callable[..., int]:
    """Return the compiled loop over walks.

    `stamp` changes with the file of the compiled step. Numba's cache would notice
    changes of this file alone, and go on with an old step; but its key holds what a
    function has in its closure.
    """

    @njit(cache=True, error_model="numpy")
    def loop(
        track: Track,
        begins: Integers,
        lengths: Floats,
        symbols: Integers,
        turns: Floats,
        periods: Integers,
        walls: Integers,
        errors: Floats,
        starts: Integers,
    ) -> int:
        """Decide all walks from v_0; or, where that comes too late, from later ones.

        A later start only counts if it is accepted before all earlier ones.
        """
        for t in range(lengths.shape[0]):
            for begin in begins:
                until = walls[t] - (periods[t] > 0)
                if begin > 0 and begin + LEAST_LOOP > until:
                    break
                restart(track, symbols[t, begin])
                for i in range(begin, until):
                    k = step(track, lengths[t, i], 0.0, symbols[t, i + 1], turns[t, i])
                    if k > 0:
                        periods[t], walls[t], starts[t] = k, i + 1, begin
                        once = max(2 * k - (i + 1 - begin), 0)
                        errors[t] = track.rule[SLIP] * once
                        for c in range(track.state[1]):
                            if track.period[c] == k:
                                errors[t] += 1.0 - track.weight[c, POSTERIOR]
                        break
        return stamp

    return loop


_loop = _loop_of(zlib.crc32(Path(tracking.__file__).read_bytes()))
