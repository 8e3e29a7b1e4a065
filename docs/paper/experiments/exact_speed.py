"""Collisions per second of the exact method and of a plain event-driven simulation (one heap, cells), measured in
turns: `carom_figures DIR exact`."""

import csv

import gnuplot
import tex_numbers
from experiments.program import RELEASE, run as run_program, scratch

PACKING = 0.5


def run() -> list:
    with scratch() as folder:
        run_program(RELEASE / "bench" / "carom_figures", folder, "exact")
        rows = list(csv.DictReader((folder / "exact.csv").open()))
    return [
        {
            "program": row["method"],
            "disks": int(row["disks"]),
            "packing": float(row["packing_fraction"]),
            "threads": int(row["threads"]),
            "rate": float(row["million_collisions_per_s"]),
            "state_hash": row["state_hash"],
        }
        for row in rows
    ]


def rate(rows: list, program: str, disks: int, threads: int = 1, packing: float = PACKING) -> float:
    return next(
        row["rate"]
        for row in rows
        if (row["program"], row["disks"], row["threads"], row["packing"]) == (program, disks, threads, packing)
    )


def numbers(rows: list) -> dict:
    made, table = {}, ""
    for disks in (10**3, 10**4, 10**5, 10**6):
        one, plain = rate(rows, "exact", disks), rate(rows, "yardstick", disks)
        two = rate(rows, "exact", disks, 2) if disks > 1000 else None
        table += (
            " & ".join(
                [
                    tex_numbers.count(disks),
                    tex_numbers.digits(plain, 2),
                    tex_numbers.digits(one, 2),
                    tex_numbers.digits(two, 2) if two else "--",
                    tex_numbers.digits(one / plain, 1),
                    tex_numbers.digits(two / one, 2) if two else "--",
                ]
            )
            + " \\\\ "
        )
    made["table"] = table
    most = 10**6
    for key, disks in (("large", 10**5), ("million", most)):
        over = rate(rows, "exact", disks) / rate(rows, "yardstick", disks)
        made[f"over_plain_{key}"] = tex_numbers.digits(over, 1)
    made["over_plain_least"] = tex_numbers.digits(
        min(rate(rows, "exact", n) / rate(rows, "yardstick", n) for n in (10**3, 10**4, 10**5, most)), 1
    )
    made["second_thread"] = tex_numbers.digits(rate(rows, "exact", most, 2) / rate(rows, "exact", most), 2)
    return made


def draw(rows: list, folder) -> None:
    curves = [
        ("exact, 2 threads", "exact", 2),
        ("exact, 1 thread", "exact", 1),
        ("heap and cells, 1 thread", "yardstick", 1),
    ]
    blocks, plots = "", []
    for k, (title, program, threads) in enumerate(curves):
        points = sorted(
            (row["disks"], row["rate"])
            for row in rows
            if row["packing"] == PACKING and row["program"] == program and row["threads"] == threads
        )
        blocks += gnuplot.block(f"c{k}", points)
        plots.append(f"$c{k} with linespoints linetype {k + 1} title '{title}'")
    gnuplot.draw(
        folder,
        "exact_speed",
        blocks
        + rf"""
set logscale xy
set format x '$10^{{%T}}$'
set xlabel 'disks'
set ylabel '$10^6$ collisions per second'
set xrange [700:1.5e6]
set yrange [0.2:12]
set ytics (0.2, 0.5, 1, 2, 5, 10)
set key outside right center
plot {", ".join(plots)}
""",
        width=13.0,
    )
