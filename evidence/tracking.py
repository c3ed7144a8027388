"""How likely each number of walls is, given the walls walked: the compiled step.

`evidence.likelihood` says what is computed and why; here is how. All state is in
plain arrays, written in place, so that the same code serves the library, wall by
wall, and the experiments, thousands of loops a second.

The compiled code is one file on purpose: numba's cache notices only changes of the
file that a function stands in, not of those that it calls.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

__all__ = ["Track", "new_track", "restart", "step", "widened"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

SCALES = 5
"""How many values sigma may have: the given one times 2 to the -1, -1/2, 0, 1/2, 1."""
KINDS = 16
"""Most distinct corners (type and turn) of one boundary."""
CANDIDATES = 64
"""Most periods that are tracked at once; the least likely one gives way."""
LEAST_SIGMA = 1e-6
"""Exact lengths are taken to be wrong by so much, as a part of the length."""
LEAST_LENGTH = 1e-9
"""In metres: stands in for a wall of no length, whose logarithm is needed."""
TURN_TOLERANCE = 1e-3
"""Sums of turns, in radians, that differ by less are equal."""
KERNEL = 0.35
"""Standard deviation of the logarithm of a length that is near another."""
ROUND_END = 0.6
"""Probability that a run of copied walls ends at the next, once it went round."""
WINDING = 0.7
"""Probability that a boundary wound by more than a full turn winds on."""
LAP_ODDS = 3.0
"""How much likelier a period is once all of its walls have been met twice: what looks
like a loop and is none is mostly a copy of some rooms, and shorter than the loop."""
ROOT_TWO_PI = math.sqrt(2 * math.pi)
FULL_TURN = 2 * math.pi

# Track.rule
SIGMA, EPSILON, HAZARD, OUTLIER, MISSEEN, R_STAR, FULL_LAP, SLIP = range(8)
# Track.state
WALLS, LIVE, ACCEPTED, GUARDED = range(4)
# Track.learned
ENTRIES, STEPS, BROAD, NEAR, EQUAL, LOG_MEAN, LOG_SQUARES, EXITS, STAYS, WOUND = range(
    10
)
# Rows of Track.walls: wall i leads from v_i, where it has its heading, to v_{i + 1}.
LENGTH, LOG, SHIFT, HEADING, SYMBOL = range(5)
# Rows of Track.scale
PRIOR, FRESH, EVIDENCE, BELIEF = range(4)
# Column of Track.weight after those of the sigmas
POSTERIOR = SCALES


class Track(NamedTuple):
    """All that is known about one walk."""

    rule: Floats
    """Options of the test, and the sigma that was given."""
    state: Integers
    """Walls so far, candidates alive, period accepted, walls the guard asks for."""
    learned: Floats
    """What the world's walls are like: counts, mean and scatter."""
    walls: Floats
    """Shape (5, N + 1): length, its logarithm, shift; heading and kind at its start."""
    lags: Floats
    """Shape (2 SCALES, N): if open, the probability that walls now repeat those
    d + 1 back; and below, for how many walls they have done so on average."""
    scale: Floats
    """Shape (4, SCALES): of each sigma the log prior, the probability (if open) that
    the last wall was a new one, the log likelihood (if open), and the posterior."""
    follows: Floats
    """Shape (KINDS, KINDS): how often a corner followed another."""
    period: Integers
    """Shape (CANDIDATES,)."""
    weight: Floats
    """Shape (CANDIDATES, SCALES + 1): log likelihood but for the closure term; then
    the posterior of the candidate."""


def new_track(capacity: int, rule: Floats, prior: Floats) -> Track:
    """Return room for a walk of `capacity` walls; `restart` begins it."""
    track = Track(
        rule=rule,
        state=np.zeros(4, dtype=np.int64),
        learned=np.zeros(10),
        walls=np.zeros((5, capacity + 1)),
        lags=np.zeros((2 * SCALES, capacity)),
        scale=np.zeros((4, SCALES)),
        follows=np.zeros((KINDS, KINDS)),
        period=np.zeros(CANDIDATES, dtype=np.int64),
        weight=np.zeros((CANDIDATES, SCALES + 1)),
    )
    track.scale[PRIOR] = prior
    return track


def widened(track: Track) -> Track:
    """Return the same walk with room for twice as many walls."""
    size = track.lags.shape[1]
    return track._replace(
        walls=np.pad(track.walls, ((0, 0), (0, size))),
        lags=np.pad(track.lags, ((0, 0), (0, size))),
    )


compiled = njit(cache=True, error_model="numpy")


@compiled
def restart(track: Track, symbol: int) -> None:
    """Forget all walls and stand at v_0, a corner of the given kind."""
    for i in range(len(track.state)):
        track.state[i] = 0
    learned = track.learned
    for i in range(len(learned)):
        learned[i] = 0.0
    learned[BROAD], learned[NEAR], learned[EQUAL] = 2.0, 2.0, 1.0
    track.walls[SYMBOL, 0] = symbol
    track.walls[HEADING, 0] = 0.0
    for i in range(KINDS):
        for j in range(KINDS):
            track.follows[i, j] = 0.0
    for g in range(SCALES):
        for d in range(track.lags.shape[1]):
            track.lags[g, d] = track.lags[SCALES + g, d] = 0.0
        track.scale[FRESH, g] = 1.0
        track.scale[EVIDENCE, g] = 0.0
        track.scale[BELIEF, g] = math.exp(track.scale[PRIOR, g])


@compiled
def step(track: Track, length: float, shift: float, symbol: int, turn: float) -> int:
    """Take in one wall; return the period of the closed loop, or 0 if undecided."""
    n = track.state[WALLS]
    length = max(length, LEAST_LENGTH)
    track.walls[LENGTH, n] = length
    track.walls[LOG, n] = math.log(length)
    track.walls[SHIFT, n] = shift
    track.walls[SYMBOL, n + 1] = symbol
    track.walls[HEADING, n + 1] = track.walls[HEADING, n] + turn
    track.state[WALLS] = n + 1
    drawn = np.empty(SCALES)
    if n > 0:
        _extend_open(track, n, drawn)
        _extend_candidates(track, n, drawn)
    _learn(track, n)
    _open_candidate(track, n + 1)
    _weigh(track, n + 1)
    return int(_accept(track, n + 1))


@compiled
def _sigma(track: Track, g: int) -> float:
    """Return the value of sigma number g."""
    given = max(track.rule[SIGMA], LEAST_SIGMA)
    return float(given * 2.0 ** (0.5 * (g - SCALES // 2)))


@compiled
def _extend_open(track: Track, n: int, drawn: Floats) -> None:
    """Take wall n into the open hypothesis; `drawn` gets its density as a new wall.

    A forward step of a hidden Markov model: the last wall was a new one, or one of a
    run that repeats the walls d back, for one of all d.
    """
    learned, lags = track.learned, track.lags
    pair = np.empty((SCALES, n))
    parts = np.empty((SCALES, 3))
    end = np.empty((2, n))
    full = np.empty(n)
    _pair_densities(track, n, pair)
    _new_densities(track, n, pair, parts)
    _run_ends(track, n, end, full)
    corner, winding, matches = _corner_chances(track, n)
    enter = (0.2 + learned[ENTRIES]) / (10.0 + learned[STEPS])
    if matches == 0:
        enter = 0.0
    counts = np.zeros(7)
    for g in range(SCALES):
        drawn[g] = max(parts[g, 0] + parts[g, 1] + parts[g, 2], 1e-300)
        ended = series_ended = 0.0
        for d in range(n):
            old = 1 if lags[SCALES + g, d] >= full[d] else 0
            out = lags[g, d] * end[old, d]
            lags[g, d] -= out
            ended += out
            if full[d] == math.inf:
                series_ended += out
        free = track.scale[FRESH, g] + ended
        share = enter * free / max(matches, 1)
        norm, entered, series_went_on = _copy_on(track, n, g, share, pair, drawn, full)
        new = free * (1.0 - enter) * drawn[g] * corner
        norm += new
        for d in range(n):
            lags[g, d] /= norm
        track.scale[FRESH, g] = new / norm
        track.scale[EVIDENCE, g] += math.log(norm * winding)
        belief = track.scale[BELIEF, g] / norm
        counts[0] += belief * entered
        counts[1] += belief * (new + entered)
        for i in range(3):
            counts[2 + i] += belief * new * parts[g, i] / drawn[g]
        counts[5] += belief * (new + entered) * series_ended / free
        counts[6] += belief * series_went_on
    learned[ENTRIES] += counts[0]
    learned[STEPS] += counts[1]
    learned[BROAD] += counts[2]
    learned[NEAR] += counts[3]
    learned[EQUAL] += counts[4]
    learned[EXITS] += counts[5]
    learned[STAYS] += counts[6]


@compiled
def _copy_on(
    track: Track,
    n: int,
    g: int,
    share: float,
    pair: Floats,
    drawn: Floats,
    full: Floats,
) -> tuple[float, float, float]:
    """Let runs of copied walls begin and go on, and return their mass.

    First of all of them, then of those that began, then of those that went on in a
    series.
    """
    missed, outlier = track.rule[MISSEEN], track.rule[OUTLIER]
    lags, symbols = track.lags, track.walls[SYMBOL]
    norm = began = went_on = 0.0
    for d in range(n):
        chance = lags[g, d]
        entering = share if symbols[n - 1 - d] == symbols[n] else 0.0
        if chance + entering <= 1e-300:
            lags[g, d] = 0.0
            continue
        fits = (1.0 - outlier) * pair[g, d] + outlier * drawn[g]
        fits *= 1.0 - missed if symbols[n - d] == symbols[n + 1] else missed
        lags[g, d] = (chance + entering) * fits
        lags[SCALES + g, d] = 1.0 + lags[SCALES + g, d] * chance / (chance + entering)
        norm += lags[g, d]
        began += entering * fits
        if full[d] == math.inf:
            went_on += chance * fits
    return norm, began, went_on


@compiled
def _pair_densities(track: Track, n: int, pair: Floats) -> None:
    """Fill in the density of wall n as a reading of the wall d + 1 back, per sigma.

    One exponential serves all sigmas: each is root 2 of the one before.
    """
    length, largest = track.walls[LENGTH, n], _sigma(track, SCALES - 1)
    for d in range(n):
        other = track.walls[LENGTH, n - 1 - d]
        squares = length * length + other * other
        fit = math.exp(-0.5 * (length - other) ** 2 / (squares * largest * largest))
        scale = other * (length + other) / (ROOT_TWO_PI * squares**1.5)
        for g in range(SCALES - 1, -1, -1):
            pair[g, d] = scale * fit / _sigma(track, g)
            fit *= fit


@compiled
def _new_densities(track: Track, n: int, pair: Floats, parts: Floats) -> None:
    """Fill in the density of wall n as a new wall, in the three parts that add up.

    Its length is anything like the lengths so far, near one of them, or equal to one;
    the weights of the three are learned.
    """
    learned, logs = track.learned, track.walls[LOG]
    length = track.walls[LENGTH, n]
    deviation = math.sqrt((2.0 + learned[LOG_SQUARES]) / (2.0 + n) * (1.0 + 1.0 / n))
    z = (logs[n] - learned[LOG_MEAN]) / deviation
    broad = math.exp(-0.5 * z * z) / (deviation * ROOT_TWO_PI * length)
    near = 0.0
    for i in range(n):
        z = (logs[n] - logs[i]) / KERNEL
        near += math.exp(-0.5 * z * z)
    near /= n * KERNEL * ROOT_TWO_PI * length
    total = learned[BROAD] + learned[NEAR] + learned[EQUAL]
    for g in range(SCALES):
        equal = 0.0
        for d in range(n):
            equal += pair[g, d]
        parts[g, 0] = learned[BROAD] / total * broad
        parts[g, 1] = learned[NEAR] / total * near
        parts[g, 2] = learned[EQUAL] / total * equal / n


@compiled
def _corner_chances(track: Track, n: int) -> tuple[float, float, int]:
    """Return the chance of the corner after wall n, if new, and two more numbers.

    They are a factor for winding up, and how many walls so far began like wall n.
    Corners follow each other by a Markov chain that is learned. A boundary that has
    wound by more than a full turn, and winds on, must all be unwound again: rare.
    """
    symbols, learned = track.walls[SYMBOL], track.learned
    before, now = int(symbols[n]), int(symbols[n + 1])
    left = 0.0
    for i in range(KINDS):
        left += track.follows[before, i]
    matches = 0
    for i in range(n):
        if symbols[i] == before:
            matches += 1
    wound = abs(track.walls[HEADING, n + 1])
    further = wound > max(FULL_TURN, learned[WOUND]) + TURN_TOLERANCE
    chance = (track.follows[before, now] + 0.5) / (left + 1.0)
    return chance, WINDING if further else 1.0, matches


@compiled
def _run_ends(track: Track, n: int, end: Floats, full: Floats) -> None:
    """Fill in when a run of walls that repeat those d + 1 back comes to its end.

    That is its full age, and the probability that it ends before that and after.
    Runs with no turn between original and copy, as along a row of rooms, may go on
    for ever. Those with a turn come back upon themselves once they have gone round:
    an open boundary cannot, but for what noise takes for equal.
    """
    learned, headings = track.learned, track.walls[HEADING]
    series = (1.0 + learned[EXITS]) / (6.0 + learned[EXITS] + learned[STAYS])
    for d in range(n):
        turned = abs(headings[n] - headings[n - 1 - d])
        end[0, d] = series
        end[1, d] = ROUND_END
        full[d] = math.inf
        if turned > TURN_TOLERANCE:
            full[d] = (d + 1) * max(1.0, FULL_TURN / turned - 1.001)


@compiled
def _log_repeat(track: Track, n: int, period: int, sigma: float) -> float:
    """Return the log density of wall n given the earlier readings of the same wall.

    The marginal of m readings is E = integral of prod N(l_i; L, sigma L) dL / L; with
    u = 1 / L it is a moment of a Gaussian in u, exact but for u < 0.
    """
    squares = lengths = 0.0
    m = 0
    for i in range(n - period, -1, -period):
        squares += track.walls[LENGTH, i] ** 2
        lengths += track.walls[LENGTH, i]
        m += 1
    earlier = _log_marginal(m, squares, lengths, sigma)
    newest = track.walls[LENGTH, n]
    later = _log_marginal(m + 1, squares + newest**2, lengths + newest, sigma)
    return float(later - earlier)


@compiled
def _log_marginal(m: int, squares: float, lengths: float, sigma: float) -> float:
    """Return log E for m readings with the given sums of squares and of lengths."""
    tau = sigma * sigma * squares / (lengths * lengths)
    last, moment = 1.0, 1.0  # E[(u / mean)^j] for j = 0, 1
    for j in range(2, m):
        last, moment = moment, moment + (j - 1) * tau * last
    off = max(m - lengths * lengths / squares, 0.0)
    return float(
        (1 - m) * math.log(ROOT_TWO_PI * sigma)
        - 0.5 * math.log(squares)
        + (m - 1) * math.log(lengths / squares)
        + math.log(moment)
        - 0.5 * off / (sigma * sigma)
    )


@compiled
def _extend_candidates(track: Track, n: int, drawn: Floats) -> None:
    """Take wall n into every candidate; those that cannot be any more are dropped."""
    missed, outlier = track.rule[MISSEEN], track.rule[OUTLIER]
    kept = 0
    for c in range(track.state[LIVE]):
        k = track.period[c]
        same = track.walls[SYMBOL, n + 1] == track.walls[SYMBOL, n + 1 - k]
        turned = track.walls[HEADING, n + 1] - track.walls[HEADING, n + 1 - k]
        if abs(abs(turned) - FULL_TURN) > TURN_TOLERANCE:
            if track.state[ACCEPTED] == k:
                track.state[ACCEPTED] = 0
            continue
        best = -math.inf
        for g in range(SCALES):
            fits = math.exp(_log_repeat(track, n, k, _sigma(track, g)))
            fits = (1.0 - outlier) * fits + outlier * drawn[g]
            fits *= 1.0 - missed if same else missed
            track.weight[kept, g] = track.weight[c, g] + math.log(fits)
            best = max(best, track.weight[kept, g] - track.scale[EVIDENCE, g])
        if best > -25.0:
            track.period[kept] = k
            kept += 1
        elif track.state[ACCEPTED] == k:
            track.state[ACCEPTED] = 0
    track.state[LIVE] = kept


@compiled
def _learn(track: Track, n: int) -> None:
    """Let the world's lengths and corners be known by wall n."""
    learned, log_length = track.learned, track.walls[LOG, n]
    off = log_length - learned[LOG_MEAN]
    learned[LOG_MEAN] += off / (n + 1)
    learned[LOG_SQUARES] += off * (log_length - learned[LOG_MEAN])
    before, now = int(track.walls[SYMBOL, n]), int(track.walls[SYMBOL, n + 1])
    track.follows[before, now] += 1.0
    learned[WOUND] = max(learned[WOUND], abs(track.walls[HEADING, n + 1]))


@compiled
def _open_candidate(track: Track, k: int) -> None:
    """Open the candidate "the loop has k walls", if v_k may be v_0."""
    turned = abs(track.walls[HEADING, k] - track.walls[HEADING, 0])
    if (
        abs(turned - FULL_TURN) > TURN_TOLERANCE
        or track.walls[SYMBOL, k] != track.walls[SYMBOL, 0]
    ):
        return
    around = _displacement(track, k, k)
    if _closure(around, _sigma(track, SCALES - 1))[1] > 25.0:
        return
    c = track.state[LIVE]
    if c == CANDIDATES:
        c = 0
        for other in range(1, CANDIDATES):
            if track.weight[other, POSTERIOR] < track.weight[c, POSTERIOR]:
                c = other
    else:
        track.state[LIVE] = c + 1
    track.period[c] = k
    for g in range(SCALES):
        track.weight[c, g] = track.scale[EVIDENCE, g] + math.log(track.rule[HAZARD])


@compiled
def _displacement(track: Track, n: int, k: int) -> tuple[float, ...]:
    """Return the way around k walls, its covariance over sigma^2, and its spread.

    Walls count with the mean of their readings. Before the covariance is taken,
    walls are scaled so that those that lead right and left, or up and down, agree:
    an error makes its own wall longer, and with it the variance that would excuse it.
    """
    right = left = up = down = 0.0
    rr = ll = uu = dd = 0.0
    cross = 0.0
    sxx = syy = 0.0
    for i in range(k):
        total = side = 0.0
        m = 0
        for j in range(i, n, k):
            total += track.walls[LENGTH, j]
            side += track.walls[SHIFT, j]
            m += 1
        mean, side = total / m, side / m
        c, s = math.cos(track.walls[HEADING, i]), math.sin(track.walls[HEADING, i])
        x, y = mean * c, mean * s
        if x > 0:
            right += x
            rr += x * x / m
        else:
            left -= x
            ll += x * x / m
        if y > 0:
            up += y
            uu += y * y / m
        else:
            down -= y
            dd += y * y / m
        cross += x * y / m
        sxx += x * x
        syy += y * y
        right -= side * s
        up += side * c
    dx, dy = right - left, up - down
    if right > 0 and left > 0:
        middle = 0.5 * (right + left)
        rr, ll = rr * (middle / right) ** 2, ll * (middle / left) ** 2
    if up > 0 and down > 0:
        middle = 0.5 * (up + down)
        uu, dd = uu * (middle / up) ** 2, dd * (middle / down) ** 2
    tiny = 1e-18 * (sxx + syy)
    return dx, dy, rr + ll + tiny, cross, uu + dd + tiny, sxx + tiny, syy + tiny


@compiled
def _closure(around: tuple[float, ...], sigma: float) -> tuple[float, float]:
    """Return the log gain from the way around being 0, and its squared deviation.

    `around` is what `_displacement` returns.
    """
    dx, dy, xx, xy, yy, sxx, syy = around
    det = xx * yy - xy * xy
    if det <= 0.0:
        xy, det = 0.0, xx * yy
    z2 = (dx * dx * yy - 2 * dx * dy * xy + dy * dy * xx) / det / (sigma * sigma)
    closed = 0.95 * math.exp(-0.5 * z2) + 0.05 / 9.0 * math.exp(-z2 / 18.0)
    log_closed = math.log(closed + 1e-300) - 0.5 * math.log(det) - 2 * math.log(sigma)
    far2 = dx * dx / sxx + dy * dy / syy
    # Open, v_k may lie anywhere in the world, or just beside v_0.
    apart = 0.9 * math.exp(-0.5 * far2) + 0.1 * 64.0 * math.exp(-32.0 * far2)
    return log_closed + 0.5 * math.log(sxx * syy) - math.log(apart + 1e-300), z2


@compiled
def _weigh(track: Track, n: int) -> None:
    """Compute the posterior of every candidate, and of every sigma."""
    live = track.state[LIVE]
    joint = np.empty((live + 1, SCALES))
    top = -math.inf
    for c in range(live + 1):
        odds = 0.0
        if c < live:
            around = _displacement(track, n, track.period[c])
            if n >= 2 * track.period[c]:
                odds = math.log(LAP_ODDS)
        for g in range(SCALES):
            if c < live:
                gain = _closure(around, _sigma(track, g))[0]
                joint[c, g] = track.scale[PRIOR, g] + track.weight[c, g] + gain + odds
            else:
                joint[c, g] = track.scale[PRIOR, g] + track.scale[EVIDENCE, g]
            top = max(top, joint[c, g])
    total = 0.0
    for g in range(SCALES):
        track.scale[BELIEF, g] = 0.0
    for c in range(live + 1):
        own = 0.0
        for g in range(SCALES):
            part = math.exp(joint[c, g] - top)
            own += part
            track.scale[BELIEF, g] += part
        if c < live:
            track.weight[c, POSTERIOR] = own
        total += own
    for c in range(live):
        track.weight[c, POSTERIOR] /= total
    for g in range(SCALES):
        track.scale[BELIEF, g] /= total


@compiled
def _accept(track: Track, n: int) -> int:
    """Return the period accepted, or 0; what was accepted may be given up."""
    best = -1
    for c in range(track.state[LIVE]):
        if best < 0 or track.weight[c, POSTERIOR] > track.weight[best, POSTERIOR]:
            best = c
        if (
            track.period[c] == track.state[ACCEPTED]
            and track.weight[c, POSTERIOR] < 0.5
        ):
            track.state[ACCEPTED] = 0
    track.state[GUARDED] = 0
    if best >= 0 and track.state[ACCEPTED] == 0:
        k = track.period[best]
        left = track.rule[EPSILON] - (1.0 - track.weight[best, POSTERIOR])
        if left > 0.0:
            needed = 0
            if not _certain(track, n, k):
                needed = max(_guard(track, n, k), _disputed(track, n, k))
            if track.rule[SLIP] * k > left:
                # As many walls may be met once as a slip there is likely enough not.
                needed = max(needed, k - int(left / track.rule[SLIP]))
            if n - k >= needed:
                track.state[ACCEPTED] = k
            else:
                track.state[GUARDED] = needed
    return int(track.state[ACCEPTED])


@compiled
def _guard(track: Track, n: int, k: int) -> int:
    """Return how many walls after v_k have to repeat before k may be accepted.

    The longest run of walls that starts at v_0 and is met again elsewhere on the
    loop proves nothing; nor does one more of what may be a series of such runs.
    """
    sigma = 0.0
    for g in range(SCALES):
        sigma += track.scale[BELIEF, g] * _sigma(track, g)
    needed = k if track.rule[FULL_LAP] > 0 else 0
    for d in range(1, k):
        if track.walls[SYMBOL, d] != track.walls[SYMBOL, 0]:
            continue
        run = 0
        off = 0.0
        turned = abs(track.walls[HEADING, d] - track.walls[HEADING, 0])
        end = n if abs(turned - FULL_TURN) < TURN_TOLERANCE else k
        while (
            run + d < end
            and track.walls[SYMBOL, run + 1] == track.walls[SYMBOL, run + 1 + d]
        ):
            a, b = track.walls[LENGTH, run], track.walls[LENGTH, run + d]
            off += (a - b) ** 2 / (sigma * sigma * (a * a + b * b))
            if off > run + 11.0 + 4.0 * math.sqrt(2.0 * run + 2.0):
                break
            run += 1
        if run < 3:
            continue
        if turned < TURN_TOLERANCE and run >= d:
            needed = max(needed, run + 2 * d)
        elif turned < TURN_TOLERANCE and 2 * run >= d:
            needed = max(needed, min(run + d + 2, k))
        else:
            needed = max(needed, min(run + 2 + run // 4, k))
    return needed


@compiled
def _disputed(track: Track, n: int, k: int) -> int:
    """Return how many walls after v_k have to repeat to settle what corners are.

    A corner that was seen in two ways is met again until one of them has won.
    """
    symbols = track.walls[SYMBOL]
    counts = np.zeros(KINDS, dtype=np.int64)
    needed = 0
    for i in range(min(k, n + 1 - k)):
        counts[:] = 0
        last = i
        for j in range(i, n + 1, k):
            counts[int(symbols[j])] += 1
            last = j
        most = counts.max()
        if (counts == most).sum() > 1:
            needed = max(needed, last)
    return needed


@compiled
def _certain(track: Track, n: int, k: int) -> bool:
    """Return whether v_k is so surely within r* of v_0 that it must be v_0."""
    dx, dy, xx, _, yy, _, _ = _displacement(track, n, k)
    sigma = _sigma(track, SCALES - 1)
    reach = 4.0 * sigma * math.sqrt(xx + yy)
    return bool(math.hypot(dx, dy) + reach < track.rule[R_STAR])
