"""A simulation that a program steps."""

from __future__ import annotations

import json
import operator
import os
import pathlib
import tempfile
from typing import Any, Callable, Optional

import numpy as np

from . import _arguments, _carom, _notebook
from ._disks import Frame, Hit, View
from ._scene import Scene
from ._text import in_words_of_python as _in_words_of_python, words_of_python as _words_of_python

_slice = 0.05  # seconds of steps between two checks of signals and callbacks
_threads_began_in = None  # the process in which a run used several threads, which a fork does not copy


def engine(name: str, threads: Optional[int]) -> tuple:
    """The name of the engine and its threads. Raises in a child process whose parent used several threads."""
    global _threads_began_in
    threads = _arguments.threads(threads)
    if not isinstance(name, str):
        raise TypeError(f"engine is \"parallel\" or \"reference\"; not {type(name).__name__}")
    several = name != "reference" and (threads or os.cpu_count() or 1) > 1
    if several and _threads_began_in not in (None, os.getpid()):
        raise RuntimeError("this process was forked from one that ran Carom on several threads, which are not in it: "
                           "give threads=1, or start processes with multiprocessing's \"spawn\"")
    if several:
        _threads_began_in = os.getpid()
    return name, threads


_engine = engine  # for functions that have an argument of this name


def _next_multiple(interval: float, time: float, slack: float = 0.0) -> float:
    """The least k >= 1 for which interval * (k - slack), as rounded, is beyond time."""
    k = max(1.0, np.floor(time / interval) - 1.0)  # the quotient may be rounded across a whole number, either way
    while interval * (k - slack) <= time:
        k = max(k + 1.0, np.nextafter(k, np.inf))
    return k


class Simulation:
    """A scene that a program steps, looks at, changes between steps, and saves.

    threads: of the engine; None: all cores. engine: "parallel" or "reference", which give the same bits. Raises
    SceneError if the disks find no place. Only one thread at a time may use a simulation: while it steps other threads
    run Python, and their calls of the simulation raise RuntimeError. A copy, or an unpickled one, is another simulation
    with the same state and scene, without the callbacks of every.
    """

    def __init__(self, scene: Scene, threads: Optional[int] = None, engine: str = "parallel"):
        with _in_words_of_python():
            self._begin(_carom.Simulation(Scene._checked(scene), *_engine(engine, threads)))

    def _begin(self, simulation):
        self._sim = simulation
        self._pid = os.getpid()
        self._callbacks = []
        # Time stepping adds up dt and comes to 0.3 instead of 3 * 0.1 = 0.30000000000000004: calls, like frames, must
        # not wait for the next step then. In units of the interval.
        self._slack = 0.0 if simulation.exact else 1e-6

    def __reduce__(self):
        return _of_bytes, (self.to_bytes(), self._sim.threads, self._sim.engine)

    @property
    def time(self) -> float:
        """End of the last step."""
        return self._sim.time

    @property
    def done(self) -> bool:
        """Has the scene's t_end been reached?"""
        return self._sim.done

    @property
    def steps(self) -> int:
        """Steps made; for exact the number of windows."""
        return self._sim.steps

    @property
    def collisions(self) -> int:
        """Collisions of two disks."""
        return self._sim.collisions

    @property
    def wall_collisions(self) -> int:
        """Collisions of a disk with a wall or a fixed disk."""
        return self._sim.wall_collisions

    @property
    def hash(self) -> str:
        """The state_hash of the command line, 16 hexadecimal digits."""
        return self._sim.hash()

    def __len__(self):
        return self._sim.count

    @property
    def summary(self) -> dict:
        """The summary printed by `carom run --json`, for the present moment; times of the machine are 0, except
        phase_s."""
        return json.loads(self._sim.summary())

    def take_warnings(self) -> list:
        """Warnings of the physics since the last call, one line each."""
        return [_words_of_python(warning) for warning in self._sim.warnings()]

    def every(self, interval: float, call: Callable[["Simulation"], Any]) -> None:
        """Calls call(self) during step and run, after the first step that ends at or beyond each multiple of interval
        (simulated time, > 0), counted from now on, and after from_bytes from the time of the loaded state; only once
        after a step that passes several multiples. In time stepping a millionth of the interval too early is enough, as
        sums of dt are rounded. An exception of the call ends the run there, and the simulation can go on. If the call
        makes steps itself, it is called within these, too."""
        try:
            beyond = bool(interval > 0.0)
            interval = float(interval)
        except (TypeError, ValueError, OverflowError):
            raise _arguments.no_numbers(interval=interval) from None
        if not beyond:
            raise ValueError(f"interval is {interval:g}; expected a time above 0")
        call = _arguments.function(call, "the simulation")
        self._callbacks.append([interval, _next_multiple(interval, self.time, self._slack), call])

    def step(self, steps: int = 1) -> None:
        """Makes this number of steps (of dt; for exact, windows), or fewer if t_end is reached. Raises PhysicsError if
        the method cannot go on, and KeyboardInterrupt between steps."""
        steps = operator.index(steps)
        if steps < 0:
            raise ValueError(f"steps is {steps}; expected 0 or more")
        self._go(min(steps, 2**63), np.inf)

    def run(self, until: Optional[float] = None) -> None:
        """Makes steps until time >= until, or to t_end. No step is cut short: with the method exact, disks(at=until)
        has the disks at that very time. Raises as step."""
        until = np.inf if until is None else float(until)
        if np.isnan(until):
            raise ValueError("until is not a number")
        self._go(2**63, until)

    def _go(self, steps, until):
        if os.getpid() != self._pid and self._sim.threads > 1:
            raise RuntimeError("this simulation began in another process, and its threads are there")
        while steps > 0 and self.time < until and not self.done:
            due = min((interval * (k - self._slack) for interval, k, _ in self._callbacks), default=np.inf)
            with _in_words_of_python():
                steps -= self._sim.step_for(steps, min(until, due), _slice)
            for entry in self._callbacks:
                interval, k, call = entry
                if self.time >= interval * (k - self._slack):
                    entry[1] = _next_multiple(interval, self.time, self._slack)
                    call(self)

    def disks(self, at: Optional[float] = None) -> Frame:
        """Copies of the columns in order of id: now, or at a time within the last step (method exact; otherwise now).
        Raises SceneError for a time outside that step."""
        try:
            t, columns = (self.time, self._sim.disks()) if at is None else self._sim.disks_at(at)
        except TypeError:
            raise _arguments.no_numbers(at=at) from None
        scene = self._sim.scene
        return Frame(t, scene.width, scene.height, *scene.periodic, columns)

    def contacts(self) -> np.ndarray:
        """The pairs of disks that met in the last step: fields id1, id2 (id1 < id2) and time, in order of time and ids.

        exact: pairs that collided in the window, once for each collision; pairwise: pairs that touched or overlapped
        after the drift, before they were pushed apart (in the last part of a split step, and in a pile in the last
        round); rollback: pairs whose approach ended the frame. Contacts with walls, fixed disks, and disks that a sink
        took are left out. There are none before the first step, and after a change or from_bytes.
        """
        return self._sim.contacts()

    def view(self) -> View:
        """The columns without a copy, for `with sim.view() as v:`. v.x, v.y, v.vx, v.vy, v.id; v.radius and v.mass if
        disks differ, v.spin if they are rough. While the view, or an array of it, is in use, step and every change
        raise RuntimeError."""
        return View(self._sim.view())

    def add(self, x: float, y: float, vx: float = 0.0, vy: float = 0.0, radius: float = 1.0, mass: float = 1.0,
            spin: float = 0.0) -> Optional[int]:
        """Adds a disk; returns its id, or None if it would overlap another disk, an inner wall or a side that has moved
        in. spin counts if disks are rough. Brownian disks forget the velocity. Raises SceneError for numbers out of
        range."""
        try:
            return self._sim.add(x, y, vx, vy, radius, mass, spin)
        except TypeError:
            raise _arguments.no_numbers(x=x, y=y, vx=vx, vy=vy, radius=radius, mass=mass, spin=spin) from None

    def remove(self, id: int) -> bool:
        """Removes a disk; False if there is none with this id."""
        return self._sim.remove(_arguments.disk_id(id))

    def set_velocity(self, id: int, vx: float, vy: float) -> bool:
        """False if there is no disk with this id. Brownian disks forget the velocity, as each step draws another."""
        id = _arguments.disk_id(id)
        try:
            return self._sim.set_velocity(id, vx, vy)
        except TypeError:
            raise _arguments.no_numbers(vx=vx, vy=vy) from None

    def disks_in(self, x0: float, y0: float, x1: float, y1: float) -> np.ndarray:
        """The ids, ascending, of the disks whose centres are in a rectangle, which may reach across periodic sides."""
        try:
            return self._sim.disks_in(x0, y0, x1, y1)
        except TypeError:
            raise _arguments.no_numbers(x0=x0, y0=y0, x1=x1, y1=y1) from None

    def nearest(self, x: float, y: float) -> Optional[tuple]:
        """(id, distance) of the disk whose centre is nearest, also across periodic sides; None without disks."""
        try:
            return self._sim.nearest(x, y)
        except TypeError:
            raise _arguments.no_numbers(x=x, y=y) from None

    def cast_ray(self, x: float, y: float, dx: float, dy: float, length: float) -> Optional[Hit]:
        """The first disk or inner wall on a line of this length from (x, y) along (dx, dy); None if there is none."""
        try:
            hit = self._sim.cast_ray(x, y, dx, dy, length)
        except TypeError:
            raise _arguments.no_numbers(x=x, y=y, dx=dx, dy=dy, length=length) from None
        return None if hit is None else Hit(*hit)

    def save(self, path: _arguments.AnyPath) -> None:
        """Saves all that is needed to go on, bit for bit, in a file that `carom resume` accepts, too; it replaces an
        older checkpoint. Raises SceneError if a file with this name is no checkpoint."""
        self._sim.save(_arguments.path(path))

    def to_bytes(self) -> bytes:
        """The same in memory, for from_bytes."""
        return self._sim.save_bytes()

    def from_bytes(self, saved: Any) -> None:
        """Loads a state saved by to_bytes: bytes, or an object that holds them (bytearray, memoryview, an array).
        Raises SceneError if it is damaged."""
        self._sim.load_bytes(memoryview(saved).tobytes())
        for entry in self._callbacks:
            entry[1] = _next_multiple(entry[0], self.time, self._slack)

    def __repr__(self):
        try:
            return f"<carom.Simulation, {len(self)} disks, t = {self.time:g}, {self.collisions} collisions>"
        except RuntimeError:  # loggers and debuggers of other threads may ask, too
            return "<carom.Simulation, in a step of another thread>"

    def picture(self) -> bytes:
        """A picture of the disks now, as drawn by `carom render`: the bytes of a PNG file."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "picture.png"
            self._sim.paint(str(file))
            return file.read_bytes()

    def _repr_html_(self):
        rows = {"disks": len(self), "time": f"{self.time:g}", "steps": self.steps, "collisions": self.collisions,
                "state hash": self.hash}
        return _notebook.table(rows) + _notebook.image("png", self.picture())


def resume(path: _arguments.AnyPath, threads: Optional[int] = None, engine: str = "parallel") -> Simulation:
    """A simulation from a checkpoint, or from the folder of a run that has one. Raises SceneError if there is none."""
    simulation = Simulation.__new__(Simulation)
    with _in_words_of_python():
        simulation._begin(_carom.Simulation.resume(_arguments.path(path), *_engine(engine, threads)))
    return simulation


def _of_bytes(saved: bytes, threads: int, engine: str) -> Simulation:
    """Makes the copy, or the unpickled simulation."""
    simulation = Simulation.__new__(Simulation)
    simulation._begin(_carom.Simulation.of_bytes(saved, *_engine(engine, threads)))
    return simulation
