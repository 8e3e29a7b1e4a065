"""Hard disks in a rectangle: event-driven or time-stepping, with the same bits on any number of threads.

Lengths, times and masses are in the scene's own units. Scenes are described in docs/scene.md of Carom; they come from a
file or a dictionary. The results are those of the command line, to the last bit.
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

SceneError.__doc__ = """A bad scene, argument or file: one line, with the file, the line, the key and what was expected."""
PhysicsError.__doc__ = """The method cannot continue: a step far too long, an inelastic collapse, a warning with strict=True."""
RunError.__doc__ = """The machine failed: a full disk, a plot that could not be drawn."""

# Everything belongs to this package, wherever it is defined: in messages, help() and pickles.
for _class in (Scene, Simulation, Result, Column, Trajectory, Frame, Disks, View, Hit, SceneError, PhysicsError, RunError):
    _class.__module__ = __name__
