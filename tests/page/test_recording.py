"""A recording is checked when made: each fault names its field."""

import math
from dataclasses import replace

import numpy as np
import pytest

from merge.rigid import RigidTransform
from tests.page.runs import build_run, grid_map, merge_run, team_run
from topomap.errors import InputError
from topomap.page import (
    Assignment,
    BeliefTrack,
    MapState,
    MapTrack,
    Message,
    Recording,
    RobotTrack,
    VertexMatch,
)

TIMES = np.array([0.0, 1.0])
POSES = np.zeros((2, 3))
ROBOT = RobotTrack("r", TIMES, POSES)
CHART = MapTrack("m", (MapState(0.0, grid_map(2)),))
HALVES = np.array([0.5, 0.5])
BELIEF = BeliefTrack("b", TIMES, HALVES, HALVES, np.array([False, True]))


def robot(**changes):
    return {"robots": (replace(ROBOT, **changes),)}


def state(**changes):
    return {"maps": (MapTrack("m", (replace(CHART.states[0], **changes),)),)}


def belief(**changes):
    return {"hypotheses": (replace(BELIEF, **changes),)}


def match(*fields):
    return {"maps": (CHART, CHART), "matches": (VertexMatch(*fields),)}


FAULTS = [
    ({"walls": (((0, 0), (1, 0)),)}, "walls[0]: expected at least 3 corners"),
    ({"walls": (((0, 0), (1, 0), (1, math.nan)),)}, "walls[0]: expected at least 3"),
    (robot(times=np.array([])), "robots[0].times: expected at least one time"),
    (robot(times=np.zeros((2, 1))), "robots[0].times: expected at least one time"),
    (robot(times=np.array([1.0, 0.5])), "robots[0].times[1]: expected a time not bef"),
    (robot(times=np.array([0, math.inf])), "robots[0].times[1]: expected a finite ti"),
    (robot(poses=np.zeros((3, 3))), "robots[0].poses: expected shape (2, 3); got (3"),
    (robot(poses=POSES + math.nan), "robots[0].poses: expected finite numbers only"),
    (robot(rangers=np.zeros((2, 2))), "robots[0].rangers: expected shape (2, 3)"),
    (robot(ranges=np.zeros((2, 1))), "robots[0].ranges: expected shape (2, 0)"),
    (
        robot(rangers=np.zeros((1, 3)), ranges=np.array([[1.0], [math.nan]])),
        "robots[0].ranges: expected ranges of 0 and more, or infinity",
    ),
    ({"maps": (MapTrack("m", ()),)}, "maps[0].states: expected at least one; got 0"),
    (
        {"maps": (replace(CHART, until=math.nan),)},
        "maps[0].until: expected a time, or infinity",
    ),
    (state(time=math.nan), "maps[0].states[0]: expected a finite time"),
    (state(glide=-1.0), "maps[0].states[0].glide: expected a time, not negative"),
    (
        state(placement=RigidTransform(math.nan)),
        "maps[0].states[0].placement: expected finite numbers",
    ),
    (belief(times=np.array([2.0, 1.0])), "hypotheses[0].times[1]: expected a time"),
    (belief(belief=np.zeros(3)), "hypotheses[0].belief: expected shape (2,)"),
    (
        belief(plausibility=HALVES * 3),
        "hypotheses[0].plausibility: expected probabilities from 0 to 1",
    ),
    (belief(accepted=np.array([True])), "hypotheses[0].accepted: expected shape (2,)"),
    (match(math.nan, 0, 0, 1, 0), "matches[0].time: expected a finite time"),
    (match(0.0, 2, 0, 1, 0), "matches[0].map_a: expected the number of a map, below 2"),
    (match(0.0, 0, 0, -1, 0), "matches[0].map_b: expected the number of a map, below"),
    (match(0.0, 0, 9, 1, 0), "matches[0].vertex_a: expected a vertex of map 0; got 9"),
    (match(0.0, 0, 0, 1, 7), "matches[0].vertex_b: expected a vertex of map 1; got 7"),
    (
        {"assignments": (Assignment(0.0, 0, None),)},
        "assignments[0].robot: expected the number of a robot, below 0; got 0",
    ),
    (
        {"robots": (ROBOT,), "assignments": (Assignment(0.0, 0, (0.0, math.inf)),)},
        "assignments[0].target: expected finite metres",
    ),
    (
        {"messages": (Message(1.0, ""), Message(0.0, ""))},
        "messages[1]: expected a time not before 1; got 0.0",
    ),
    (
        {"messages": (Message(0.0, "", sender=0),)},
        "messages[0].sender: expected the number of a robot, below 0",
    ),
    (
        {"robots": (ROBOT,), "messages": (Message(0.0, "", 0, 1),)},
        "messages[0].receiver: expected the number of a robot, below 1; got 1",
    ),
]


@pytest.mark.parametrize(("parts", "said"), FAULTS)
def test_a_fault_names_its_field(parts, said):
    with pytest.raises(InputError) as caught:
        Recording(**parts)
    assert str(caught.value).startswith(f"recording: {said}")


@pytest.mark.parametrize(
    "run", [Recording(), team_run(), merge_run()[1], build_run()[1]]
)
def test_what_is_right_is_taken(run):
    assert math.isfinite(run.end)


def test_the_end_is_when_the_last_thing_happens():
    parts = {
        "robots": (ROBOT,),
        "maps": (CHART,),
        "hypotheses": (replace(BELIEF, times=TIMES + 1),),
    }
    assert Recording(**parts).end == 2.0
    assert Recording(**parts, messages=(Message(7.0, ""),)).end == 7.0
    assert Recording(**parts, assignments=(Assignment(6.0, 0, None),)).end == 6.0
    assert Recording(maps=(replace(CHART, until=9.0),)).end == 9.0
    assert Recording(maps=(CHART,)).end == 0.0
    matches = (VertexMatch(3.0, 0, 0, 0, 1),)
    assert Recording(maps=(CHART,), matches=matches).end == 3.0
