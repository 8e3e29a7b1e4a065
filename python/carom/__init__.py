"""Hard disks in a rectangle: event-driven, time-stepping, the same bits on any number of threads.

Lengths, times and masses are in the scene's own units. A scene is what docs/scene.md of Carom describes, from a file or
as a dictionary; the results are those of the command line, to the last bit.
"""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Optional, Sequence

import numpy as np

from . import _carom
from ._carom import PhysicsError, RunError, SceneError
from ._text import overrides as _overrides, toml as _toml

__version__ = _carom.version
__all__ = ["Scene", "run", "Simulation", "resume", "Result", "Trajectory", "Frame", "Disks", "View", "Hit", "map",
           "SceneError", "PhysicsError", "RunError"]

_slice = 0.05  # seconds of steps between two looks at signals and callbacks
_threads_began_in = None  # the process in which a run had several threads, which a fork does not copy


def _engine(engine: str, threads: Optional[int]) -> tuple:
    """The engine's name and threads, refused in a child of a process that had several."""
    global _threads_began_in
    several = engine != "reference" and (threads or os.cpu_count() or 1) > 1
    if several and _threads_began_in not in (None, os.getpid()):
        raise RuntimeError("this process was forked from one that ran Carom on several threads, which are not in it: "
                           "give threads=1, or start processes with multiprocessing's \"spawn\"")
    if several:
        _threads_began_in = os.getpid()
    return engine, threads


class Scene:
    """A scene, read and checked.

    Scene({...}) takes the tables and keys of a scene file as a dictionary; lists may be numpy arrays. changes are keys
    and values that take the place of the scene's: {"run.t_end": 50.0}. Raises SceneError with one line that says what is
    wrong and what was expected.
    """

    def __init__(self, tables: Mapping[str, Any], changes: Mapping[str, Any] = {}):
        self._source = ("text", _toml(tables), "scene", "", _overrides(changes))
        self._scene = self._read()

    @classmethod
    def load(cls, path, changes: Mapping[str, Any] = {}) -> "Scene":
        """The scene of a TOML file. Raises SceneError (file, line, key, what was expected)."""
        return cls._of("file", os.fspath(path), _overrides(changes))

    @classmethod
    def parse(cls, text: str, changes: Mapping[str, Any] = {}, folder: str = "") -> "Scene":
        """The scene of TOML text; files that it names are looked for from folder on."""
        return cls._of("text", text, "scene", folder, _overrides(changes))

    @classmethod
    def _of(cls, *source):
        scene = cls.__new__(cls)
        scene._source = source
        scene._scene = scene._read()
        return scene

    def _read(self):
        kind, *arguments = self._source
        return _carom.load_scene(*arguments) if kind == "file" else _carom.parse_scene(*arguments)

    def __getstate__(self):
        return self._source

    def __setstate__(self, source):
        self._source = source
        self._scene = self._read()

    title = property(lambda self: self._scene.title, doc="str")
    width = property(lambda self: self._scene.width, doc="of the box; length")
    height = property(lambda self: self._scene.height, doc="of the box; length")
    t_end = property(lambda self: self._scene.t_end, doc="simulated time at which a run ends")
    seed = property(lambda self: self._scene.seed, doc="of the random numbers")

    @property
    def warnings(self) -> list:
        """What is no error but may not be what was meant, one line each."""
        return self._scene.warnings()

    def toml(self) -> str:
        """The scene as TOML with every default spelled out."""
        return self._scene.toml()

    def __repr__(self):
        return f"<carom.Scene {self.title or self._scene.file!r}, {self.width:g} x {self.height:g}, t_end {self.t_end:g}>"


class Disks:
    """Disks as columns, numpy arrays of shape (n,): x, y (length), vx, vy (length / time), radius, mass, id."""

    def __init__(self, columns: Mapping[str, np.ndarray], t: float):
        self.__dict__.update(columns)
        self.t = t  # simulated time
        self.names = tuple(columns)

    def __len__(self):
        return len(self.x)

    def positions3d(self) -> np.ndarray:
        """Centres as float64 of shape (n, 3), z = 0: as freud, ASE and MDAnalysis want them."""
        return np.column_stack([self.x, self.y, np.zeros(len(self))])

    def __repr__(self):
        return f"<{len(self)} disks at t = {self.t:g}: {', '.join(self.names)}>"


class Frame(Disks):
    """A frame of a trajectory: disks in order of id, and the box. group where the file has it."""

    def __init__(self, t, width, height, periodic_x, periodic_y, columns):
        super().__init__(columns, t)
        self.box = (width, height)  # length
        self.periodic = (periodic_x, periodic_y)


class Hit(NamedTuple):
    """What a ray meets: the disk's id, the distance along the ray to its edge, and the place there (length)."""

    id: int
    distance: float
    x: float
    y: float


class View:
    """The columns as they lie in memory: no copies, read-only, in an order that any step may change."""

    def __init__(self, columns):
        self._columns = columns

    def __getattr__(self, name):
        columns = self.__dict__["_columns"]
        if columns is None:
            raise RuntimeError("the view is closed")
        if name not in columns:
            raise AttributeError(f"the view has no column {name}: it has {', '.join(columns)}")
        return columns[name]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._columns = None

    close = __exit__


class Simulation:
    """A scene that is stepped by a program: looked at, changed between steps, saved.

    threads: of the engine; None: all cores. engine: "parallel" or "reference", which give the same bits. Raises
    SceneError where the disks find no place. A simulation is used by one thread at a time; other threads run Python while it
    steps.
    """

    def __init__(self, scene: Scene, threads: Optional[int] = None, engine: str = "parallel"):
        self._begin(_carom.Simulation(scene._scene, *_engine(engine, threads)))

    def _begin(self, simulation):
        self._sim = simulation
        self._pid = os.getpid()
        self._callbacks = []

    time = property(lambda self: self._sim.time, doc="end of the last step")
    done = property(lambda self: self._sim.done, doc="has the scene's t_end been reached?")
    steps = property(lambda self: self._sim.steps, doc="made; with exact, windows")
    collisions = property(lambda self: self._sim.collisions, doc="of two disks")
    wall_collisions = property(lambda self: self._sim.wall_collisions, doc="of a disk and a wall")
    hash = property(lambda self: self._sim.hash(), doc="state_hash of the command line, 16 hexadecimal digits")

    def __len__(self):
        return self._sim.count

    @property
    def summary(self) -> dict:
        """What `carom run --json` prints, of this moment; times of the machine are 0."""
        return json.loads(self._sim.summary())

    def take_warnings(self) -> list:
        """Warnings of the physics since the last call, one line each."""
        return self._sim.warnings()

    def every(self, interval: float, call: Callable[["Simulation"], Any]) -> None:
        """Calls call(self) during step and run, after the first step that ends at or beyond each multiple of interval
        (simulated time, > 0) from now on. What it raises ends the run there, and the simulation can go on."""
        if not interval > 0.0:
            raise ValueError(f"interval is {interval}; expected a time above 0")
        self._callbacks.append([interval, np.floor(self.time / interval) + 1, call])

    def step(self, steps: int = 1) -> None:
        """Makes so many steps (dt; with exact, windows), fewer where t_end is reached. Raises PhysicsError where the
        method cannot go on, KeyboardInterrupt between steps."""
        if steps < 0:
            raise ValueError(f"steps is {steps}; expected 0 or more")
        self._go(steps, np.inf)

    def run(self, until: Optional[float] = None) -> None:
        """Steps until time >= until, or to t_end. No step is cut short: disks(at=until) has the disks at that time
        itself, with the method exact. Raises as step."""
        if until is not None and np.isnan(until):
            raise ValueError("until is not a number")
        self._go(2**63, np.inf if until is None else until)

    def _go(self, steps, until):
        if os.getpid() != self._pid and self._sim.threads > 1:
            raise RuntimeError("this simulation began in another process, and its threads are there")
        while steps > 0 and self.time < until and not self.done:
            due = min((interval * k for interval, k, _ in self._callbacks), default=np.inf)
            steps -= self._sim.step_for(steps, min(until, due), _slice)
            for entry in self._callbacks:
                interval, k, call = entry
                if self.time >= interval * k:
                    entry[1] = np.floor(self.time / interval) + 1
                    call(self)

    def disks(self, at: Optional[float] = None) -> Disks:
        """Copies of the columns in order of id: now, or at a time within the last step (method exact; otherwise now)."""
        if at is None:
            return Disks(self._sim.disks(), self.time)
        t, columns = self._sim.disks_at(at)
        return Disks(columns, t)

    def view(self) -> View:
        """Columns without a copy, for `with sim.view() as v:`. v.x, v.y, v.vx, v.vy, v.id; v.radius and v.mass where disks
        differ. step and every change raise RuntimeError while it, or an array of it, is in use."""
        return View(self._sim.view())

    def add(self, x, y, vx=0.0, vy=0.0, radius=1.0, mass=1.0) -> Optional[int]:
        """A new disk; its id, or None where it would overlap another. Raises SceneError for numbers out of range."""
        return self._sim.add(x, y, vx, vy, radius, mass)

    def remove(self, id: int) -> bool:
        """Takes a disk away; False where there is none of this id."""
        return self._sim.remove(id)

    def set_velocity(self, id: int, vx: float, vy: float) -> bool:
        """False where there is no disk of this id."""
        return self._sim.set_velocity(id, vx, vy)

    def disks_in(self, x0, y0, x1, y1) -> np.ndarray:
        """Ids, ascending, of the disks whose centres lie in a rectangle; it may reach across periodic sides."""
        return self._sim.disks_in(x0, y0, x1, y1)

    def nearest(self, x, y) -> Optional[tuple]:
        """(id, distance) of the disk whose centre is nearest, over periodic sides; None without disks."""
        return self._sim.nearest(x, y)

    def cast_ray(self, x, y, dx, dy, length) -> Optional[Hit]:
        """The first disk on a line of this length from (x, y) along (dx, dy); None where there is none."""
        hit = self._sim.cast_ray(x, y, dx, dy, length)
        return None if hit is None else Hit(*hit)

    def save(self, path) -> None:
        """Everything from which to go on, bit for bit, in a file that `carom resume` takes too."""
        self._sim.save(os.fspath(path))

    def to_bytes(self) -> bytes:
        """The same in memory, for from_bytes."""
        return self._sim.save_bytes()

    def from_bytes(self, saved: bytes) -> None:
        """Goes back, or on, to what to_bytes gave. Raises SceneError where it is damaged."""
        self._sim.load_bytes(saved)

    def __repr__(self):
        return f"<carom.Simulation, {len(self)} disks, t = {self.time:g}, {self.collisions} collisions>"

    def _repr_html_(self):
        rows = [("disks", len(self)), ("time", f"{self.time:g}"), ("steps", self.steps), ("collisions", self.collisions),
                ("state hash", self.hash)]
        return "<table>" + "".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in rows) + "</table>"


def resume(path, threads: Optional[int] = None, engine: str = "parallel") -> Simulation:
    """The simulation of a checkpoint, or of the folder of a run that has one. Raises SceneError where it is none."""
    simulation = Simulation.__new__(Simulation)
    simulation._begin(_carom.Simulation.resume(os.fspath(path), *_engine(engine, threads)))
    return simulation


class Trajectory:
    """The frames of trajectory.xyz or trajectory.h5, read one by one as they are asked for.

    path: the file, or the folder of a run, also of one that goes on. len() and [k] read up to there. Raises SceneError where
    there is none, or it is damaged.
    """

    def __init__(self, path):
        path = os.fspath(path)
        self.file = path
        if os.path.isdir(path):
            self.file = _carom.trajectory_in(path) or _carom.trajectory_in(os.path.join(path, "carom-unfinished"))
            if not self.file:
                raise SceneError(f"{path}: holds no trajectory; expected trajectory.xyz or trajectory.h5")
        self._length = None
        _carom.open_trajectory(self.file)

    def __iter__(self) -> Iterator[Frame]:
        reader = _carom.open_trajectory(self.file)
        while (frame := reader.next()) is not None:
            yield Frame(*frame)

    def __len__(self):
        if self._length is None:
            self._length = sum(1 for _ in self)
        return self._length

    def __getitem__(self, k: int) -> Frame:
        wanted = k + len(self) if k < 0 else k
        for n, frame in enumerate(self):
            if n == wanted:
                return frame
        raise IndexError(f"frame {k} of {len(self)}")

    def __repr__(self):
        return f"<carom.Trajectory {self.file!r}>"


class Result:
    """What a run came to. summary: the keys of `carom run --json`; folder: of its files, or None."""

    def __init__(self, summary: Mapping[str, Any], folder: Optional[str]):
        self.summary = dict(summary)
        self.folder = folder

    hash = property(lambda self: self.summary["state_hash"], doc="16 hexadecimal digits")

    def _file(self, name):
        if self.folder is None:
            raise SceneError("the run wrote no files; give carom.run a folder: out=\"out/gas\"")
        return os.path.join(self.folder, name)

    @property
    def series(self) -> dict:
        """Columns of series.csv by name, float64 of shape (frames,)."""
        table = np.genfromtxt(self._file("series.csv"), delimiter=",", names=True, deletechars="", ndmin=1)
        return {name: table[name] for name in table.dtype.names}

    @property
    def frames(self) -> Trajectory:
        """The trajectory, frame by frame."""
        return Trajectory(self._file(""))

    @property
    def analysis(self) -> dict:
        """The data sets of analysis.h5 by their paths (needs h5py)."""
        import h5py

        columns = {}
        with h5py.File(self._file("analysis.h5")) as file:
            file.visititems(lambda name, item: columns.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
        return columns

    def __repr__(self):
        s = self.summary
        return f"<carom.Result, {s['particles']} disks, t = {s['time']:g}, hash {self.hash}, folder {self.folder!r}>"


def run(scene: Scene, out=None, threads: Optional[int] = None, engine: str = "parallel", force: bool = False,
        strict: bool = False, warn: Optional[Callable[[str], Any]] = None) -> Result:
    """The whole of `carom run`: steps to t_end and writes what the scene asks for to the folder out; without out, no files.

    force replaces earlier results there; strict raises PhysicsError at the first warning of the physics; warn gets each
    warning as a line (default: warnings.warn). Raises SceneError (a folder that holds another run), PhysicsError,
    RunError (the machine: a full disk, a plot that could not be drawn), KeyboardInterrupt (with a checkpoint in out).
    """
    if warn is None:
        import warnings

        def warn(text):
            warnings.warn(text, RuntimeWarning, stacklevel=3)

    folder = None if out is None else os.fspath(out)
    text, folder, stopped, lost = _carom.run(scene._scene, folder, *_engine(engine, threads), force, strict, warn)
    if stopped:
        raise KeyboardInterrupt(stopped)
    if lost:
        raise RunError(lost)
    return Result(json.loads(text), folder or None)


def _run_one(scene, out):
    import warnings

    warnings.simplefilter("ignore", RuntimeWarning)  # they are in the summary
    return run(scene, out, threads=1)


def map(scenes: Iterable[Scene], outs: Optional[Sequence] = None, jobs: Optional[int] = None) -> list:
    """Runs every scene by itself on one core, on all cores or on so many jobs at once; the results in the order of scenes.

    outs: a folder for each, or None for no files. Processes are begun anew ("spawn"): a script that calls this needs
    `if __name__ == "__main__":`. Raises what a run raises.
    """
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor

    scenes = list(scenes)
    outs = [None] * len(scenes) if outs is None else list(outs)
    if len(outs) != len(scenes):
        raise ValueError(f"{len(outs)} folders for {len(scenes)} scenes")
    if not scenes:
        return []
    jobs = min(jobs or os.cpu_count() or 1, len(scenes))
    with ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        return list(pool.map(_run_one, scenes, outs))
