#!/usr/bin/env python3
"""Builds in a wheel with the hand of a real person: plays recorded reaches, as lines for `coact hand`.

    coact launch --world kinematic --partner hand     # in one terminal
    python3 examples/hand.py | coact hand             # in another one; --help tells what can be chosen

Each line is a JSON array: x, y, z of the middle between thumb tip and index tip (m), the hand's pitch (degrees) and the distance of
the two tips (m). Any program that prints such lines, some 60 a second, moves the hand: a camera's tracker, a glove, a mouse.
"""

import argparse
import csv
import gzip
import json
import math
import statistics
import sys
import time
from pathlib import Path

DATA = Path(__file__).resolve().parent.parent / "data" / "reaches"
# Places of the toy vehicle's table (rt-config/tasks/toy-vehicle.toml), m.
REST = (-1.09, 0.22, 0.79)
WHEEL = (-0.98, 0.02, 0.8125)
SOCKET = (-0.7625, 0.30, 0.875)
# Fingers around the wheel: its width and their own thickness, m; and how far they open to let it go.
AROUND = 0.075 + 0.016
OPEN = AROUND + 0.035
FROM_ABOVE, AT_REST = -75.0, -20.0
FOREARM = 0.26  # m, of an adult: gives the recordings, which are images, their scale
FRAME = 1 / 60


def jerkless(t):
    """Fraction of a movement of minimum jerk after fraction t of its time."""
    t = min(max(t, 0.0), 1.0)
    return t**3 * (10 + t * (-15 + 6 * t))


def between(one, other, along):
    return tuple(a + along * (b - a) for a, b in zip(one, other))


def point(row, joint):
    """A joint of a frame, pixels; None where the detector lost it."""
    return (float(row[joint + ".x"]), float(row[joint + ".y"])) if float(row[joint + ".p"]) > 0 else None


def read(person, size):
    """The reaches of a person to cubes of a size: their frames, in the order of the file."""
    path = DATA / f"p{person}.csv.gz"
    if not path.is_file():
        sys.exit(f"{path}: not found; expected a person from 1 to 6")
    trials = {}
    with gzip.open(path, "rt") as file:
        for row in csv.DictReader(file):
            if row["size"] == size:
                trials.setdefault(row["trial"], []).append(row)
    return list(trials.values())


def scale(trials):
    """m per pixel, by the forearm before the hand sets out."""
    still = [row for rows in trials for row in rows if float(row["t_rel_onset_s"]) < 0]
    ends = [(point(row, "RElbow"), point(row, "RWrist")) for row in still]
    return FOREARM / statistics.median(math.dist(a, b) for a, b in ends if a and b)


def reach(rows, metres):
    """Time (s), fraction of the way and aperture (m) of each frame until the grasp; lost joints stay where they were."""
    wrist = thumb = index = None
    frames, end = [], float(rows[0]["mt_s"])
    for row in rows:
        wrist, thumb = point(row, "RWrist") or wrist, point(row, "RThumb4FingerTip") or thumb
        index = point(row, "RIndex4FingerTip") or index
        if float(row["t_rel_onset_s"]) <= end and wrist and thumb and index:
            frames.append((float(row["t_rel_onset_s"]), wrist, metres * math.dist(thumb, index)))
    first, last = frames[0][1], frames[-1][1]
    way = [b - a for a, b in zip(first, last)]
    covered = lambda at: sum((a - b) * c for a, b, c in zip(at, first, way)) / sum(c * c for c in way)
    # The person's fingers arrived at a cube; here they arrive around the wheel, open, whatever the image foreshortens.
    wider = OPEN - frames[-1][2]
    return [(when, covered(at), min(aperture + wider, 0.18)) for when, at, aperture in frames]


class Hand:
    """Prints where the hand is, at its time."""

    def __init__(self):
        self.at, self.pitch, self.aperture = REST, AT_REST, 0.03
        self.due = time.monotonic()

    def tell(self, after=FRAME):
        self.due += after
        time.sleep(max(0.0, self.due - time.monotonic()))
        print(json.dumps([round(x, 5) for x in (*self.at, self.pitch, self.aperture)]), flush=True)

    def go(self, to, pitch, aperture, duration, arch=0.0):
        begin = (self.at, self.pitch, self.aperture)
        for frame in range(1, round(duration / FRAME) + 1):
            along = jerkless(frame * FRAME / duration)
            x, y, z = between(begin[0], to, along)
            self.at = (x, y, z + arch * 16 * along**2 * (1 - along) ** 2)
            self.pitch = begin[1] + along * (pitch - begin[1])
            self.aperture = begin[2] + along * (aperture - begin[2])
            self.tell()

    def stay(self, duration):
        self.go(self.at, self.pitch, self.aperture, duration)

    def play(self, frames, to):
        """A recorded reach, from where the hand is to `to`: its time course, and its fingers."""
        begin, before = (self.at, self.pitch, self.aperture), frames[0][0]
        for number, (when, along, aperture) in enumerate(frames):
            self.at = between(begin[0], to, along)
            self.pitch = begin[1] + jerkless(along / 0.9) * (FROM_ABOVE - begin[1])
            # The recorded fingers take over within some frames.
            own = min(1.0, number / 12)
            self.aperture = begin[2] + own * (aperture - begin[2])
            self.tell(when - before)
            before = when


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--person", type=int, default=1, help="whose reach, 1 to 6 [1]")
    parser.add_argument("--trial", type=int, default=0, help="which of this person's reaches to the largest cube [0]")
    chosen = parser.parse_args()
    trials = read(chosen.person, "L")
    if not 0 <= chosen.trial < len(trials):
        sys.exit(f"--trial {chosen.trial}: this person has {len(trials)} such reaches; expected 0 to {len(trials) - 1}")
    hand = Hand()
    hand.stay(2.0)
    hand.play(reach(trials[chosen.trial], scale(trials)), WHEEL)
    # They close.
    hand.go(WHEEL, FROM_ABOVE, AROUND - 0.003, 0.15)
    hand.go(SOCKET, FROM_ABOVE, AROUND - 0.003, 0.9, arch=0.06)
    hand.stay(1.5)
    hand.go(SOCKET, FROM_ABOVE, OPEN, 0.2)
    # Over the parts that lie on the way.
    hand.go(REST, AT_REST, 0.03, 0.8, arch=0.12)
    hand.stay(2.0)


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:
        # `coact hand` has ended, and has said why.
        sys.stderr.close()
