"""A scene in the hands of a program."""

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

_slice = 0.05  # seconds of steps between two looks at signals and callbacks
_threads_began_in = None  # the process in which a run had several threads, which a fork does not copy


def engine(name: str, threads: Optional[int]) -> tuple:
    """The engine's name and threads, refused in a child of a process that had several."""
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


_engine = engine  # where an argument has the name


def _next_multiple(interval: float, time: float, slack: float = 0.0) -> float:
    """The least k >= 1 for which interval * (k - slack), as it is rounded, lies beyond time."""
    k = max(1.0, np.floor(time / interval) - 1.0)  # the quotient may be rounded across a whole number, either way
    while interval * (k - slack) <= time:
        k = max(k + 1.0, np.nextafter(k, np.inf))
    return k


class Simulation:
    """A scene that is stepped by a program: looked at, changed between steps, saved.

    threads: of the engine; None: all cores. engine: "parallel" or "reference", which give the same bits. Raises
    SceneError where the disks find no place. A simulation is used by one thread at a time: other threads run Python while it
    steps, and what they ask of it then raises RuntimeError. A copy or a pickle is another simulation of the same state and
    scene, without the callbacks of every.
    """

    def __init__(self, scene: Scene, threads: Optional[int] = None, engine: str = "parallel"):
        with _in_words_of_python():
            self._begin(_carom.Simulation(Scene._checked(scene), *_engine(engine, threads)))

    def _begin(self, simulation):
        self._sim = simulation
        self._pid = os.getpid()
        self._callbacks = []
        # Time stepping adds up dt and comes to 0.3 where 3 * 0.1 is 0.30000000000000004: as frames, calls do not wait
        # for the next step then. In units of the interval.
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
        """Made; with exact, windows."""
        return self._sim.steps

    @property
    def collisions(self) -> int:
        """Of two disks."""
        return self._sim.collisions

    @property
    def wall_collisions(self) -> int:
        """Of a disk and a wall, or a fixed disk."""
        return self._sim.wall_collisions

    @property
    def hash(self) -> str:
        """The state_hash of the command line, 16 hexadecimal digits."""
        return self._sim.hash()

    def __len__(self):
        return self._sim.count

    @property
    def summary(self) -> dict:
        """What `carom run --json` prints, of this moment; times of the machine are 0, but for phase_s."""
        return json.loads(self._sim.summary())

    def take_warnings(self) -> list:
        """Warnings of the physics since the last call, one line each."""
        return [_words_of_python(warning) for warning in self._sim.warnings()]

    def every(self, interval: float, call: Callable[["Simulation"], Any]) -> None:
        """Calls call(self) during step and run, after the first step that ends at or beyond each multiple of interval
        (simulated time, > 0) from now on, and from the time of what from_bytes takes up; once after a step that passes
        several. In time stepping a millionth of the interval too early is in time, as sums of dt are rounded. What it
        raises ends the run there, and the simulation can go on. A call that makes steps itself is called in these too,
        from within itself."""
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
        """Makes so many steps (dt; with exact, windows), fewer where t_end is reached. Raises PhysicsError where the
        method cannot go on, KeyboardInterrupt between steps."""
        steps = operator.index(steps)
        if steps < 0:
            raise ValueError(f"steps is {steps}; expected 0 or more")
        self._go(min(steps, 2**63), np.inf)

    def run(self, until: Optional[float] = None) -> None:
        """Steps until time >= until, or to t_end. No step is cut short: disks(at=until) has the disks at that time
        itself, with the method exact. Raises as step."""
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
        Raises SceneError for a time after that step, or before it."""
        try:
            t, columns = (self.time, self._sim.disks()) if at is None else self._sim.disks_at(at)
        except TypeError:
            raise _arguments.no_numbers(at=at) from None
        scene = self._sim.scene
        return Frame(t, scene.width, scene.height, *scene.periodic, columns)

    def contacts(self) -> np.ndarray:
        """The pairs of disks that met in the last step: fields id1, id2 (id1 < id2) and time, in order of time and ids.

        exact: those that collided in the window, once for each collision; pairwise: those that touched or overlapped when
        the disks had drifted, before they were pushed apart (of a step in parts, of its last part; in a pile, in the last
        round); rollback: those whose approach ended the frame. Walls and fixed disks are left out, and disks that a sink
        took. None before the first step, and after a change or from_bytes.
        """
        return self._sim.contacts()

    def view(self) -> View:
        """Columns without a copy, for `with sim.view() as v:`. v.x, v.y, v.vx, v.vy, v.id; v.radius and v.mass where disks
        differ, v.spin where they are rough. step and every change raise RuntimeError while it, or an array of it, is in use."""
        return View(self._sim.view())

    def add(self, x: float, y: float, vx: float = 0.0, vy: float = 0.0, radius: float = 1.0, mass: float = 1.0,
            spin: float = 0.0) -> Optional[int]:
        """A new disk; its id, or None where it would overlap another, an inner wall or a side that has moved in. spin counts
        where disks are rough. Brownian disks forget the velocity. Raises SceneError for numbers out of range."""
        try:
            return self._sim.add(x, y, vx, vy, radius, mass, spin)
        except TypeError:
            raise _arguments.no_numbers(x=x, y=y, vx=vx, vy=vy, radius=radius, mass=mass, spin=spin) from None

    def remove(self, id: int) -> bool:
        """Takes a disk away; False where there is none of this id."""
        return self._sim.remove(_arguments.disk_id(id))

    def set_velocity(self, id: int, vx: float, vy: float) -> bool:
        """False where there is no disk of this id. Brownian disks forget it: each step draws another."""
        id = _arguments.disk_id(id)
        try:
            return self._sim.set_velocity(id, vx, vy)
        except TypeError:
            raise _arguments.no_numbers(vx=vx, vy=vy) from None

    def disks_in(self, x0: float, y0: float, x1: float, y1: float) -> np.ndarray:
        """Ids, ascending, of the disks whose centres lie in a rectangle; it may reach across periodic sides."""
        try:
            return self._sim.disks_in(x0, y0, x1, y1)
        except TypeError:
            raise _arguments.no_numbers(x0=x0, y0=y0, x1=x1, y1=y1) from None

    def nearest(self, x: float, y: float) -> Optional[tuple]:
        """(id, distance) of the disk whose centre is nearest, over periodic sides; None without disks."""
        try:
            return self._sim.nearest(x, y)
        except TypeError:
            raise _arguments.no_numbers(x=x, y=y) from None

    def cast_ray(self, x: float, y: float, dx: float, dy: float, length: float) -> Optional[Hit]:
        """The first disk or inner wall on a line of this length from (x, y) along (dx, dy); None where there is none."""
        try:
            hit = self._sim.cast_ray(x, y, dx, dy, length)
        except TypeError:
            raise _arguments.no_numbers(x=x, y=y, dx=dx, dy=dy, length=length) from None
        return None if hit is None else Hit(*hit)

    def save(self, path: _arguments.AnyPath) -> None:
        """Everything from which to go on, bit for bit, in a file that `carom resume` takes too, in place of an older one.
        Raises SceneError where a file that is no checkpoint has the name."""
        self._sim.save(_arguments.path(path))

    def to_bytes(self) -> bytes:
        """The same in memory, for from_bytes."""
        return self._sim.save_bytes()

    def from_bytes(self, saved: Any) -> None:
        """Goes back, or on, to what to_bytes gave: bytes, or anything that holds them (bytearray, memoryview, an array).
        Raises SceneError where it is damaged."""
        self._sim.load_bytes(memoryview(saved).tobytes())
        for entry in self._callbacks:
            entry[1] = _next_multiple(entry[0], self.time, self._slack)

    def __repr__(self):
        try:
            return f"<carom.Simulation, {len(self)} disks, t = {self.time:g}, {self.collisions} collisions>"
        except RuntimeError:  # loggers and debuggers of other threads ask, too
            return "<carom.Simulation, in a step of another thread>"

    def picture(self) -> bytes:
        """A picture of the disks now, as `carom render` draws it: the bytes of a PNG file."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "picture.png"
            self._sim.paint(str(file))
            return file.read_bytes()

    def _repr_html_(self):
        rows = {"disks": len(self), "time": f"{self.time:g}", "steps": self.steps, "collisions": self.collisions,
                "state hash": self.hash}
        return _notebook.table(rows) + _notebook.image("png", self.picture())


def resume(path: _arguments.AnyPath, threads: Optional[int] = None, engine: str = "parallel") -> Simulation:
    """The simulation of a checkpoint, or of the folder of a run that has one. Raises SceneError where it is none."""
    simulation = Simulation.__new__(Simulation)
    with _in_words_of_python():
        simulation._begin(_carom.Simulation.resume(_arguments.path(path), *_engine(engine, threads)))
    return simulation


def _of_bytes(saved: bytes, threads: int, engine: str) -> Simulation:
    """What a copy and a pickle of a simulation come back as."""
    simulation = Simulation.__new__(Simulation)
    simulation._begin(_carom.Simulation.of_bytes(saved, *_engine(engine, threads)))
    return simulation
