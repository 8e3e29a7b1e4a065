"""The results of a run: its summary, columns, frames and plots."""

from __future__ import annotations

import difflib
import json
import operator
import os
import pathlib
from typing import Any, Iterator, List, Mapping, Optional, Sequence, overload

import numpy as np

from . import _arguments, _carom, _export, _notebook
from ._carom import SceneError
from ._disks import Frame


class Trajectory:
    """The frames of trajectory.xyz or trajectory.h5, read one by one when they are used.

    path: the file, or the folder of a run, which may still be going on: each use sees the frames written so far. If
    another run replaces an earlier one (force=True), these are the earlier frames until it is done, and a loop that has
    begun ends with them. len() and [k] skip frames without reading them; [1:3] is a list of frames. Raises SceneError
    if there is no trajectory, or it is damaged.
    """

    def __init__(self, path: _arguments.AnyPath):
        self._path = _arguments.path(path)
        self._counted = (None, 0)  # the state of the file, and the number of its frames then
        _carom.open_trajectory(self.file)

    @property
    def file(self) -> str:
        """The file with the frames; while a run is going on it is in carom-unfinished of its folder."""
        path = self._path
        if not os.path.exists(path):
            raise SceneError(f"{path}: does not exist; expected a folder of a run, or a trajectory")
        if not os.path.isdir(path):
            return path
        file = _carom.trajectory_in(path) or _carom.trajectory_in(os.path.join(path, "carom-unfinished"))
        if not file:
            raise SceneError(f"{path}: holds no trajectory; expected trajectory.xyz or trajectory.h5")
        return file

    def __iter__(self) -> Iterator[Frame]:
        reader = _carom.open_trajectory(self.file)
        while (frame := reader.next()) is not None:
            yield Frame(*frame)

    def __len__(self):
        file = os.stat(self.file)
        as_now = (file.st_ino, file.st_size, file.st_mtime_ns)
        if self._counted[0] != as_now:
            reader, frames = _carom.open_trajectory(self.file), 0
            while reader.skip():
                frames += 1
            self._counted = (as_now, frames)
        return self._counted[1]

    @overload
    def __getitem__(self, k: int) -> Frame: ...

    @overload
    def __getitem__(self, k: slice) -> List[Frame]: ...

    def __getitem__(self, k):
        if isinstance(k, slice):
            wanted = range(*k.indices(len(self)))
            found = self._frames(wanted)
            return [found[n] for n in wanted]
        k = operator.index(k)
        wanted = k + len(self) if k < 0 else k
        found = self._frames([wanted]) if wanted >= 0 else {}
        if wanted not in found:
            raise IndexError(f"frame {k} of {len(self)}")
        return found[wanted]

    def _frames(self, wanted: Sequence[int]) -> dict:
        """The frames with these numbers that exist; others are skipped, which is faster than reading them."""
        reader = _carom.open_trajectory(self.file)
        found = {}
        for n in range(max(wanted, default=-1) + 1):
            if n not in wanted:
                if not reader.skip():
                    break
            elif (frame := reader.next()) is not None:
                found[n] = Frame(*frame)
            else:
                break
        return found

    def show(self, file: Optional[_arguments.AnyPath] = None, max_size: Optional[int] = None, force: bool = False) -> Any:
        """The viewer, as made by `carom view`: an HTML page that plays the run, of at most max_size bytes.

        In a notebook it is shown there. Elsewhere it is written to file (by default view.html in the run's folder, or
        beside the trajectory) and opened in a browser; if file is given it is only written. Raises SceneError if the
        file's name does not end in .html, or if the file exists: force replaces it.
        """
        folder = self._path if os.path.isdir(self._path) else os.path.dirname(self._path)
        return _notebook.show(self.file, folder, file, max_size, force)

    def to_ase(self) -> list:
        """An ase.Atoms object for each frame, as Frame.to_ase."""
        return [frame.to_ase() for frame in self]

    def to_mdanalysis(self) -> Any:
        """An MDAnalysis.Universe with all frames in memory: positions, velocities, times, box (its height along z is
        1), masses, radii. Raises ValueError if frames have different disks."""
        return _export.mdanalysis_universe(self)

    def to_gsd(self, path: _arguments.AnyPath, force: bool = False) -> None:
        """Writes a GSD file with a snapshot for each frame, as Frame.to_gsd; the step is the frame's number. Raises
        SceneError if the file exists: force replaces it."""
        _export.write_gsd(path, self, force)

    def __repr__(self):
        return f"<carom.Trajectory {self._path!r}>"


class Column(np.ndarray):
    """A numpy column from a file, with its properties there: attributes (a dictionary), unit, and for a series
    standard_error, that of its mean by blocking, or None."""

    def __new__(cls, values, attributes: Mapping[str, Any] = {}):
        column = np.asarray(values).view(cls)
        column.attributes = dict(attributes)
        return column

    def __array_finalize__(self, other):
        self.attributes = {}  # arrays computed from a column have no attributes of the file

    def __reduce__(self):
        return Column, (np.asarray(self), self.attributes)

    def __copy__(self):
        return Column(np.array(self), self.attributes)

    def __deepcopy__(self, _):
        return self.__copy__()

    @property
    def unit(self) -> Optional[str]:
        """For example "time" or "length"; None if the file has no unit."""
        return self.attributes.get("unit")

    @property
    def standard_error(self) -> Optional[float]:
        """That of the mean, or None."""
        return self.attributes.get("standard_error")


class Columns(dict):
    """The columns of a file by name. A name that the file does not have raises a KeyError with the nearest that it
    has, or with all."""

    def __missing__(self, name):
        near = difflib.get_close_matches(name, self, n=1) if isinstance(name, str) else []
        names = ", ".join(map(repr, near or self))
        raise KeyError(f"there is no column {name!r}; expected {'' if near else 'one of '}{names}")


def _attributes(item) -> dict:
    """The attributes of a data set and of its group. The mean of a group is that of its value, not of the intervals
    beside it; if the group has several series, NAME_mean is the mean of NAME."""
    name = item.name.rsplit("/", 1)[1]
    of_value = () if name == "value" else ("mean", "standard_deviation", "standard_error")
    own = {key: v for key, v in item.parent.attrs.items() if key not in of_value} | dict(item.attrs)
    own = {key: v.decode() if isinstance(v, bytes) else v for key, v in own.items()}
    return own | {key[len(name) + 1:]: v for key, v in own.items() if key.startswith(name + "_")}


_kinds = {str: "a text", int: "a whole number", (int, float): "a number"}
# The figures of a summary that the text of a Result shows, with their names there.
_always_there = {"state_hash": str, "particles": int, "time": (int, float), "collisions": int}


class Result:
    """The results of a run. summary: the keys of `carom run --json`; folder: that of its files, or None."""

    def __init__(self, summary: Mapping[str, Any], folder: Optional[str]):
        self.summary = dict(summary)
        self.folder = folder

    @classmethod
    def load(cls, folder: _arguments.AnyPath) -> "Result":
        """The result of a finished run, by `carom run`, a sweep or carom.run. Raises SceneError if the folder has
        none."""
        folder = _arguments.path(folder)
        file = os.path.join(folder, "summary.json")
        try:
            with open(file, encoding="utf-8") as text:
                summary = json.load(text)
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) else "is not JSON"
            raise SceneError(f"{file}: {reason}; expected the folder of a run that is done") from None
        for key, kind in _always_there.items():
            if not isinstance(summary, dict) or not isinstance(summary.get(key), kind):
                raise SceneError(f"{file}: has no {key}, {_kinds[kind]}; expected the folder of a run that is done")
        return cls(summary, folder)

    @property
    def hash(self) -> str:
        """The state_hash, 16 hexadecimal digits."""
        return self.summary["state_hash"]

    def _results(self):
        if self.folder is None:
            raise SceneError("the run wrote no files; give carom.run a folder: out=\"out/gas\"")
        return self.folder

    def _file(self, name):
        return os.path.join(self._results(), name)

    @property
    def series(self) -> dict:
        """The columns of series.csv by name, float64 of shape (frames,). Raises SceneError if there is no such file, or
        it is damaged."""
        path = self._file("series.csv")
        if not os.path.exists(path):
            raise SceneError(f"{path}: is not there; expected a scene with series = true in [output]")
        damaged = SceneError(f"{path}: has no heading, or rows of other columns than that; expected series.csv of a run")
        with open(path, encoding="utf-8", errors="replace") as text:
            if not text.readline().strip():
                raise damaged  # numpy would only warn of this, and go on without names
        try:
            table = np.genfromtxt(path, delimiter=",", names=True, deletechars="", ndmin=1)
        except (ValueError, IndexError):
            raise damaged from None
        return Columns((name, table[name]) for name in table.dtype.names)

    @property
    def frames(self) -> Trajectory:
        """The trajectory, frame by frame."""
        return Trajectory(self._results())

    @property
    def analysis(self) -> dict:
        """The data sets of analysis.h5 by their paths, each a Column (needs h5py). The attributes of a column are its
        own and those of its group: mean and standard_error of a series, diffusion, diffusion_error, samples, ..., as
        listed in docs/output.md. Raises SceneError if there is no such file, or it is damaged."""
        import h5py

        path = self._file("analysis.h5")
        if not os.path.exists(path):
            raise SceneError(f"{path}: is not there, as the scene measures nothing; expected a scene with [analysis]")
        columns = Columns()

        def take(path, item):
            if isinstance(item, h5py.Dataset):
                columns[path] = Column(item[()], _attributes(item)) if item.shape else item[()]

        try:
            with h5py.File(path) as file:
                file.visititems(take)
        except (OSError, RuntimeError, ValueError) as error:  # the exceptions of h5py for errors found by HDF5
            reason = str(error).partition("\n")[0]
            raise SceneError(f"{path}: cannot be read: {reason}; expected analysis.h5 of a run") from None
        return columns

    def __repr__(self):
        s = self.summary
        return f"<carom.Result, {s['particles']} disks, t = {s['time']:g}, hash {self.hash}, folder {self.folder!r}>"

    def show(self, file: Optional[_arguments.AnyPath] = None, max_size: Optional[int] = None, force: bool = False) -> Any:
        """The viewer of the trajectory, as Trajectory.show."""
        return self.frames.show(file, max_size, force)

    @property
    def plots(self) -> dict:
        """The plots that the scene asked for, by name: the text of an SVG file for each."""
        if self.folder is None:
            return {}
        files = sorted(pathlib.Path(self.folder).glob("*.svg"))
        return {file.stem: file.read_text(encoding="utf-8") for file in files}

    def _repr_html_(self):
        s = self.summary
        rows = {"disks": s["particles"], "time": f"{s['time']:g}", "collisions": s["collisions"], "state hash": self.hash,
                "folder": self.folder}
        return _notebook.table(rows) + "".join(_notebook.image("svg+xml", plot.encode()) for plot in self.plots.values())
