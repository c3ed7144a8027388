"""The rooms may only lean on the rooms below them, and never in a circle."""

import ast
from pathlib import Path

import networkx as nx
import pytest

ROOT = Path(__file__).parents[1]

MAY_IMPORT = {
    "evidence": {"numpy", "scipy", "numba"},
    "merge": {"numpy", "scipy", "networkx", "numba"},
    "behaviours": set(),
    "worlds": {
        *("behaviours", "numpy", "scipy", "numba"),
        *("pymunk", "shapely", "PIL", "yaml"),
    },
    "topomap": {
        *("behaviours", "evidence", "merge", "worlds"),
        *("numpy", "scipy", "networkx", "numba", "shapely"),
        *("msgspec", "matplotlib", "typer", "rich", "PIL", "yaml", "distributed"),
        *("mcap", "rosbags", "lz4", "zstandard"),
    },
}
STANDARD = __import__("sys").stdlib_module_names


def imported_modules(path):
    """Return the full names of all that a file imports, wherever it does so."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            names.add(node.module)
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def files_of(room):
    return sorted((ROOT / room).rglob("*.py"))


@pytest.mark.parametrize("room", MAY_IMPORT)
def test_room_leans_only_on_what_it_may(room):
    for path in files_of(room):
        heads = {name.partition(".")[0] for name in imported_modules(path)}
        assert heads - STANDARD - {room} <= MAY_IMPORT[room], path


def test_no_cycle_between_files():
    modules = {
        ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(
            ".__init__"
        ): path
        for room in MAY_IMPORT
        for path in files_of(room)
    }
    graph = nx.DiGraph(
        (name, other)
        for name, path in modules.items()
        for other in imported_modules(path) & modules.keys()
    )
    assert list(nx.simple_cycles(graph)) == []
