"""The overlays that are kept are the heaviest set that agrees, found by all subsets."""

import itertools
import math

import numpy as np
import pytest

from merge.consistency import Overlay, most_consistent
from merge.rigid import RigidTransform

LINE = np.array([(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)])


def fleet(seed, maps=5, links=9, wrong=2):
    """Return overlays of maps of one place, some of them wrong, surest first."""
    rng = np.random.default_rng(seed)
    pose = [
        RigidTransform(*rng.uniform((-3, -30, -30), (3, 30, 30))) for _ in range(maps)
    ]
    couples = list(itertools.combinations(range(maps), 2))
    chosen = rng.choice(len(couples), links, replace=False)
    bad = set(rng.choice(links, wrong, replace=False).tolist())
    found = []
    for k, (a, b) in enumerate(couples[c] for c in chosen):
        move = pose[a].inverse().after(pose[b])
        if k in bad:
            move = RigidTransform(*rng.uniform((-3, -40, -40), (3, 40, 40)))
        found.append((Overlay(a, b, move, float(rng.uniform(7, 20))), k in bad))
    found.sort(key=lambda one: -one[0].weight)
    return [one for one, _ in found], {k for k, (_, bad_) in enumerate(found) if bad_}


def agrees(overlays):
    """Tell whether poses exist that all overlays ask for."""
    pose, todo = {}, list(overlays)
    while todo:
        known = [o for o in todo if o.a in pose or o.b in pose]
        if not known:
            pose[todo[0].a] = RigidTransform()
            continue
        for one in known:
            todo.remove(one)
            if one.a in pose and one.b in pose:
                off = pose[one.a].after(one.move)(LINE) - pose[one.b](LINE)
                if math.sqrt((off**2).sum(axis=1).mean()) > 0.5:
                    return False
            elif one.a in pose:
                pose[one.b] = pose[one.a].after(one.move)
            else:
                pose[one.a] = pose[one.b].after(one.move.inverse())
    return True


def heaviest(overlays):
    return max(
        sum(overlays[k].weight for k in some)
        for size in range(len(overlays) + 1)
        for some in itertools.combinations(range(len(overlays)), size)
        if agrees([overlays[k] for k in some])
    )


@pytest.mark.parametrize("seed", range(30))
def test_kept_overlays_are_the_heaviest_of_all_subsets_that_agree(seed):
    overlays, _ = fleet(seed, wrong=1 + seed % 3)
    kept = most_consistent(overlays, [LINE] * 5, slack=0.5)
    chosen = [overlays[k] for k in sorted(kept)]
    assert agrees(chosen)
    assert sum(o.weight for o in chosen) == pytest.approx(heaviest(overlays))


def test_the_surest_overlay_goes_where_many_others_contradict_it():
    alone = 0
    for seed in range(20):
        overlays, bad = fleet(seed, maps=7, links=18, wrong=3)
        kept = most_consistent(overlays, [LINE] * 7, slack=0.5)
        assert kept == set(range(18)) - bad
        alone += 0 in bad
    assert alone > 0


def test_where_too_many_disagree_the_kept_still_agree(monkeypatch):
    monkeypatch.setattr("merge.consistency.TRIALS", 3)
    for seed in range(10):
        overlays, _ = fleet(seed, wrong=4)
        kept = most_consistent(overlays, [LINE] * 5, slack=0.5)
        assert kept
        assert agrees([overlays[k] for k in kept])
