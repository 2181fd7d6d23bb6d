"""Fields that the tests share."""

import os

import numpy as np

#: Whether the library was built with sanitizers, so that everything is slower.
SANITIZED = "libasan" in os.environ.get("LD_PRELOAD", "")


def ball_distance(points, centre=(12.3, 9.1, 10.4), radius=6.2):
    return np.linalg.norm(np.asarray(points) - centre, axis=-1) - radius


def smooth_ball(nx=24, ny=19, nz=21):
    """A field without symmetry, [k, j, i]: a ball with a ramp one cell wide."""
    k, j, i = np.indices((nz, ny, nx))
    distance = ball_distance(np.stack([i + 0.5, j + 0.5, k + 0.5], axis=-1))
    return np.clip(0.5 - distance, 0.0, 1.0)


def same_bits(one, other):
    return one.points.tobytes() == other.points.tobytes() and (
        one.faces.tobytes() == other.faces.tobytes()
    )
