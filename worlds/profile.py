"""What a robot is made of: its size, wheels and infrared rangers."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace

from behaviours.parameters import Parameters

__all__ = ["Profile", "ProfileError", "Ranger", "looks_along"]


class ProfileError(ValueError):
    """A robot that cannot be built, or that cannot keep its parameters.

    Examples
    --------
    >>> str(ProfileError("generic", "radius", 0.2, "a length below r_min = 0.15"))
    'profile generic: radius: expected a length below r_min = 0.15; got 0.2'
    """

    def __init__(self, name: str, field: str, value: object, expected: str) -> None:
        super().__init__(f"profile {name}: {field}: expected {expected}; got {value!r}")
        self.field = field
        """The field at fault, such as ``rangers[2].far``."""


@dataclass(frozen=True, slots=True)
class Ranger:
    """An infrared ranger: where it sits, what it sees, how well.

    It answers the harmonic mean over its rays, as the spot of light on its strip
    does. A target nearer than `near` is seen at `near`; one beyond `far` is not
    seen.
    """

    x: float
    """Mount ahead of the robot's centre, in metres."""
    y: float
    """Mount to the left of the centre line, in metres."""
    yaw: float
    """Axis of the beam, in radians counter-clockwise from straight ahead."""
    near: float = 0.10
    """Least range, in metres from the mount."""
    far: float = 0.80
    """Greatest range, in metres from the mount."""
    cone: float = math.radians(3)
    """Half angle of the beam, in radians."""
    rays: int = 3
    """How many rays are spread evenly over the beam, the edges included."""
    noise: float = 0.001
    """Standard deviation of a reading at range 0, in metres."""
    noise_growth: float = 0.05
    """What it grows by, in metres per squared metre of range."""


@dataclass(frozen=True, slots=True)
class Profile:
    """A robot with two driven wheels and rangers; checked when made.

    Raises
    ------
    ProfileError
        If a figure is not finite or out of its range, the body does not fit
        into r_min, or no ranger looks ahead, left or right as far as r_max
        (ahead: r0), measured from the centre.

    Examples
    --------
    A body of 16 cm cannot keep walls 15 cm from its centre:

    >>> from worlds.profiles import GENERIC
    >>> replace(GENERIC, radius=0.16)
    Traceback (most recent call last):
        ...
    worlds.profile.ProfileError: profile generic: radius: expected a length \
below r_min = 0.15; got 0.16
    """

    name: str
    parameters: Parameters
    """The lengths that this robot keeps unless it is told others."""
    rangers: tuple[Ranger, ...]
    radius: float = 0.07
    """Of the round body, in metres."""
    wheel_base: float = 0.12
    """Between the wheels, in metres."""
    mass: float = 1.0
    """In kilograms."""
    speed: float = 0.2
    """Going straight, in metres a second."""
    turn_rate: float = 1.5
    """Turning on the spot, in radians a second."""
    acceleration: float = 1.5
    """Most that the wheels give, in metres a second squared."""
    update_period: float = 0.0383
    """Between two readings of the rangers, in seconds."""
    encoder_noise: float = 0.01
    """Relative standard deviation of a wheel's count over one time step."""
    slip: float = 0.02
    """Relative standard deviation of a wheel's grip over one time step."""
    drift: float = 0.01
    """Standard deviation of the unseen bend of a leg, in radians a metre."""
    turn_error: float = 0.02
    """Standard deviation of a turn by 90 degrees, in radians."""

    def __post_init__(self) -> None:
        self._check_figures("", self)
        for k, ranger in enumerate(self.rangers):
            self._check_figures(f"rangers[{k}].", ranger)
            if not ranger.near < ranger.far:
                self._refuse(f"rangers[{k}].far", ranger.far, "a range above `near`")
            if ranger.rays < 1:
                self._refuse(f"rangers[{k}].rays", ranger.rays, "at least 1 ray")
            if math.hypot(ranger.x, ranger.y) > self.parameters.r_min:
                where = (ranger.x, ranger.y)
                self._refuse(f"rangers[{k}]", where, "a mount within r_min")
        if self.radius >= self.parameters.r_min:
            limit = f"a length below r_min = {self.parameters.r_min}"
            self._refuse("radius", self.radius, limit)
        self._check_reach()

    def _check_figures(self, prefix: str, part: object) -> None:
        """Refuse figures that are not finite, or negative where none may be."""
        free = {"x", "y", "yaw"}
        zero = {"noise", "noise_growth", "cone", "near"}
        zero |= {"encoder_noise", "slip", "drift", "turn_error"}
        for field in fields(part):  # type: ignore[arg-type]
            value = getattr(part, field.name)
            if not isinstance(value, (int, float)):
                continue
            if not math.isfinite(value):
                self._refuse(prefix + field.name, value, "a finite number")
            if field.name in zero and value < 0:
                self._refuse(prefix + field.name, value, "a number of at least 0")
            if field.name not in free | zero and value <= 0:
                self._refuse(prefix + field.name, value, "a number above 0")

    def _check_reach(self) -> None:
        """Refuse rangers that cannot see what the parameters ask for."""
        lengths = self.parameters
        for side, yaw, reach in (
            ("ahead", 0.0, lengths.r0),
            ("left", math.pi / 2, lengths.r_max),
            ("right", -math.pi / 2, lengths.r_max),
        ):
            if not any(
                looks_along(ranger, yaw)
                and ranger.x * math.cos(yaw) + ranger.y * math.sin(yaw) + ranger.far
                > reach
                for ranger in self.rangers
            ):
                expected = f"one that looks {side} beyond {reach} m from the centre"
                self._refuse("rangers", len(self.rangers), expected)

    def _refuse(self, field: str, value: object, expected: str) -> None:
        raise ProfileError(self.name, field, value, expected)

    def without_noise(self) -> Profile:
        """Return the same robot with exact sensors, wheels and turns."""
        exact = tuple(replace(r, noise=0.0, noise_growth=0.0) for r in self.rangers)
        return replace(
            self, rangers=exact, encoder_noise=0.0, slip=0.0, drift=0.0, turn_error=0.0
        )


def looks_along(ranger: Ranger, yaw: float) -> bool:
    """Return whether a ranger looks in a direction, within 17 degrees of it."""
    return math.cos(ranger.yaw - yaw) > 0.95
