"""The stability suite: verdicts of all cases and methods, and the limit at which a line of disks collapses."""

import csv
import math

import gnuplot
from experiments.program import RELEASE, run as run_program, scratch

METHODS = ["rollback", "pairwise", "exact"]
VERDICTS = ["right", "right but slow", "wrong and says so", "wrong in silence"]


def run() -> list:
    suite = RELEASE / "tests" / "stability" / "carom_stability"
    with scratch() as folder:
        run_program(suite, "--table", folder)
        run_program(suite, "--maps", folder)
        table = list(csv.DictReader((folder / "stability.csv").open()))
        collapse = list(csv.DictReader((folder / "stability_collapse.csv").open()))
    verdicts = {}  # several figures of a case have the same verdict
    for row in table:
        key = (row["case"], row["method"])
        verdicts.setdefault(
            key,
            {
                "kind": "case",
                "case": row["case"],
                "method": row["method"],
                "verdict": row["verdict"],
                "state_hash": row["hash"],
            },
        )
    return [
        *verdicts.values(),
        *(
            {
                "kind": "line",
                "disks": int(c["disks"]),
                "restitution": float(c["restitution"]),
                "runs": int(c["runs"]),
                "collapsed": int(c["collapsed"]),
            }
            for c in collapse
        ),
    ]


def numbers(rows: list) -> dict:
    cases = [row for row in rows if row["kind"] == "case"]
    made = {"cases": str(len({row["case"] for row in cases}))}
    table = ""
    for method in METHODS:
        counts = [sum(row["method"] == method and row["verdict"] == verdict for row in cases) for verdict in VERDICTS]
        table += f"\\texttt{{{method}}} & " + " & ".join(map(str, counts)) + " \\\\ "
    made["table"] = table
    tc = [row for row in cases if row["method"] == "exact" and ("_tc" in row["case"] or "contact_time" in row["case"])]
    made |= {"tc_cases": str(len(tc)), "tc_wrong": str(sum(row["verdict"].startswith("wrong") for row in tc))}
    return made


def boundary(restitution: float) -> float:
    """The number of disks above which a line of disks collapses (McNamara and Young 1992)."""
    return math.log(4.0 / (1.0 - restitution)) / (1.0 - restitution)


def draw(rows: list, folder) -> None:
    lines = [row for row in rows if row["kind"] == "line" and row["restitution"] > 0.0]
    curve = [(boundary(1.0 - 10.0**-k), 10.0**-k) for k in (j / 20 for j in range(1, 48))]
    points = gnuplot.block("all", [(r["disks"], 1.0 - r["restitution"], r["collapsed"] / r["runs"]) for r in lines])
    gnuplot.draw(
        folder,
        "collapse",
        points
        + gnuplot.block("theory", curve)
        + r"""
set logscale xy
set format y '$10^{%T}$'
set xlabel 'disks on a ring'
set ylabel '$1 - e$'
set xrange [2.5:1300]
set yrange [0.004:1.1]
set cbrange [0:1]
set palette defined (0 '#dbe6f3', 1 '#8b1a1a')
set cblabel 'share of runs that collapse'
set cbtics 0.5
unset grid
plot $all with points palette pointtype 5 pointsize 0.75 notitle, \
     $theory with lines linetype -1 linewidth 1.5 notitle
""",
        width=9.5,
    )
