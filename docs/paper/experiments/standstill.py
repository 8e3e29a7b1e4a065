"""The number of frames that rollback needs to advance by dt, as the number of disks grows: one contact delays all
disks."""

import gnuplot
import tex_numbers
from experiments.gas import periodic_gas

DISKS = [16, 64, 256, 1024, 4096, 16384, 65536]
PACKING, DT, FRAMES = 0.5, 0.032, 400


def run() -> list:
    import carom

    rows = []
    for disks in DISKS:
        scene = periodic_gas(disks, PACKING, t_end=1e4, method="rollback", dt=DT)
        sim = carom.Simulation(carom.Scene(scene), threads=1)
        sim.step(50)
        begin = sim.time
        sim.step(FRAMES)
        rows.append({"disks": disks, "frames_a_dt": FRAMES * DT / (sim.time - begin), "state_hash": sim.hash})
    return rows


def numbers(rows: list) -> dict:
    return {
        "dt": str(DT),
        "fewest": str(DISKS[0]),
        "most": tex_numbers.count(DISKS[-1]),
        "first": tex_numbers.significant(rows[0]["frames_a_dt"]),
        "last": tex_numbers.significant(rows[-1]["frames_a_dt"]),
    }


def draw(rows: list, folder) -> None:
    gnuplot.draw(
        folder,
        "standstill",
        gnuplot.block("f", [(row["disks"], row["frames_a_dt"]) for row in rows])
        + r"""
set logscale x
set format x '$10^{%T}$'
set xlabel 'disks'
set ylabel 'frames to advance by $\Delta t$'
set yrange [0:*]
plot $f with linespoints linetype 1 notitle
""",
    )
