"""Which robots are known by name, and of what they are made.

Sources of the default figures. Sharp GP2Y0A21YK0F, data sheet E4-A00201EN:
10 to 80 cm, a new value every 38.3 ms; the output falls about as
27.9 V / (distance in cm)**1.15, so that 10 mV of noise on it are
0.05 r**2 metres at a range of r metres, half a centimetre at 30 cm. Its spot
is taken to be 6 degrees wide. e-puck: Mondada et al., "The e-puck, a robot designed
for education in engineering", 2009: 7 cm across, wheels 5.3 cm apart, eight
infrared proximity sensors. Calibrated wheel odometry of such robots errs by
a few per cent of the way and about 1 degree a metre (Borenstein and Feng,
"Measurement and correction of systematic odometry errors", 1996).
"""

from __future__ import annotations

import math
from dataclasses import replace

from behaviours.parameters import Parameters
from worlds.profile import Profile, Ranger

__all__ = ["EPUCK", "GENERIC", "GENERIC5", "PROFILES", "Profile", "Ranger"]

SHARP = Ranger(0.0, 0.0, 0.0)

GENERIC = Profile(
    "generic",
    Parameters(r0=0.3, r_min=0.15, r_max=0.5, r_w=0.2),
    (
        SHARP,
        replace(SHARP, x=0.1, yaw=math.pi / 2),
        replace(SHARP, x=0.1, yaw=-math.pi / 2),
    ),
)
"""A disc of 14 cm with three Sharp GP2Y0A21.

One looks ahead from the centre; two look sideways across a bracket 10 cm ahead
of it, so that each sees what juts into the way before the body touches it. A
wall ahead that covers the middle of the way is seen from 80 cm on; one that only
reaches over the rim of the way, r_min to either side, is seen when the bracket
is beside it, and the robot then backs off to r0. Nothing behind is seen, and a
post thinner than 3 cm may be passed unseen between two readings.
"""

GENERIC5 = replace(
    GENERIC,
    name="generic5",
    rangers=(
        *(replace(ranger, x=0.0) for ranger in GENERIC.rangers),
        replace(SHARP, x=0.0, y=0.0, yaw=math.atan2(0.14, 0.30), cone=math.radians(2)),
        replace(SHARP, x=0.0, y=0.0, yaw=-math.atan2(0.14, 0.30), cone=math.radians(2)),
    ),
)
"""The same with two rangers more, aimed at the edges of its way r0 ahead.

A wall that reaches 1 cm or more into the way is seen at r0. The side rangers sit
abeam of the centre, so that a wall's end is seen where it is, and the end of a
wall shorter than r0 can be looked for behind. Posts between the beams are seen
late or not at all.
"""


def _epuck_ring() -> tuple[Ranger, ...]:
    """Return the eight proximity sensors of the e-puck, front right to front left."""
    bearings = (-17, -49, -90, -151, 151, 90, 49, 17)
    return tuple(
        Ranger(
            *(0.032 * math.cos(math.radians(b)), 0.032 * math.sin(math.radians(b))),
            yaw=math.radians(b if abs(b) != 17 else 0),
            near=0.005,
            far=0.10,
            cone=math.radians(10),
            rays=3,
            noise=0.001,
            noise_growth=0.2,
        )
        for b in bearings
    )


EPUCK = Profile(
    "epuck",
    Parameters(r0=0.07, r_min=0.05, r_max=0.11, r_w=0.055),
    _epuck_ring(),
    radius=0.035,
    wheel_base=0.053,
    mass=0.2,
    speed=0.08,
    turn_rate=1.5,
    acceleration=0.3,
    update_period=0.04,
    drift=0.03,
)
"""An e-puck: a disc of 7 cm with a ring of eight proximity sensors.

The two in front are turned straight ahead. Their range of 10 cm from the rim is
that of calibrated use against white walls.
"""

PROFILES = {profile.name: profile for profile in (GENERIC, GENERIC5, EPUCK)}
"""The known robots by name."""
