#!/usr/bin/env python3
"""Plain I-VT (Salvucci and Goldberg 2000) in numpy, as pipelines for recorded gaze have it.

ivt.py FILE SECONDS: FILE holds directions, three float64 each, 1000 per second; they are repeated to
fill SECONDS. Prints what a sample costs, ns of processor time: of a whole recording at once, which looks
ahead and needs all of it, and of samples that come one by one, as in a headset; and how many saccades
either finds. 45 deg/s, velocities over five samples.
"""
import json
import sys
import time

import numpy as np

RATE_HZ = 1000.0
FASTER_DEG_PER_S = 45.0
ONLINE_SAMPLES = 20_000


def angles_deg(directions):
    return np.degrees(
        np.stack(
            [
                np.arctan2(directions[..., 0], -directions[..., 2]),
                np.arctan2(directions[..., 1], np.hypot(directions[..., 0], directions[..., 2])),
            ],
            axis=-1,
        )
    )


def whole(directions):
    """Begins and ends of saccades in all samples at once."""
    at = angles_deg(directions)
    velocity = np.zeros_like(at)
    velocity[2:-2] = (at[4:] + at[3:-1] - at[1:-3] - at[:-4]) * (RATE_HZ / 6.0)
    fast = np.hypot(velocity[:, 0], velocity[:, 1]) > FASTER_DEG_PER_S
    edges = np.flatnonzero(np.diff(fast.astype(np.int8)))
    return edges[::2], edges[1::2]


def online(directions):
    """The same of samples as they come: how many saccades."""
    last = np.zeros((5, 2))
    fast_before = False
    saccades = 0
    for direction in directions:
        last[:-1] = last[1:]
        last[-1] = angles_deg(direction)
        velocity = (last[4] + last[3] - last[1] - last[0]) * (RATE_HZ / 6.0)
        fast = np.hypot(velocity[0], velocity[1]) > FASTER_DEG_PER_S
        saccades += bool(fast and not fast_before)
        fast_before = fast
    return saccades


def main():
    ten_seconds = np.fromfile(sys.argv[1]).reshape(-1, 3)
    directions = np.tile(ten_seconds, (int(float(sys.argv[2]) * RATE_HZ) // len(ten_seconds), 1))
    begin = time.process_time()
    begins, _ = whole(directions)
    whole_s = time.process_time() - begin
    some = directions[:ONLINE_SAMPLES]
    begin = time.process_time()
    seen = online(some)
    online_s = time.process_time() - begin
    print(
        json.dumps(
            {
                "whole_ns": 1e9 * whole_s / len(directions),
                "whole_saccades": len(begins),
                "online_ns": 1e9 * online_s / len(some),
                "online_saccades": seen,
            }
        )
    )


main()
