"""Runs of the programs in build/release, which `./carom paper --full` has built."""

import json
import os
import subprocess
import tempfile
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).parents[3]
RELEASE = ROOT / "build" / "release"


@contextmanager
def scratch():
    """A folder that is removed afterwards."""
    with tempfile.TemporaryDirectory(prefix="carom_paper_") as folder:
        yield Path(folder)


def run(program, *arguments, environment={}, statuses=(0,)) -> str:
    """The program's standard output. Raises RuntimeError with its error output if the exit status is not in
    statuses."""
    done = subprocess.run(
        [str(program), *map(str, arguments)], capture_output=True, text=True, env=os.environ | environment
    )
    if done.returncode not in statuses:
        raise RuntimeError(f"{program} {' '.join(map(str, arguments))}: exit status {done.returncode}: {done.stderr}")
    return done.stdout


def summary(scene, *arguments, environment={}, statuses=(0,)):
    """The summary of `carom run` for a scene, which is a file or text; None if nothing was printed (if statuses
    contains 2)."""
    with scratch() as folder:
        if not isinstance(scene, Path):
            (folder / "scene.toml").write_text(scene)
            scene = folder / "scene.toml"
        command = [RELEASE / "carom", "run", scene, "-o", folder / "out", "--json", "--quiet", *arguments]
        said = run(*command, environment=environment, statuses=statuses)
    return json.loads(said) if said else None
