"""Whole runs, one or many."""

from __future__ import annotations

import _thread
import json
import os
import signal
import threading
from typing import Any, Callable, Iterable, Optional, Sequence

from . import _arguments, _carom
from ._carom import PhysicsError, RunError, SceneError
from ._result import Result
from ._scene import Scene
from ._simulation import engine as _engine
from ._text import in_words_of_python as _in_words_of_python, words_of_python as _words_of_python


def run(scene: Scene, out: Optional[_arguments.AnyPath] = None, threads: Optional[int] = None, engine: str = "parallel",
        force: bool = False, strict: bool = False, warn: Optional[Callable[[str], Any]] = None) -> Result:
    """Does all that `carom run` does: steps to t_end, and writes the files that the scene asks for to the folder out.
    Without out there are no files: the result is the summary, with the means of the quantities in [analysis].

    force replaces earlier results there; strict raises PhysicsError at the first warning of the physics; warn is called
    with each warning, a line (default: warnings.warn). Raises SceneError (for example if the folder holds another run),
    PhysicsError, RunError (the machine: a full disk, a plot that could not be drawn), KeyboardInterrupt, or the
    exception of another signal's handler (the last two leave a checkpoint in out).
    """
    if warn is None:
        import warnings

        def warn(text):
            warnings.warn(text, RuntimeWarning, stacklevel=4)

    folder = None if out is None else _arguments.path(out)
    if not folder and out is not None:
        raise SceneError("out: is empty; expected a folder, or None for no files")
    warn = _arguments.function(warn, "a warning")
    force, strict = _arguments.flag(force, "force"), _arguments.flag(strict, "strict")

    def say(warning):
        warn(_words_of_python(warning))

    with _in_words_of_python():
        text, folder, lost = _carom.run(Scene._checked(scene), folder, *_engine(engine, threads), force, strict, say)
    if lost:
        raise RunError(lost)
    return Result(json.loads(text), folder or None)


class _Worker:
    """A process of map. Ctrl-C, which a terminal sends to all processes, ends its run. Between runs it waits for what
    the first process says, and starts no run after that."""

    stop = None  # an event shared by all processes
    runs = False


def _begin_worker(stop):
    def pressed(*_):
        if _Worker.runs:
            raise KeyboardInterrupt

    def wait_for_stop():
        stop.wait()
        _thread.interrupt_main()

    _Worker.stop = stop
    signal.signal(signal.SIGINT, pressed)
    threading.Thread(target=wait_for_stop, daemon=True).start()


def _run_one(scene, out):
    import warnings

    warnings.simplefilter("ignore", RuntimeWarning)  # warnings are in the summary
    _Worker.runs = True
    try:
        if _Worker.stop.is_set():
            raise KeyboardInterrupt
        return run(scene, out, threads=1)
    finally:
        _Worker.runs = False


def map(scenes: Iterable[Scene], outs: Optional[Sequence] = None, jobs: Optional[int] = None) -> list:
    """Runs every scene on one core each, on all cores or with this number of jobs at once; the results are in the order
    of the scenes.

    outs: a folder for each scene, or None for no files. Processes are started with "spawn", so a script that calls this
    needs `if __name__ == "__main__":`. Raises the exception of a run, with the number of its scene; Ctrl-C stops all
    runs, each with a checkpoint in its folder.
    """
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor

    scenes = list(scenes)
    if isinstance(outs, (str, bytes, os.PathLike)):  # a text would count as a list of its letters
        raise TypeError(f"outs is {outs!r}; expected a list of folders, one for each scene")
    jobs = _arguments.size(jobs, "jobs")
    outs = [None] * len(scenes) if outs is None else list(outs)
    if len(outs) != len(scenes):
        raise ValueError(f"{len(outs)} folders for {len(scenes)} scenes")
    if not scenes:
        return []
    jobs = min(jobs or os.cpu_count() or 1, len(scenes))
    spawn = multiprocessing.get_context("spawn")
    stop = spawn.Event()
    with ProcessPoolExecutor(jobs, mp_context=spawn, initializer=_begin_worker, initargs=(stop,)) as pool:
        results: list = []
        try:
            for result in pool.map(_run_one, scenes, outs):
                results.append(result)
        except KeyboardInterrupt:
            stop.set()
            raise
        except (PhysicsError, RunError, SceneError) as error:
            raise type(error)(f"scenes[{len(results)}]: {error}") from None
    return results
