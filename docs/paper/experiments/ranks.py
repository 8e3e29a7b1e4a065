"""Ranks on this machine, compared with a model of their parts: `./carom bench ranks`."""

import csv

import tex_numbers
from experiments.program import RELEASE, ROOT, run as run_program, scratch


def run() -> list:
    with scratch() as folder:
        run_program("bash", ROOT / "bench" / "ranks.sh", RELEASE / "carom", ROOT / "scenes", folder / "ranks.csv")
        rows = list(csv.DictReader((folder / "ranks.csv").open()))
    return [{key: value if key == "method" else float(value) for key, value in row.items()} for row in rows]


def numbers(rows: list) -> dict:
    table, worst = "", 0.0
    for row in rows:
        table += (
            " & ".join(
                [
                    f"\\texttt{{{row['method']}}}",
                    str(int(row["ranks"])),
                    tex_numbers.digits(row["measured_s"], 2),
                    tex_numbers.digits(row["model_s"], 2),
                    tex_numbers.digits(100 * row["ghosts_a_disk"], 1),
                    tex_numbers.digits(row["waits_a_step"], 0),
                    tex_numbers.digits(row["one_thread_s"], 2),
                ]
            )
            + " \\\\ "
        )
        worst = max(worst, abs(row["measured_s"] / row["model_s"] - 1.0))
    return {"table": table, "worst": tex_numbers.digits(100 * worst, 0)}
