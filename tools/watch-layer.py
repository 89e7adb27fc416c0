#!/usr/bin/env python3
"""Watches a layer of the neural-field network of a running process set: live bars in the terminal, or a picture.

    pip install iceoryx2==0.10.0            (and matplotlib, for --png)
    tools/launch                            (in another terminal)
    tools/watch-layer.py                    lists the layers
    tools/watch-layer.py AEL                live bars, until Ctrl-C
    tools/watch-layer.py AEL --png ael.png  a picture of the newest frame
    tools/watch-layer.py destination        where on the table the person's hand is going (--png as well)
    tools/watch-layer.py grip               in which grip it takes, or holds, a part (--png as well)

It is also an example of a client in another language. What such a client needs to know:

  * A run keeps its topics apart from other runs' by a root directory and a prefix. Both stand in the run
    directory's config/iceoryx2.toml, which Python loads with `config.from_file`. The command line of iceoryx2
    (cargo install iceoryx2-cli) finds the same file when it is started there:

        cd /dev/shm/coact_<id> && iox2 service list
        cd /dev/shm/coact_<id> && iox2 service details coact/fields
        cd /dev/shm/coact_<id> && iox2 service hz coact/fields

  * A message is plain memory, laid out as `repr(C)`: the structures below have the fields of
    shared/messages/src/{header,field_frame}.rs, in their order and with their types. iceoryx2 compares type
    name ("coact::FieldFrame"), size and alignment, and refuses what differs; LAYOUT, the first number of every
    message, is raised when a field changes its meaning.

  * A reader only looks: it never writes into a message, and it may be slow or die; no process waits for it.
    A topic has room for 8 readers.
"""

import argparse
import ctypes
import json
import math
import sys
import tempfile
import time
from pathlib import Path

LAYOUT = 15
MAX_LAYERS, MAX_POPULATIONS, MAX_SITES, MAX_PLACES, MAX_GRIP_SITES = 16, 1216, 12160, 4096, 1024
NONE = 0xFFFF_FFFF
DESTINATION, GRIP = "destination", "grip"
LAYERS = ["AOL", "OML-robot", "OML-person", "CSGL-achieved", "CSGL-available", "ASL", "IL", "EML", "AEL"]

EXAMPLES = """Examples:
  tools/watch-layer.py                    the layers, their sizes and their peaks
  tools/watch-layer.py AEL                live bars, until Ctrl-C
  tools/watch-layer.py AEL --png ael.png  a picture of the newest frame
  tools/watch-layer.py destination        where on the table the person's hand is going (--png as well)
  tools/watch-layer.py grip               in which grip it takes, or holds, a part (--png as well)

Needs: pip install iceoryx2==0.10.0 (and matplotlib, for --png)"""


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


class LayerTable(ctypes.Structure):
    """Where each layer's sites and populations stand in the rows of a frame."""

    _fields_ = [
        ("count", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("kind", ctypes.c_uint32 * MAX_LAYERS),
        ("first_site", ctypes.c_uint32 * MAX_LAYERS),
        ("sites", ctypes.c_uint32 * MAX_LAYERS),
        ("first_population", ctypes.c_uint32 * MAX_LAYERS),
        ("populations", ctypes.c_uint32 * MAX_LAYERS),
    ]


class Decision(ctypes.Structure):
    """What the robot has decided to do: index of the action, and the cycle at which its peak crossed threshold."""

    _fields_ = [("action", ctypes.c_uint32), ("reserved", ctypes.c_uint32), ("since", ctypes.c_uint64)]


class SiteGrid(ctypes.Structure):
    """Where the sites of a field of two dimensions lie: row after row along the first axis, the sites of a row along the second."""

    _fields_ = [("first", ctypes.c_double * 2), ("spacing", ctypes.c_double * 2), ("sites", ctypes.c_uint32 * 2)]


class FieldFrame(ctypes.Structure):
    """The whole network at one tick."""

    _fields_ = [
        ("header", Header),
        ("task", ctypes.c_uint64),
        ("noise_seed", ctypes.c_uint64),
        ("layers", LayerTable),
        ("table", SiteGrid),
        ("shapes", SiteGrid),
        ("decision", Decision),
        ("activity", ctypes.c_double * MAX_SITES),
        ("input", ctypes.c_double * MAX_SITES),
        ("resting", ctypes.c_double * MAX_POPULATIONS),
        ("signal", ctypes.c_double * MAX_POPULATIONS),
        ("since", ctypes.c_uint64 * MAX_POPULATIONS),
        ("destination", ctypes.c_double * MAX_PLACES),
        ("grip", ctypes.c_double * MAX_GRIP_SITES),
        ("checksum", ctypes.c_uint64),
    ]

    @staticmethod
    def type_name():
        return "coact::FieldFrame"


def find_run(name):
    """The run directory of that name or path, or the newest one."""
    if name and Path(name).is_dir():
        return Path(name)
    pattern = f"coact_{name}/run.json" if name else "coact_*/run.json"
    found = [file for base in ("/dev/shm", tempfile.gettempdir()) for file in Path(base).glob(pattern)]
    if not found:
        sys.exit(f"{f'there is no run {name}' if name else 'no process set is running'}; start one with tools/launch")
    return max(found, key=lambda file: file.stat().st_mtime).parent


def subscribe(run):
    """A reader of the run's field frames. The node must live as long as the reader does."""
    try:
        import iceoryx2 as iox2
    except ImportError:
        sys.exit("the Python package iceoryx2 is missing: pip install iceoryx2==0.10.0")
    iox2.set_log_level(iox2.LogLevel.Error)
    try:
        config = iox2.config.from_file(iox2.FilePath.new(str(run / "config" / "iceoryx2.toml")))
        node = iox2.NodeBuilder.new().config(config).create(iox2.ServiceType.Ipc)
        name = iox2.ServiceName.new("coact/fields")
        service = node.service_builder(name).publish_subscribe(FieldFrame).open()
        return node, service.subscriber_builder().create()
    except Exception as error:  # the binding's errors have no common type
        sys.exit(f"{run}: the field frames cannot be read: {type(error).__name__} {error}")


def newest(subscriber, wait_s):
    """A copy of the newest frame, or None when nothing came in time."""
    until = time.monotonic() + wait_s
    frame = None
    while frame is None and time.monotonic() < until:
        sample = subscriber.receive()
        while sample is not None:
            frame = FieldFrame.from_buffer_copy(sample.payload().contents)
            sample.delete()
            sample = subscriber.receive()
        if frame is None:
            time.sleep(0.002)
    if frame is not None and frame.header.layout != LAYOUT:
        sys.exit(f"the messages have layout {frame.header.layout}; this program reads layout {LAYOUT}")
    return frame


def layers(frame):
    """For each layer: name, its sites and its populations as ranges."""
    table = frame.layers
    for index in range(table.count):
        first_site, first = table.first_site[index], table.first_population[index]
        sites = range(first_site, first_site + table.sites[index])
        yield LAYERS[table.kind[index]], sites, range(first, first + table.populations[index])


def list_layers(frame):
    print(f"cycle {frame.header.cycle}, decision: {decision(frame)}")
    for name, sites, populations in layers(frame):
        peaks = [str(p - populations.start) for p in populations if frame.since[p]]
        print(f"{name:15} {len(sites):4} sites {len(populations):3} populations; peaks: {', '.join(peaks) or 'none'}")


def decision(frame):
    if frame.decision.action == NONE:
        return "none"
    return f"action {frame.decision.action} since cycle {frame.decision.since}"


def bars(frame, name, sites, populations):
    """One line for each population: its signal as a bar, and its highest activity."""
    width = len(sites) // max(len(populations), 1)
    lines = [f"{name}, cycle {frame.header.cycle}, decision: {decision(frame)}"]
    for index, population in enumerate(populations):
        own = range(sites.start + index * width, sites.start + (index + 1) * width)
        highest = max(frame.activity[site] for site in own)
        bar = "█" * round(40 * min(max(frame.signal[population], 0.0), 1.0))
        peak = f"peak since {frame.since[population]}" if frame.since[population] else ""
        lines.append(f"{index:4} u {highest:7.2f} {bar:40} {peak}")
    return lines


# Of each field that selects: its grid, its axes' names, and what their units are of those on the screen.
SELECTS = {
    DESTINATION: ("table", ("x [m]", "y [m]"), (1, 1)),
    GRIP: ("shapes", ("pitch [degrees]", "width [mm]"), (math.degrees(1), 1000)),
}


def rows(frame, field):
    """Activity of a field that selects, row after row along its first axis."""
    along_first, along_second = getattr(frame, SELECTS[field][0]).sites
    activity = getattr(frame, field)
    return [list(activity[row * along_second : (row + 1) * along_second]) for row in range(along_first)]


def selection(frame, field):
    """A field that selects: active sites in four shades."""
    shades = " ░▒▓█"
    _, (upwards, rightwards), _ = SELECTS[field]
    sites = rows(frame, field)
    least = min(min(row) for row in sites)
    shade = lambda u: shades[0 if u < least / 2 else 1 if u < least / 4 else 2 if u < 0 else 3 if u < -least / 2 else 4]
    lines = [f"{field} field, cycle {frame.header.cycle}; {upwards} grows upwards, {rightwards} to the right"]
    return lines + ["".join(shade(u) for u in row) for row in reversed(sites)]


def selection_picture(frame, field, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    grid, (upwards, rightwards), units = SELECTS[field]
    grid = getattr(frame, grid)
    spans = [
        (unit * first, unit * (first + (sites - 1) * spacing))
        for unit, first, spacing, sites in zip(units, grid.first, grid.spacing, grid.sites)
    ]
    figure, axes = pyplot.subplots(figsize=(6, 6))
    image = axes.imshow(
        rows(frame, field), origin="lower", extent=(*spans[1], *spans[0]), cmap="PuOr_r", vmin=-3, vmax=3, aspect="auto"
    )
    axes.set(title=f"{field} field, cycle {frame.header.cycle}", xlabel=rightwards, ylabel=upwards)
    figure.colorbar(image, label="activity u")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def picture(frame, name, sites, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(10, 4))
    places = range(len(sites))
    axes.axhline(0, color="gray", linewidth=0.8)
    axes.plot(places, [frame.input[site] for site in sites], label="input S", color="tab:orange", linewidth=1)
    axes.plot(places, [frame.activity[site] for site in sites], label="activity u", color="tab:blue")
    axes.set(title=f"{name}, cycle {frame.header.cycle}", xlabel="site", ylabel="activity")
    axes.legend(loc="upper right")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(
        description="Watch a layer of the neural-field network of a running process set.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    layers_and_fields = [*LAYERS, *SELECTS]
    names = f"one of {', '.join(layers_and_fields)}; without it, list them"
    parser.add_argument("layer", nargs="?", choices=layers_and_fields, metavar="LAYER", help=names)
    parser.add_argument("--run", help="id or directory of the run [default: the newest]")
    parser.add_argument("--png", metavar="FILE", help="write a picture of the newest frame instead")
    arguments = parser.parse_args()
    if arguments.png and not arguments.layer:
        parser.error("--png needs a LAYER")
    run = find_run(arguments.run)
    name = json.loads((run / "run.json").read_text())["id"]
    node, subscriber = subscribe(run)
    while (frame := newest(subscriber, wait_s=2.0)) is not None:
        chosen = {layer: (sites, populations) for layer, sites, populations in layers(frame)}
        if not arguments.layer:
            return list_layers(frame)
        clear = "\x1b[H\x1b[J" if sys.stdout.isatty() else ""
        if arguments.layer in SELECTS:
            if arguments.png:
                return selection_picture(frame, arguments.layer, arguments.png)
            print(clear + "\n".join(selection(frame, arguments.layer)), flush=True)
            time.sleep(0.1)
            continue
        if arguments.layer not in chosen:
            sys.exit(f"the network has no layer {arguments.layer}; it has {', '.join(chosen)}")
        sites, populations = chosen[arguments.layer]
        if arguments.png:
            return picture(frame, arguments.layer, sites, arguments.png)
        print(clear + "\n".join(bars(frame, arguments.layer, sites, populations)), flush=True)
        time.sleep(0.1)
    sys.exit(f"run {name} sends no field frames (any more)")


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:
        sys.stderr.close()
