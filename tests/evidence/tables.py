"""Measure how often each rule closes loops rightly, and print a Markdown table.

    python -m tests.evidence.tables                      # every class of worlds
    python -m tests.evidence.tables --classes medium --told 0.5 0.7 1.5 2
    python -m tests.evidence.tables --classes medium --noise tails drift slips
    python -m tests.evidence.tables --classes spiral --epsilon 0.1   # is it honest?
    python -m tests.evidence.tables --readings           # the published rule's text

Each world is walked from random starts; both rules see the same walks.
"""

import argparse
import math

import numpy as np

from evidence.dempster_shafer import PublishedRule, Readings
from evidence.likelihood import LikelihoodRule
from evidence.likelihood_trials import likelihood_trials
from evidence.phi import Freedom, Variance
from evidence.published_trials import published_trials
from topomap.experiments.shapes import CLASSES
from topomap.experiments.walking import deviations, laps_for, slipped, walks
from topomap.experiments.wilson import wilson_interval

READINGS = {
    "default: newest and previous, model's variance, n degrees, gate 99.9 %": {},
    "literal gate of 95 %": {"alpha": 0.95},
    "all readings of the wall": {"readings": Readings.ALL},
    "variance of the fused length": {"variance": Variance.FUSED},
    "n - 1 degrees of freedom": {"freedom": Freedom.LESS_ONE},
    "r* as (3.1) prints it": {"r_star": math.hypot(0.3, 0.15)},
}


def measure(name, sigma, args, told=1.0, noise="model"):
    """Return one row: counts for both rules over all worlds of a class."""
    rng = np.random.default_rng([args.seed, *name.encode()])
    noises = np.random.default_rng([args.seed, round(1e4 * sigma), *noise.encode()])
    rule = LikelihoodRule(full_lap=args.full_lap, epsilon=args.epsilon, slip=args.slip)
    counts = np.zeros((2, 3), dtype=int)  # rule by right, wrong, undecided
    silent, extra, stated = 0, [], []
    for _ in range(args.worlds):
        shape = CLASSES[name](rng)
        corners = len(shape[0])
        laps = laps_for(corners)
        runs = args.runs // args.worlds
        starts = noises.integers(corners, size=runs)
        errors = deviations(noise, sigma, (runs, corners * laps), corners, noises)
        walk = walks(shape, starts, laps, errors)
        if noise == "slips":
            rows, firsts = zip(
                *(slipped(row, args.rate, noises) for row in zip(*walk, strict=True)),
                strict=True,
            )
            walk = [np.array(column) for column in zip(*rows, strict=True)]
        found = likelihood_trials(*walk, told * sigma, rule)
        published = published_trials(*walk, told * sigma, PublishedRule())
        for i, periods in enumerate((found[0], published[0])):
            counts[i] += [
                np.sum(periods == corners),
                np.sum((periods != corners) & (periods > 0)),
                np.sum(periods == 0),
            ]
        right = found[0] == corners
        if noise == "slips":
            # Right in number, but a corner of the first lap was seen wrong.
            silent += int(np.sum(right & (np.array(firsts) < corners)))
        extra.extend(found[1][right] / corners - 1)
        stated.extend(found[2][found[0] > 0])
    return counts, extra, stated, silent


def percent(hits, trials):
    """Return a rate with its 95 % interval, in per cent."""
    low, high = wilson_interval(int(hits), int(trials))
    return f"{100 * hits / trials:.2f} ({100 * low:.2f} to {100 * high:.2f})"


def print_readings(args):
    """Print the rates of the published rule for every reading of its text."""
    cells = {
        "small": (0.06, 0.08, 0.1, 0.12, 0.14),
        "spiral": (0.1, 0.12, 0.14, 0.16, 0.18, 0.2),
    }
    print("| reading | simple worlds, 6-14 %: right % | spirals, 10-20 %: right % |")
    print("| --- | --- | --- |")
    for label, options in READINGS.items():
        rule, rates = PublishedRule(**options), []
        for name, sigmas in cells.items():
            rng = np.random.default_rng([args.seed, *name.encode()])
            right = runs = 0
            for _ in range(args.worlds):
                shape = CLASSES[name](rng)
                corners, count = len(shape[0]), args.runs // args.worlds
                for sigma in sigmas:
                    starts = rng.integers(corners, size=count)
                    errors = sigma * rng.standard_normal((count, 8 * corners))
                    walk = walks(shape, starts, 8, errors)
                    periods, _ = published_trials(*walk, sigma, rule)
                    right += np.sum(periods == corners)
                    runs += count
            rates.append(percent(right, runs))
        print(f"| {label} | {rates[0]} | {rates[1]} |", flush=True)


def main():
    """Print the table that the options ask for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--classes", nargs="+", default=list(CLASSES))
    parser.add_argument("--sigma", nargs="+", type=float, default=[0.04, 0.1, 0.2])
    parser.add_argument("--told", nargs="+", type=float, default=[1.0])
    parser.add_argument("--noise", nargs="+", default=["model"])
    parser.add_argument("--rate", type=float, default=1 / 200)
    parser.add_argument("--worlds", type=int, default=100)
    parser.add_argument("--runs", type=int, default=10_000, help="per cell")
    parser.add_argument("--full-lap", action="store_true")
    parser.add_argument("--epsilon", type=float, default=1e-4)
    parser.add_argument("--slip", type=float, default=0.0)
    parser.add_argument("--readings", action="store_true")
    parser.add_argument("--seed", type=int, default=2026)
    args = parser.parse_args()
    if args.readings:
        print_readings(args)
        return
    print(
        "| worlds | noise | sigma | told | right % | wrong | undecided | extra laps "
        "| published: right % | wrong % | undecided % |"
    )
    print("| --- " * 11 + "|")
    for name in args.classes:
        for noise in args.noise:
            for sigma in args.sigma:
                for told in args.told:
                    counts, extra, _, silent = measure(name, sigma, args, told, noise)
                    (right, wrong, undecided), published = counts
                    runs = right + wrong + undecided
                    note = f" + {silent} with a corner seen wrong" if silent else ""
                    print(
                        f"| {name} | {noise} | {sigma:g} | x{told:g} "
                        f"| {percent(right, runs)} | {wrong}{note} of {runs} "
                        f"| {undecided} | {np.median(extra):.2f} "
                        f"| {percent(published[0], runs)} "
                        f"| {100 * published[1] / runs:.2f} "
                        f"| {100 * published[2] / runs:.2f} |",
                        flush=True,
                    )


if __name__ == "__main__":
    main()
