"""The time of a step of pairwise for a million disks, compared with that of copying their state: `carom_figures DIR
gas`."""

import csv

import tex_numbers
from experiments.program import RELEASE, run as run_program, scratch

PHASES = ["search", "resolve", "drift", "sort"]


def run() -> list:
    with scratch() as folder:
        run_program(RELEASE / "bench" / "carom_figures", folder, "gas")
        figures = list(csv.DictReader((folder / "figures.csv").open()))
        phases = list(csv.DictReader((folder / "phases.csv").open()))
    return [
        {"kind": "figure", "figure": row["figure"], "value": float(row["value"]), "unit": row["unit"]}
        for row in figures
    ] + [
        {
            "kind": "phase",
            "phase": row["phase"],
            "one": float(row["ns_per_disk_step_1_thread"]),
            "two": float(row["ns_per_disk_step_2_threads"]),
        }
        for row in phases
    ]


def numbers(rows: list) -> dict:
    figures = {row["figure"]: row["value"] for row in rows if row["kind"] == "figure"}
    phases = {row["phase"]: row for row in rows if row["kind"] == "phase"}
    table = "".join(f"{phase} & {phases[phase]['one']:.2f} & {phases[phase]['two']:.2f} \\\\ " for phase in PHASES)
    return {
        "table": table,
        "one": tex_numbers.digits(figures["G: step, 1 thread"], 1),
        "two": tex_numbers.digits(figures["G: step, 2 threads"], 1),
        "over_copy": tex_numbers.digits(figures["G: step over copy limit, 2 threads"], 1),
    }
