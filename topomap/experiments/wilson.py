"""How sure a measured share is."""

from __future__ import annotations

import math

__all__ = ["wilson_interval"]

Z_95 = 1.959963984540054
"""Standard deviations that hold 95 % of a normal."""


def wilson_interval(hits: float, trials: float, z: float = Z_95) -> tuple[float, float]:
    """Return the Wilson score interval of a share.

    Parameters
    ----------
    hits, trials : float
        How many of how many; ``0 <= hits <= trials`` and ``trials > 0``.
    z : float
        Half-width in standard deviations; 1.96 for 95 %.

    Returns
    -------
    (float, float)
        The least and the greatest share that agree with what was seen.

    Raises
    ------
    ValueError
        If the counts are impossible.

    References
    ----------
    .. [1] E. B. Wilson, "Probable inference, the law of succession, and
       statistical inference", JASA 22, 209-212, 1927.

    Examples
    --------
    1,000 correct maps of 1,000 leave room for four wrong ones in a thousand:

    >>> [round(bound, 4) for bound in wilson_interval(1000, 1000)]
    [0.9962, 1.0]
    """
    if not (trials > 0 and 0 <= hits <= trials):
        raise ValueError(f"need 0 <= hits <= trials, trials > 0; got {hits}, {trials}")
    share, spread = hits / trials, z * z / trials
    middle = (share + spread / 2) / (1 + spread)
    half = math.sqrt(share * (1 - share) * spread + spread * spread / 4) / (1 + spread)
    # Rounding must not part the ends from the shares that they bound.
    low = 0.0 if hits == 0 else max(0.0, middle - half)
    return low, 1.0 if hits == trials else min(1.0, middle + half)
