"""A merge as a recording: apart, laid over, matched, one."""

import math

import numpy as np
import pytest

from tests.page.runs import merge_run
from topomap.merging import merge_maps
from topomap.page import recording_of_merge


def box(track, state):
    places = [state.placement(v.position) for v in state.map.vertices]
    return np.min(places, axis=0), np.max(places, axis=0)


def test_at_first_the_maps_lie_apart():
    _, run = merge_run()
    (low_a, high_a), (low_b, _) = (box(t, t.states[0]) for t in run.maps[:2])
    assert high_a[0] < low_b[0]
    assert low_a[1] == pytest.approx(low_b[1])


def test_then_matched_vertices_lie_on_each_other():
    found, run = merge_run()
    assert found.accepted
    assert len(run.matches) == found.matched_vertices
    for match in run.matches:
        ends = []
        for chart, vertex in (
            (match.map_a, match.vertex_a),
            (match.map_b, match.vertex_b),
        ):
            state = run.maps[chart].states[-1]
            (place,) = [v.position for v in state.map.vertices if v.id == vertex]
            ends.append(state.placement(place))
        assert math.dist(*ends) < 1.5  # lengths of some ten metres, known to 4 %


def test_at_last_there_is_one_map():
    found, run = merge_run()
    *apart, merged = run.maps
    assert merged.states[0].map == found.map
    assert {track.until for track in apart} == {merged.states[0].time}


def test_a_refused_merge_keeps_the_maps_and_shows_its_best_overlay():
    _, run = merge_run()
    charts = [track.states[0].map for track in run.maps[:2]]
    refused = merge_maps([charts[0], merge_run(5)[1].maps[1].states[0].map])
    assert not refused.accepted
    other = merge_run(5)[1].maps[1].states[0].map
    shown = recording_of_merge(refused, [charts[0], other])
    assert len(shown.maps) == 2
    assert all(track.until == math.inf for track in shown.maps)
    assert ("verdict", "refused") in shown.facts
    assert refused.reason in shown.messages[-1].text


def test_a_map_that_fits_no_other_stays_apart():
    _, run = merge_run()
    charts = [track.states[0].map for track in run.maps[:2]]
    stranger = merge_run(5)[1].maps[1].states[0].map
    three = merge_maps([*charts, stranger])
    shown = recording_of_merge(three, [*charts, stranger])
    assert [len(track.states) for track in shown.maps] == [2, 2, 1]
    assert {(m.map_a, m.map_b) for m in shown.matches} <= {(0, 1), (1, 0)}


def test_names_are_numbers_unless_given():
    _, run = merge_run()
    charts = [track.states[0].map for track in run.maps[:2]]
    shown = recording_of_merge(merge_maps(charts), charts)
    assert [track.name for track in shown.maps] == ["map 1", "map 2", "merged"]
