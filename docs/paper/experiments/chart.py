"""Cost against error of the three methods: `carom chart` with all its points."""

import csv
import json

import gnuplot
import tex_numbers
from experiments.program import RELEASE, run as run_program, scratch

DRAWN = {"fluid": r"fluid, $\phi = 0.5$", "mixed": "radii and masses that differ"}
METHODS = ["rollback", "pairwise", "exact"]
MEASURES = ["path", "rate", "missed"]


def run() -> list:
    with scratch() as folder:
        run_program(RELEASE / "carom", "chart", "-o", folder / "chart", "--quiet")
        points = list(csv.DictReader((folder / "chart" / "chart.csv").open()))
        scenes = json.loads((folder / "chart" / "chart.json").read_text())["scenes"]
    of_scenes = {s["scene"] for s in scenes}
    rows = [
        {
            "kind": "point",
            "scene": p["scene"],
            "method": p["method"],
            "dt": float(p["dt"]),
            "cost": float(p["cost"]),
            "measure": p["measure"],
            "error": float(p["error"]),
            "standard_error": float(p["standard_error"]),
            "seen": p["seen"] == "1",
            "order": float(p["fitted_order"] or 0.0),
        }
        for p in points
        if p["measure"] in MEASURES and p["scene"] in of_scenes
    ]
    return rows + [
        {
            "kind": "cost",
            "scene": s["scene"],
            "measure": c["measure"],
            "error": c["error"],
            **{method: c[method] for method in METHODS},
        }
        for s in scenes
        for c in s["cost_at_error"]
        if c["measure"] in ("path", "rate")
    ]


def ratios(rows: list, measure: str, error: float) -> dict:
    """The cost of pairwise over that of exact for this error, by scene; scenes in which it is not reached are left
    out."""
    return {
        row["scene"]: row["pairwise"] / row["exact"]
        for row in rows
        if row["kind"] == "cost"
        and row["measure"] == measure
        and row["error"] == error
        and row["pairwise"]
        and row["exact"]
    }


def orders(rows: list, method: str, measure: str) -> list:
    return sorted(
        {
            row["order"]
            for row in rows
            if row["kind"] == "point"
            and row["method"] == method
            and row["measure"] == measure
            and row["order"]
            and row["scene"] != "brownian"
        }
    )


def numbers(rows: list) -> dict:
    made = {"scenes": str(len({row["scene"] for row in rows}))}
    for name, error in (("coarse", 1e-2), ("fine", 1e-3)):
        of = ratios(rows, "path", error)
        made |= {
            f"{name}.least": tex_numbers.significant(min(of.values())),
            f"{name}.most": tex_numbers.significant(max(of.values())),
            f"{name}.fluid": tex_numbers.significant(of["fluid"]),
            f"{name}.dearer": str(sum(ratio > 1.0 for ratio in of.values())),
            f"{name}.reached": str(len(of)),
        }
    for method in ("rollback", "pairwise"):
        path = orders(rows, method, "path")
        made |= {
            f"{method}.least_order": tex_numbers.digits(path[0], 2),
            f"{method}.largest_order": tex_numbers.digits(path[-1], 2),
        }
    fluid = [row for row in rows if row["kind"] == "point" and row["scene"] == "fluid" and row["measure"] == "path"]
    made["exact_path_error"] = tex_numbers.significant(next(row["error"] for row in fluid if row["method"] == "exact"))
    return made


def draw(rows: list, folder) -> None:
    for scene, title in DRAWN.items():
        paths = [row for row in rows if row["kind"] == "point" and row["scene"] == scene and row["measure"] == "path"]
        blocks, plots = "", []
        for k, method in enumerate(METHODS[:2]):
            points = sorted((row["error"], 1e6 * row["cost"]) for row in paths if row["method"] == method and row["seen"])
            blocks += gnuplot.block(method, points)
            plots.append(f"${method} with linespoints linetype {k + 1} title '{method}'")
        exact = 1e6 * next(row["cost"] for row in paths if row["method"] == "exact")
        gnuplot.draw(
            folder,
            f"chart_{scene}",
            blocks
            + rf"""
set logscale xy
set format x '$10^{{%T}}$'
set xlabel 'error of paths'
set ylabel '$\mu$s per disk and mean free time'
set title '{title}'
set xrange [1e-5:1]
set key top right
plot {", ".join(plots)}, {exact:.6g} with lines linetype 3 linewidth 2 title 'exact'
""",
        )
