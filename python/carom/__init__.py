"""Hard disks in a rectangle: event-driven, time-stepping, the same bits on any number of threads.

Lengths, times and masses are in the scene's own units. A scene is what docs/scene.md of Carom describes, from a file or
as a dictionary; the results are those of the command line, to the last bit.
"""

from . import _carom
from ._carom import PhysicsError, RunError, SceneError
from ._disks import Disks, Frame, Hit, View
from ._result import Column, Result, Trajectory
from ._run import map, run
from ._scene import Scene
from ._simulation import Simulation, resume

__version__ = _carom.version
__all__ = ["Scene", "run", "Simulation", "resume", "Result", "Column", "Trajectory", "Frame", "Disks", "View", "Hit", "map",
           "SceneError", "PhysicsError", "RunError"]

# Each is of this package, wherever it is written: in messages, help() and pickles.
for _class in (Scene, Simulation, Result, Column, Trajectory, Frame, Disks, View, Hit):
    _class.__module__ = __name__
