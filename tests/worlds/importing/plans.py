"""Small floor plans, as files."""

from pathlib import Path

__all__ = ["write_plan"]


def write_plan(path: Path, rooms, doors=(), scale=1.0, head="") -> Path:
    """Write rooms (corners in metres, y up) and doors (points) as a plan."""
    spaces = []
    for k, room in enumerate(rooms):
        outline = "".join(_point(corner, scale) for corner in room)
        portals = "" if k else "".join(_portal(door, scale) for door in doors)
        spaces.append(
            f"<space><bounding_polygon>{outline}</bounding_polygon>"
            f"<space_representation>{portals}</space_representation></space>"
        )
    path.write_text(
        f"{head}<building><scale>"
        "<represented_distance><value>10</value></represented_distance>"
        f"<real_distance><value>{1000 * scale:g}</value></real_distance></scale>"
        f"<floor><spaces>{''.join(spaces)}</spaces></floor></building>"
    )
    return path


def _point(corner, scale):
    return f'<point x="{corner[0] / scale:g}" y="{-corner[1] / scale:g}"/>'


def _portal(door, scale):
    point = _point(door, scale)
    return f"<linesegment>{point}{point}<class>PORTAL</class></linesegment>"
