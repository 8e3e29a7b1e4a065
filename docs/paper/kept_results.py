"""The results of the paper's experiments: results/NAME.json, with the commit and the machine that made them.

A row is an object of numbers and texts; rows of runs contain the run's state_hash.
"""

import json
import os
import re
import subprocess
from pathlib import Path

FOLDER = Path(__file__).parent / "results"


def machine() -> dict:
    """The processor's name and the number of cores that this process may use."""
    names = re.findall(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return {"processor": names[0] if names else "unknown", "cores": len(os.sched_getaffinity(0))}


def commit() -> str:
    """The commit of the checkout, with -dirty if a file has been changed outside docs and bench/results."""
    root = Path(__file__).parents[2]

    def git(*arguments):
        return subprocess.run(
            ["git", "-C", root, *arguments], check=True, capture_output=True, text=True
        ).stdout.strip()

    changed = git("status", "--porcelain", "--", ".", ":!docs", ":!bench/results")
    return git("rev-parse", "--short=8", "HEAD") + ("-dirty" if changed else "")


def keep(name: str, rows: list) -> None:
    """Writes the rows of an experiment, either all of them or nothing."""
    content = {"experiment": name, "commit": commit(), "machine": machine(), "rows": rows}
    lines = ",\n    ".join(json.dumps(row) for row in content.pop("rows"))
    text = json.dumps(content, indent=2).removesuffix("\n}") + f',\n  "rows": [\n    {lines}\n  ]\n}}\n'
    unfinished = FOLDER / f"{name}.json.part"
    unfinished.write_text(text)
    unfinished.replace(FOLDER / f"{name}.json")


def kept(name: str) -> dict:
    """The last result that keep() wrote: experiment, commit, machine, rows."""
    return json.loads((FOLDER / f"{name}.json").read_text())
