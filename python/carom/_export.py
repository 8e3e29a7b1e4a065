"""Frames for other programs: ASE, freud, GSD (HOOMD, OVITO), MDAnalysis. Each of these is imported when it is
needed."""

from __future__ import annotations

import errno
import os

import numpy as np

from . import _arguments
from ._carom import SceneError


def _velocities3d(frame) -> np.ndarray:
    return np.column_stack([frame.vx, frame.vy, np.zeros(len(frame))])


def _around_middle(frame) -> np.ndarray:
    """float32, as these programs use: coordinates from -half to half, without the upper end."""
    half = 0.5 * np.array([*frame.box, 0.0])
    points = (frame.positions3d() - half).astype(np.float32)
    for axis in range(2):  # rounding may put a coordinate exactly at the end
        column = points[:, axis]
        column[column >= np.float32(half[axis])] = np.nextafter(np.float32(half[axis]), np.float32(0.0))
    return points


def ase_atoms(frame):
    import ase

    atoms = ase.Atoms(numbers=np.zeros(len(frame), int), positions=frame.positions3d(), masses=frame.mass,
                      cell=[*frame.box, 0.0], pbc=[*frame.periodic, False])
    atoms.set_velocities(_velocities3d(frame))
    atoms.new_array("radius", frame.radius)
    atoms.new_array("id", frame.id.astype(np.int64))  # with unsigned numbers ASE cannot write a file
    atoms.info["Time"] = frame.t
    return atoms


def freud_system(frame) -> tuple:
    return np.array(frame.box, np.float32), _around_middle(frame)


def gsd_snapshot(frame):
    import gsd.hoomd

    # The class is called Frame since version 2.8.
    snapshot = getattr(gsd.hoomd, "Frame", getattr(gsd.hoomd, "Snapshot", None))()
    snapshot.configuration.step = 0
    snapshot.configuration.dimensions = 2
    snapshot.configuration.box = [*frame.box, 0, 0, 0, 0]
    particles = snapshot.particles
    particles.N = len(frame)
    particles.position = _around_middle(frame)
    particles.velocity = _velocities3d(frame)
    particles.diameter = 2.0 * frame.radius
    particles.mass = frame.mass
    if "image_x" in frame.names:
        particles.image = np.column_stack([frame.image_x, frame.image_y, np.zeros(len(frame), np.int32)])
    group = getattr(frame, "group", np.zeros(len(frame), int))
    particles.types = [f"group {k}" for k in range(int(group.max(initial=0)) + 1)]
    particles.typeid = group
    return snapshot


def write_gsd(path, frames, force) -> None:
    import gsd.hoomd

    path, force = _arguments.path(path), _arguments.flag(force, "force")
    if os.path.isfile(path) and not force:
        raise SceneError(f"{path}: exists already; choose another file, or replace it with force=True")
    if os.path.exists(path) and not os.path.isfile(path):  # a folder stays, and so does a device, which all programs share
        raise IsADirectoryError(errno.EISDIR, "is no file", path)
    # If writing fails the earlier file stays.
    place = os.path.realpath(path)
    beside = place + ".new"
    with open(beside, "wb"):  # says why the file cannot be written; gsd would report a bad file descriptor
        pass
    try:
        with gsd.hoomd.open(beside, "wb") as file:
            for number, frame in enumerate(frames):
                snapshot = gsd_snapshot(frame)
                snapshot.configuration.step = number
                file.append(snapshot)
        os.replace(beside, place)
    except BaseException:
        os.remove(beside)
        raise


def mdanalysis_universe(frames):
    import MDAnalysis

    from ._mdanalysis import FramesInMemory

    frames = list(frames)
    if not frames or any(not np.array_equal(f.id, frames[0].id) for f in frames):
        raise ValueError("MDAnalysis needs a frame at least, and the same disks in all of them")
    first = frames[0]
    universe = MDAnalysis.Universe.empty(len(first), trajectory=True, velocities=True)
    for name, column in (("mass", first.mass), ("radius", first.radius)):
        universe.add_TopologyAttr(name, column)
    boxes = [[*f.box, 1.0, 90.0, 90.0, 90.0] for f in frames]
    universe.load_new(np.array([f.positions3d() for f in frames]), format=FramesInMemory, order="fac",
                      dimensions=np.array(boxes), velocities=np.array([_velocities3d(f) for f in frames]),
                      dt=frames[1].t - first.t if len(frames) > 1 else 1.0, times=[f.t for f in frames])
    return universe
