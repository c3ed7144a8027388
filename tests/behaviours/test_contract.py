"""The checker of bodies accepts a good body and names what is wrong with a bad one."""

from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

from behaviours.contract import ContractError, Failure, check_body
from behaviours.parameters import Parameters
from behaviours.port import Follow, Primitive, Reason
from behaviours.situations import situations
from worlds.ideal import IdealBody
from worlds.pose import Pose
from worlds.world import make_world


class Altered(IdealBody):
    """A body whose outcomes are altered before they are told."""

    def __init__(self, ring, x, y, heading, alter):
        world, rng = make_world(ring), np.random.default_rng(0)
        super().__init__(world, Pose(x, y, heading), Parameters(), rng)
        self.alter = alter

    def execute(self, primitive):
        return self.alter(self, primitive, super().execute(primitive))


def check_altered(alter, **options):
    check_body(lambda *place: Altered(*place, alter), **options)


def unaltered(_body, _primitive, outcome):
    return outcome


def test_the_ideal_body_keeps_the_contract():
    check_altered(unaltered)


def test_it_keeps_it_with_other_parameters():
    lengths = Parameters(r0=0.07, r_min=0.05, r_max=0.11, r_w=0.055)

    def make_body(ring, x, y, heading):
        world, rng = make_world(ring), np.random.default_rng(0)
        return IdealBody(world, Pose(x, y, heading), lengths, rng)

    check_body(make_body, lengths)


def farther(_body, primitive, outcome):
    is_follow = isinstance(primitive, Follow)
    return replace(outcome, distance=outcome.distance + 0.05 * is_follow)


def mistaken(_body, _primitive, outcome):
    return replace(outcome, reason=Reason.DONE)


def wrong_way(_body, _primitive, outcome):
    return replace(outcome, shift=-outcome.shift)


def short_sighted(_body, _primitive, outcome):
    return replace(outcome, readings=replace(outcome.readings, front=0.1))


def colliding(body, _primitive, outcome):
    body.collisions = 3
    return outcome


def time_travelling(body, _primitive, outcome):
    body.clock = -1.0
    return outcome


@pytest.mark.parametrize(
    ("alter", "what"),
    [
        (farther, "distance"),
        (mistaken, "reason"),
        (wrong_way, "shift"),
        (short_sighted, "front"),
        (colliding, "collisions"),
        (time_travelling, "clock and travelled"),
    ],
)
def test_a_bad_body_is_told_what_is_wrong(alter, what):
    with pytest.raises(ContractError) as refusal:
        check_altered(alter)
    assert {failure.what for failure in refusal.value.failures} == {what}


def test_a_difference_within_the_tolerance_is_accepted():
    check_altered(farther, tolerance=0.06)


def test_a_body_with_other_parameters_is_told_so():
    with pytest.raises(
        ContractError, match="parameters: expected Parameters"
    ) as refusal:
        check_altered(unaltered, parameters=Parameters(r0=0.31))
    assert {failure.what for failure in refusal.value.failures} == {"parameters"}


def test_the_error_names_every_failure_on_a_line():
    failures = (Failure("a", "b", "c", "d"), Failure("e", "f", "g", "h"))
    assert str(ContractError(failures)) == (
        "2 answers break the contract of the robot port:\n"
        "a: b: expected c; got d\n"
        "e: f: expected g; got h"
    )


@pytest.mark.parametrize("tolerance", [-0.1, float("nan")])
def test_a_tolerance_that_is_none_is_refused(tolerance):
    with pytest.raises(ValueError, match="tolerance must be at least 0"):
        check_altered(farther, tolerance=tolerance)


def test_situations_have_names_of_their_own_and_use_all_that_a_body_does():
    known = situations(Parameters())
    assert len({situation.name for situation in known}) == len(known)
    steps = [step for situation in known for step in situation.steps]
    assert {type(step.primitive) for step in steps} == set(get_args(Primitive))
    reasons = {step.reason for step in steps}
    assert reasons == set(Reason) - {Reason.BUMPED, Reason.STUCK}
