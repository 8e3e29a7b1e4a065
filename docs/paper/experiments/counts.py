"""Instructions, cache misses and mispredicted branches for each collision, from cachegrind: `./carom bench counts`."""

import csv

import tex_numbers
from experiments.program import RELEASE, ROOT, run as run_program, scratch

SHOWN = {
    "exact_0.7": r"\texttt{exact}, $\phi = 0.7$",
    "exact_0.5": r"\texttt{exact}, $\phi = 0.5$",
    "exact_0.2": r"\texttt{exact}, $\phi = 0.2$",
}


def run() -> list:
    with scratch() as folder:
        run_program("bash", ROOT / "bench" / "counts.sh", RELEASE / "bench" / "carom_counts", folder / "counts.csv")
        rows = list(csv.DictReader((folder / "counts.csv").open()))
    whole = ("disks",)
    fractions = ("instructions", "first_level_misses", "last_level_misses", "mispredicted_branches")
    return [
        {
            "scene": row["scene"],
            "per": row["per"],
            **{k: int(row[k]) for k in whole},
            **{k: float(row[k]) for k in fractions},
        }
        for row in rows
    ]


def numbers(rows: list) -> dict:
    of = {row["scene"]: row for row in rows}
    table = ""
    for scene, title in SHOWN.items():
        row = of[scene]
        table += (
            " & ".join(
                [
                    title,
                    tex_numbers.count(row["disks"]),
                    tex_numbers.digits(row["instructions"], 0),
                    tex_numbers.digits(row["mispredicted_branches"], 1),
                    tex_numbers.digits(row["first_level_misses"], 0),
                    tex_numbers.digits(row["last_level_misses"], 1),
                ]
            )
            + " \\\\ "
        )
    return {"table": table}
