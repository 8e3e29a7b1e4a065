"""Reversed elastic motion: the distance of disks from their start afterwards, which grows with the largest Lyapunov
exponent."""

import math

import numpy as np

import gnuplot
import tex_numbers
from experiments.gas import periodic_gas

DISKS, SEEDS = 256, 8
LYAPUNOV = {0.1: 1.51, 0.3: 2.91, 0.5: 4.76}  # from docs/reference_values.md
GROWTHS = [2, 5, 8, 11, 14, 17, 20, 23, 26, 29, 32]  # values of lambda T


def error(packing: float, seed: int, turn: float) -> tuple:
    """The root mean square distance after going there and back, in diameters, the time of turning, and the run's
    hash."""
    import carom

    sim = carom.Simulation(carom.Scene(periodic_gas(DISKS, packing, seed, t_end=4.0 * turn + 4.0)), threads=1)
    start = sim.disks()
    sim.run(until=turn)
    turned = sim.time
    there = sim.disks()
    for k in range(len(there.id)):
        sim.set_velocity(int(there.id[k]), -there.vx[k], -there.vy[k])
    sim.run(until=2.0 * turned)
    back = sim.disks(at=2.0 * turned)
    side = start.box[0]
    apart = [(b - a + side / 2) % side - side / 2 for a, b in ((start.x, back.x), (start.y, back.y))]
    return float(np.sqrt(np.mean(apart[0] ** 2 + apart[1] ** 2))), turned, sim.hash


def run() -> list:
    rows = []
    for packing, exponent in LYAPUNOV.items():
        for growth in GROWTHS:
            for seed in range(1, SEEDS + 1):
                distance, turned, state_hash = error(packing, seed, growth / exponent)
                rows.append(
                    {
                        "packing": packing,
                        "growth": growth,
                        "seed": seed,
                        "turned": turned,
                        "distance": distance,
                        "state_hash": state_hash,
                    }
                )
    return rows


def curve(rows: list, packing: float) -> list:
    """Points of lambda T and the geometric mean of the distance, for each growth."""
    points = []
    for growth in GROWTHS:
        of = [row for row in rows if row["packing"] == packing and row["growth"] == growth]
        points.append(
            (
                LYAPUNOV[packing] * float(np.mean([row["turned"] for row in of])),
                math.exp(float(np.mean([math.log(max(row["distance"], 1e-17)) for row in of]))),
            )
        )
    return points


def slope(rows: list, packing: float) -> float:
    """The slope of the logarithm of the distance over lambda T, where the distance has grown and is still small."""
    points = [(t, math.log(d)) for t, d in curve(rows, packing) if t > 4.0 and d < 1e-2]
    return float(np.polyfit(*zip(*points), 1)[0])


def numbers(rows: list) -> dict:
    slopes = [slope(rows, packing) for packing in LYAPUNOV]
    return {
        "disks": str(DISKS),
        "seeds": str(SEEDS),
        "least_slope": tex_numbers.digits(min(slopes), 2),
        "largest_slope": tex_numbers.digits(max(slopes), 2),
    }


def draw(rows: list, folder) -> None:
    blocks = "".join(gnuplot.block(f"p{k}", curve(rows, packing)) for k, packing in enumerate(LYAPUNOV))
    plots = ", ".join(f"$p{k} linetype {k + 1} title '$\\phi = {packing}$'" for k, packing in enumerate(LYAPUNOV))
    gnuplot.draw(
        folder,
        "reversal",
        blocks
        + rf"""
set logscale y
set format y '$10^{{%T}}$'
set xlabel '$\lambda T$'
set ylabel 'distance from the start / $\sigma$'
set yrange [1e-16:10]
set key top left
plot 1e-16*exp(x) linetype 5 title '$10^{{-16}}\,e^{{\lambda T}}$', {plots}
""",
    )
