"""The work that the slices of a run with eight regions leave to their borders: `carom_figures DIR borders`."""

import csv

import tex_numbers
from experiments.program import RELEASE, run as run_program, scratch


def run() -> list:
    with scratch() as folder:
        run_program(RELEASE / "bench" / "carom_figures", folder, "borders")
        rows = list(csv.DictReader((folder / "borders.csv").open()))
    return [{key: value if key == "scene" else float(value) for key, value in row.items()} for row in rows]


def numbers(rows: list) -> dict:
    row = next(row for row in rows if row["scene"] == "equal disks" and row["packing_fraction"] == 0.5)
    return {
        "collisions": tex_numbers.significant(row["events_a_disk_and_slice"]),
        "percent": tex_numbers.digits(row["percent_of_events"], 1),
    }
