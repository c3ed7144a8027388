"""Knowing the map is never slower than the bound, and exploring is never faster."""

import numpy as np
import pytest

from topomap.errors import InputError
from topomap.exploration import Settings, central_starts, explore_grid
from topomap.exploration.grid_worlds import maze
from topomap.exploration.hindsight import hindsight
from topomap.exploration.sight import visible_cells


@pytest.mark.parametrize("seed", range(4))
def test_nobody_is_faster_than_the_bound(seed):
    rng = np.random.default_rng(seed)
    free = maze(rng, 21, corridor=[1, 3][seed % 2])
    starts = central_starts(free, 1 + seed, rng)
    known = hindsight(free, starts, reach=5)
    assert 0 < known.least <= known.planned
    for name in ("minpos", "greedy"):
        assert explore_grid(free, starts, Settings(name, reach=5)).time >= known.least


def test_one_robot_in_a_dead_end_walks_there_and_no_further():
    free = np.zeros((3, 12), dtype=bool)
    free[1, 1:11] = True
    known = hindsight(free, [(1, 1)], reach=4)
    assert known.least == known.planned == 7
    assert explore_grid(free, [(1, 1)], Settings(reach=4)).time == 7


def test_places_show_all_and_the_second_robot_halves_the_way():
    hall = np.zeros((3, 43), dtype=bool)
    hall[1, 1:42] = True
    one = hindsight(hall, [(1, 20)], reach=3)
    two = hindsight(hall, [(1, 20), (1, 22)], reach=3)
    assert one.least == pytest.approx(two.least, abs=2)
    assert one.planned > 2.5 * two.planned
    assert two.planned == two.least


def test_what_is_in_sight_at_once_takes_no_time():
    room = np.pad(np.ones((3, 3), dtype=bool), 1)
    assert visible_cells(room, (2, 2), 4).all()
    known = hindsight(room, [(2, 2)], reach=4)
    assert (known.least, known.planned, known.places) == (0, 0.0, 0)


def test_places_in_other_regions_do_not_count():
    two = np.zeros((3, 12), dtype=bool)
    two[1, 1:5], two[1, 6:11] = True, True
    assert hindsight(two, [(1, 1)], reach=2).planned < 12


def test_a_robot_in_a_wall_is_refused():
    with pytest.raises(InputError, match=r"starts\[0\]: expected a free cell"):
        hindsight(np.eye(3), [(0, 1)])
