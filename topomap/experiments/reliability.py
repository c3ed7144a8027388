"""Whether what a rule states of its errors is true: stated against seen."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING

from topomap.experiments.wilson import wilson_interval

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from topomap.experiments.experiment import Experiment, Tallies

__all__ = ["fill_reliability"]

LEAST = 1e-6
"""Where both axes begin."""


def fill_reliability(
    figure: Figure, experiment: Experiment, cells: Mapping[int, Tallies]
) -> None:
    """Draw the share of wrong closures over the error that was stated.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    experiment : Experiment
        Its cells differ in ``epsilon``; each other condition makes a line.
    cells : mapping of int to tallies
        With ``wrong``, ``undecided``, ``trials`` and ``stated_error``, the sum of what
        was stated of each closure.

    Notes
    -----
    Both axes are logarithmic; on the diagonal a rule is as often wrong as it says. Bars
    are 95 % Wilson intervals; a triangle is the upper end where no closure was wrong.
    """
    figure.set_size_inches(7, 5)
    ax = figure.subplots()
    lines = defaultdict(list)
    for cell, tallies in cells.items():
        decided = tallies["trials"] - tallies.get("undecided", 0.0)
        if decided:
            rest = {k: v for k, v in experiment.cells[cell].items() if k != "epsilon"}
            label = ", ".join(
                f"{v:g}" if k == "sigma" else str(v) for k, v in rest.items()
            )
            wrong = tallies.get("wrong", 0.0)
            lines[label].append((tallies["stated_error"] / decided, wrong, decided))
    ax.plot([LEAST, 1], [LEAST, 1], color="#888888", lw=1, label="as stated")
    for label, points in lines.items():
        seen = [(x, wrong / n) for x, wrong, n in points if wrong]
        (line,) = ax.plot(*zip(*seen, strict=True) if seen else ((), ()), "o-", ms=4)
        line.set_label(label)
        for x, wrong, n in points:
            low, high = wilson_interval(wrong, n)
            if wrong:
                ax.vlines(x, low, high, color=line.get_color(), alpha=0.5)
            else:
                ax.plot(x, high, "v", color=line.get_color(), mfc="none", ms=5)
    ax.set(xscale="log", yscale="log", xlim=(LEAST, 1), ylim=(LEAST, 1))
    ax.set_xlabel("mean error stated of the closures")
    ax.set_ylabel("closures that were wrong, share")
    ax.set_title(experiment.question, fontsize=9)
    ax.grid(alpha=0.3)
    ax.legend(fontsize=7, loc="upper left")
