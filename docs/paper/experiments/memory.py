"""Peak memory of a run with a million disks: `carom_figures DIR memory`."""

import csv

import tex_numbers
from experiments.program import RELEASE, run as run_program, scratch


def run() -> list:
    with scratch() as folder:
        run_program(RELEASE / "bench" / "carom_figures", folder, "memory")
        return [
            {"figure": row["figure"], "bytes_a_disk": float(row["value"])}
            for row in csv.DictReader((folder / "figures.csv").open())
        ]


def numbers(rows: list) -> dict:
    of = {row["figure"]: tex_numbers.digits(row["bytes_a_disk"], 0) for row in rows}
    return {"pairwise": of["G: memory at peak of carom run"], "exact": of["G, exact: memory at peak of carom run"]}
