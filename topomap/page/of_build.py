"""A build as a recording: what the robot did, saw, mapped and believed, and when."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from behaviours.follow_wall import Leg
from topomap.page.loops import HALLS, Loop, beliefs, corner_type, growth, whole
from topomap.page.motion import Motion, Placed, WatchedBody, ranges_along
from topomap.page.recording import Recording
from topomap.page.tracks import MapTrack, Message, RobotTrack
from worlds.profile import Ranger

if TYPE_CHECKING:
    from behaviours.port import Body
    from evidence.walls import Decision, LoopCloser, Wall
    from topomap.mapping import Build
    from worlds.profile import Profile
    from worlds.world import World

__all__ = ["BuildRecorder", "record_build"]

SIDES = 0.0, math.pi / 2, -math.pi / 2
"""Where a body looks whose rangers are not known: ahead, left, right."""


class BuildRecorder:
    """Looks on while a map is built, and tells after it what happened.

    Give `watch` to `topomap.build_map` as its `watch`, and the closer that `listen`
    returns as its `closing`; when it is done, ask for the `recording`.

    Parameters
    ----------
    world : World
        In which the map is built.
    sigma : float
        Of the lengths, as a part of them, as given to `build_map`.
    profile : Profile, optional
        Of a physical robot: its rangers' beams are shown, not three beams from the
        centre.
    """

    def __init__(
        self, world: World, sigma: float, profile: Profile | None = None
    ) -> None:
        self._world = world
        self._sigma = sigma
        self._profile = profile
        self._body: Any = None
        self._motion: Motion | None = None
        self._loops: list[Loop] = []

    def watch(self, body: Body) -> Body:
        """Begin to note where a body is; return what is to be used in its place.

        Raises
        ------
        ValueError
            If the body does not know where it is.
        """
        if not isinstance(body, Placed):
            raise ValueError(f"body: expected one with a pose; got {body!r}")
        self._body = body
        self._motion = Motion(body)
        arena = getattr(body, "arena", None)
        if arena is None:
            return WatchedBody(body, self._motion)
        self._motion.ride(arena)
        return body

    def listen(self, closer: LoopCloser) -> LoopCloser:
        """Return a closer that decides as this one does, and is listened to."""
        return _Heard(closer, self)

    def began(self, kind: str) -> None:
        """Note that a loop begins here, at its v_0."""
        self._loops.append(Loop(corner_type(kind), self._body.pose))

    def observed(self, wall: Wall, decision: Decision) -> None:
        """Note a wall that was walked, and what was made of it."""
        loop = self._loops[-1]
        loop.times.append(self._body.clock)
        loop.legs.append(
            Leg(corner_type(wall.kind), wall.length, wall.shift, clearance=math.inf)
        )
        loop.decisions.append(decision)

    def recording(self, built: Build) -> Recording:
        """Return what happened.

        Parameters
        ----------
        built : Build
            What came of it.

        Returns
        -------
        Recording
            Each map lies where the robot truly was at its v_0, so that the picture
            shows how its errors grow and how closing the loop spreads them. A map
            with halls is shown when it is done, where it fits the truth best.
        """
        loops = [loop for loop in self._loops if loop.legs]
        return Recording(
            title=self._world.name or "build",
            facts=_facts(built),
            walls=self._world.rings,
            robots=(self._track(),),
            maps=self._maps(loops, built),
            hypotheses=tuple(b for loop in loops for b in beliefs(loop)),
            messages=tuple(
                Message(time, decision.reason)
                for loop in loops
                for time, decision in zip(loop.times, loop.decisions, strict=True)
            ),
        )

    def _maps(self, loops: list[Loop], built: Build) -> tuple[MapTrack, ...]:
        """Return the map of each loop; of a single one, the last is what was built."""
        if any(vertex.type in HALLS for vertex in built.map.vertices):
            return (whole(built, self._body.clock),)
        tracks = [
            growth(f"map {k + 1}", loop, self._body.parameters, self._sigma)
            for k, loop in enumerate(loops)
        ]
        if len(tracks) == 1:
            *before, last = tracks[0].states
            states = (*before, replace(last, map=built.map))
            tracks = [MapTrack("map", states)]
        return tuple(tracks)

    def _track(self) -> RobotTrack:
        from worlds.sensors import ray_table

        if self._motion is None:
            raise ValueError("watch must be called before recording")
        times, poses = self._motion.samples()
        if self._profile is None:
            far = 2 * self._body.parameters.r_max
            rangers = tuple(Ranger(0.0, 0.0, yaw, far=far, rays=1) for yaw in SIDES)
        else:
            rangers = self._profile.rangers
        return RobotTrack(
            "robot",
            times,
            poses,
            radius=self._profile.radius if self._profile else 0.07,
            rangers=np.array([(r.x, r.y, r.yaw) for r in rangers]),
            ranges=ranges_along(self._world, poses, ray_table(rangers)),
        )


class _Heard:
    """A loop closer that tells a recorder what it is told and what it decides."""

    def __init__(self, closer: LoopCloser, recorder: BuildRecorder) -> None:
        self._closer = closer
        self._recorder = recorder

    def begin(self, kind: str, turn: float) -> None:
        """Pass on v_0."""
        self._closer.begin(kind, turn)
        self._recorder.began(kind)

    def observe(self, wall: Wall) -> Decision:
        """Pass on a wall, and note what was made of it."""
        decision = self._closer.observe(wall)
        self._recorder.observed(wall, decision)
        return decision


def record_build(
    world: World,
    rng: np.random.Generator,
    *,
    body: str = "ideal",
    sigma: float = 0.06,
    closing: str = "likelihood",
    **options: Any,
) -> tuple[Build, Recording]:
    """Let a robot map a world, as `topomap.build_map` does, and record it.

    Parameters
    ----------
    world : World
        As for `build_map`.
    rng : numpy.random.Generator
        The build is the same, bit for bit, as without the recording.
    body : str
        A name, as for `build_map`.
    sigma : float
        As for `build_map`.
    closing : str
        A name, as for `build_map`.
    **options
        Whatever else `build_map` takes.

    Returns
    -------
    build : Build
        What came of it.
    recording : Recording
        How it came about.

    Examples
    --------
    >>> import worlds
    >>> room = worlds.make("l", np.random.default_rng(1))
    >>> built, run = record_build(room, np.random.default_rng(7), sigma=0.05)
    >>> built.correct, len(run.maps[0].states[-1].map.vertices)
    (True, 6)
    """
    from topomap.bodies import body_parameters, body_profile, body_slip
    from topomap.closers import make_closer
    from topomap.mapping import build_map

    recorder = BuildRecorder(world, sigma, body_profile(body))
    parameters = options.get("parameters") or body_parameters(body)
    closer = make_closer(closing, sigma, parameters, slip=body_slip(body))
    built = build_map(
        world,
        rng,
        body=body,
        sigma=sigma,
        closing=recorder.listen(closer),
        watch=recorder.watch,
        **options,
    )
    return built, recorder.recording(built)


def _facts(built: Build) -> tuple[tuple[str, str], ...]:
    rmse = built.comparison.position_rmse
    verdict = "correct" if built.correct else "not correct"
    facts = [
        ("verdict", verdict if built.closed else "not closed"),
        ("vertices", str(len(built.map.vertices))),
        ("way", f"{built.travelled:.1f} m"),
        ("walls walked", str(built.walls)),
        ("hypotheses", str(built.hypotheses)),
        ("collisions", str(built.collisions)),
    ]
    if rmse is not None:
        facts.append(("position error", f"{rmse:.2f} m"))
    return tuple(facts)
