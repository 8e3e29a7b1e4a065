"""Disks as numpy columns: copies, frames, and views of the engine's memory."""

from typing import Any, Mapping, NamedTuple, Tuple

import numpy as np

from . import _export


class Disks:
    """Disks as columns, numpy arrays of shape (n,): x, y (length), vx, vy (length / time), radius, mass, id; and spin
    (1 / time, counter-clockwise) if they are rough."""

    x: np.ndarray
    y: np.ndarray
    vx: np.ndarray
    vy: np.ndarray
    radius: np.ndarray
    mass: np.ndarray
    id: np.ndarray
    spin: np.ndarray
    t: float  # simulated time
    names: Tuple[str, ...]  # names of the columns that exist

    def __init__(self, columns: Mapping[str, np.ndarray], t: float):
        self.__dict__.update(columns)
        self.t = t
        self.names = tuple(columns)

    def __len__(self):
        return len(self.x)

    def positions3d(self) -> np.ndarray:
        """Centres as float64 of shape (n, 3), z = 0, for freud, ASE and MDAnalysis."""
        return np.column_stack([self.x, self.y, np.zeros(len(self))])

    def __repr__(self):
        return f"<{len(self)} disks at t = {self.t:g}: {', '.join(self.names)}>"


class Frame(Disks):
    """Disks in order of id, and the box. group, if there are several: the [[disks]] table, counted from 0; for disks
    from sources and from Simulation.add the number of tables. Frames of a trajectory may have image_x and image_y: the
    rounds across periodic sides since the first frame. The unwrapped position of a disk is x + image_x * box[0].

    to_ase, to_freud and to_gsd convert a frame for these programs.
    """

    box: Tuple[float, float]  # length
    periodic: Tuple[bool, bool]
    group: np.ndarray
    image_x: np.ndarray
    image_y: np.ndarray

    def __init__(self, t, width, height, periodic_x, periodic_y, columns):
        super().__init__(columns, t)
        self.box = (width, height)
        self.periodic = (periodic_x, periodic_y)

    def to_ase(self) -> Any:
        """An ase.Atoms object: positions (z = 0), masses, velocities, periodic sides; radius and id as arrays of these
        names."""
        return _export.ase_atoms(self)

    def to_freud(self) -> tuple:
        """(box, points) for freud.*.compute: two lengths, and float32 of shape (n, 3) relative to the middle of the
        box. freud takes all sides as periodic, unless its box says otherwise."""
        return _export.freud_system(self)

    def to_gsd(self) -> Any:
        """A snapshot of gsd.hoomd, two-dimensional and relative to the middle of the box, with diameters, masses and
        images (for frames of a trajectory with a periodic side); HOOMD, freud and OVITO accept it. Its step is 0, as
        GSD has no times."""
        return _export.gsd_snapshot(self)


class Hit(NamedTuple):
    """The first object on a ray: the disk's id, the distance along the ray to its edge, and the point there (length).
    what: "disk", or for an inner wall "wall" or "sink"; then id is the number of its table in [[walls]]."""

    id: int
    distance: float
    x: float
    y: float
    what: str = "disk"


class View:
    """The columns in the engine's memory: not copied, read-only, and in an order that any step may change."""

    def __init__(self, columns):
        self._columns = columns

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)  # copies and pickles ask for it before there are columns
        columns = self._columns
        if columns is None:
            raise RuntimeError("the view is closed")
        if name not in columns:
            raise AttributeError(f"the view has no column {name}: it has {', '.join(columns)}")
        return columns[name]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self) -> None:
        """Ends the view, as the end of `with` does. The simulation can go on when none of its arrays is left either."""
        self._columns = None
