#!/usr/bin/env python3
"""Reads a topic of a running set from Python: how punctual is a process? Five of its pulses, one each 0.2 s.

    pip install iceoryx2==0.10.0
    tools/launch                                 (in another terminal)
    examples/read_topic.py [RUN DIRECTORY]       without one, the newest run is read

A message is plain memory. What is stated here - type name, fields, their order and types - must be what
shared/messages/src/{header,pulse}.rs says; iceoryx2 refuses what differs in name, size or alignment.
tools/watch-layer.py reads the field frames in the same manner.
"""

import ctypes
import sys
import tempfile
import time
from pathlib import Path

LAYOUT = 15  # coact_messages::LAYOUT; the first number of every message
PROCESS = "control"


class Header(ctypes.Structure):
    """What every message begins with; times are ns of CLOCK_MONOTONIC."""

    _fields_ = [
        ("layout", ctypes.c_uint32),
        ("generation", ctypes.c_uint32),
        ("sequence", ctypes.c_uint64),
        ("cycle", ctypes.c_uint64),
        ("sensor_ns", ctypes.c_uint64),
        ("published_ns", ctypes.c_uint64),
        ("reserved", ctypes.c_uint64),
    ]


class Pulse(ctypes.Structure):
    """Heartbeat and measurement of one cycle of a process."""

    _fields_ = [
        ("header", Header),
        ("released_ns", ctypes.c_uint64),
        ("scheduled_ns", ctypes.c_uint64),
        ("started_ns", ctypes.c_uint64),
        ("input_published_ns", ctypes.c_uint64),
        ("input_received_ns", ctypes.c_uint64),
        ("missed", ctypes.c_uint64),
        ("stale", ctypes.c_uint64),
        ("skipped", ctypes.c_uint64),
        ("refused", ctypes.c_uint32 * 10),
        ("refused_topic", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
    ]

    @staticmethod
    def type_name():
        return "coact::Pulse"


def newest_run():
    bases = ("/dev/shm", tempfile.gettempdir())
    found = [file for base in bases for file in Path(base).glob("coact_*/run.json")]
    if not found:
        sys.exit("no set is running; start tools/launch in another terminal")
    return max(found, key=lambda file: file.stat().st_mtime).parent


def newest(subscriber):
    """A copy of the newest message, or None when nothing has come since the last look."""
    message = None
    while (sample := subscriber.receive()) is not None:
        message = Pulse.from_buffer_copy(sample.payload().contents)
        sample.delete()
    return message


def main():
    try:
        import iceoryx2 as iox2
    except ImportError:
        sys.exit("the Python package iceoryx2 is missing: pip install iceoryx2==0.10.0")
    iox2.set_log_level(iox2.LogLevel.Error)
    run = Path(sys.argv[1]) if len(sys.argv) > 1 else newest_run()
    # Root directory and prefix keep the topics of this run apart from those of others.
    config = iox2.config.from_file(iox2.FilePath.new(str(run / "config" / "iceoryx2.toml")))
    node = iox2.NodeBuilder.new().config(config).create(iox2.ServiceType.Ipc)
    name = iox2.ServiceName.new(f"coact/pulse/{PROCESS}")
    service = node.service_builder(name).publish_subscribe(Pulse).open()
    try:
        subscriber = service.subscriber_builder().create()
    except iox2.SubscriberCreateError as error:
        sys.exit(f"coact/pulse/{PROCESS}: {error}; four viewers may read a topic at once: end another one first")
    for _ in range(5):
        until = time.monotonic() + 2.0
        while (pulse := newest(subscriber)) is None:
            if time.monotonic() > until:
                sys.exit(f"{run}: {PROCESS} sends no pulses (any more)")
            time.sleep(0.001)
        if pulse.header.layout != LAYOUT:
            sys.exit(f"messages have layout {pulse.header.layout}; this program reads layout {LAYOUT}")
        started, published = (
            (at - pulse.released_ns) / 1000 for at in (pulse.started_ns, pulse.header.published_ns)
        )
        print(
            f"cycle {pulse.header.cycle:8}  started {started:6.1f} µs after its release, "
            f"published at {published:6.1f} µs; {pulse.missed} deadlines missed so far"
        )
        time.sleep(0.2)


if __name__ == "__main__":
    main()
