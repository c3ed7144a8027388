"""A page that replays a run: one file, for any browser, with nothing to install.

`Recording` says what can be shown; `save_page` writes it. A build, a merge, a
team or a map is made a recording by `record_build`, `recording_of_merge`,
`recording_of_team` and `recording_of_map`.
"""

from topomap.page.html import check_page, render_page, save_page
from topomap.page.of_build import BuildRecorder, record_build
from topomap.page.of_map import recording_of_map
from topomap.page.of_merge import recording_of_merge
from topomap.page.of_team import recording_of_team
from topomap.page.recording import Recording
from topomap.page.tracks import (
    Assignment,
    BeliefTrack,
    MapState,
    MapTrack,
    Message,
    RobotTrack,
    VertexMatch,
)

__all__ = [
    "Assignment",
    "BeliefTrack",
    "BuildRecorder",
    "MapState",
    "MapTrack",
    "Message",
    "Recording",
    "RobotTrack",
    "VertexMatch",
    "check_page",
    "record_build",
    "recording_of_map",
    "recording_of_merge",
    "recording_of_team",
    "render_page",
    "save_page",
]
