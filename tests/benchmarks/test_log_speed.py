"""What a log costs, how large it is, and how fast a map is made again of it."""

import time

import numpy as np

import topomap
import worlds
from topomap.logs.building import build_logged
from topomap.logs.drive_maps import map_drive
from topomap.logs.drives import read_drive
from topomap.logs.replaying import read_recorded, replay_map


def seconds(function):
    begun = time.process_time()
    result = function()
    return result, time.process_time() - begun


def test_logging_against_not_logging(benchmark, tmp_path):
    world = worlds.make("random", np.random.default_rng(1), corners=8)
    log = tmp_path / "run.mcap"
    runs = []

    def both():
        for body in ("physical", "ideal"):
            rngs = [np.random.default_rng(7) for _ in range(2)]
            built, alone = seconds(
                lambda body=body, rng=rngs[0]: topomap.build_map(world, rng, body=body)
            )
            _, logged = seconds(
                lambda body=body, rng=rngs[1]: build_logged(world, rng, log, body=body)
            )
            minutes = built.simulated / 60
            size = log.stat().st_size / minutes
            runs.append((body, logged / alone, (logged - alone) / minutes, size))

    benchmark.pedantic(both, rounds=9, warmup_rounds=1)
    for body in ("physical", "ideal"):
        ratio, cost, size = np.median([r[1:] for r in runs if r[0] == body], axis=0)
        benchmark.extra_info[f"{body}: time with a log against without"] = float(ratio)
        benchmark.extra_info[f"{body}: ms a simulated minute"] = float(1e3 * cost)
        benchmark.extra_info[f"{body}: kB a simulated minute"] = float(size / 1e3)


def test_a_map_made_again_of_an_hour(benchmark, tmp_path):
    world = worlds.make("random", np.random.default_rng(3), corners=100)
    log = tmp_path / "run.mcap"
    options = {"body": "physical", "closing": "likelihood-full-lap"}
    built = build_logged(world, np.random.default_rng(3), log, **options)
    own, foreign = [], []

    def both():
        begun = time.perf_counter()
        again = replay_map(read_recorded(log)[0])
        own.append(built.simulated / (time.perf_counter() - begun))
        assert again.map == built.map
        begun = time.perf_counter()
        made = map_drive(read_drive(log))
        foreign.append(built.simulated / (time.perf_counter() - begun))
        assert made.closed

    benchmark.pedantic(both, rounds=5, warmup_rounds=1)
    benchmark.extra_info["simulated s"] = built.simulated
    benchmark.extra_info["MB"] = log.stat().st_size / 1e6
    benchmark.extra_info["our own log, times real time"] = float(np.median(own))
    benchmark.extra_info["ranges and odometry, times real time"] = float(
        np.median(foreign)
    )
