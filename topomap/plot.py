"""Pictures for scripts and notebooks: each function draws into an `ax` and returns it.

They are matplotlib axes, to be arranged, labelled and saved as any others:

>>> import numpy as np, worlds
>>> from matplotlib.figure import Figure
>>> from topomap import build_map, plot
>>> room = worlds.make("l", np.random.default_rng(1))
>>> build = build_map(room, np.random.default_rng(7), sigma=0.05)
>>> left, right = Figure().subplots(1, 2)
>>> plot.draw_build(build, room, left) is left
True
>>> plot.draw_belief(build.walk, right).get_xlabel()
'walls walked'
"""

from topomap.build_drawing import draw_belief, draw_build, draw_recognitions
from topomap.drawing import draw_world
from topomap.map_drawing import draw_map
from topomap.merge_drawing import draw_overlay

__all__ = [
    "draw_belief",
    "draw_build",
    "draw_map",
    "draw_overlay",
    "draw_recognitions",
    "draw_world",
]
