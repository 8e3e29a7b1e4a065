"""What MDAnalysis is asked to do with frames. Imports it."""

from MDAnalysis.coordinates.memory import MemoryReader


class FramesInMemory(MemoryReader):
    """Frames with a time each: time stepping ends where a step does, and a run where its scene says. MDAnalysis itself
    counts a time step a frame."""

    def __init__(self, coordinates, times, **more):
        self._times = times
        super().__init__(coordinates, times=times, **more)  # its copies are made of all that it is given

    def _read_next_timestep(self, ts=None):
        ts = super()._read_next_timestep(ts)
        ts.time = self._times[ts.frame]
        return ts
