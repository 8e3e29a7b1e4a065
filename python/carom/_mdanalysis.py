"""The frames as MDAnalysis needs them. Imports MDAnalysis."""

from MDAnalysis.coordinates.memory import MemoryReader


class FramesInMemory(MemoryReader):
    """Frames with a time for each: in time stepping frames are at the ends of steps, and the last one is at the end of
    the run. MDAnalysis by itself assumes equal intervals."""

    def __init__(self, coordinates, times, **more):
        self._times = times
        super().__init__(coordinates, times=times, **more)  # copies are made with all arguments of this call

    def _read_next_timestep(self, ts=None):
        ts = super()._read_next_timestep(ts)
        ts.time = self._times[ts.frame]
        return ts
