"""Uniform cooling of inelastic disks: Haff's law for constant restitution, and its exponent -5/3 for viscoelastic
disks."""

import math

import numpy as np

import gnuplot
import tex_numbers
from experiments.gas import periodic_gas

DISKS, PACKING, SEEDS = 1024, 0.1, 8
RESTITUTION, VISCOELASTIC = 0.98, 0.02
RATE = 4.0 * 0.236144 / math.sqrt(math.pi)  # collisions per disk and unit of time, at temperature 1
TAU = {
    "constant": 4.0 / ((1.0 - RESTITUTION**2) * RATE),
    "viscoelastic": 1.0 / (0.6 * RATE * VISCOELASTIC * 4.0**0.1 * math.gamma(2.1)),
}
TIMES = [0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 4.7]  # in units of tau


def loss(temperature: float) -> float:
    """The loss -dT/dt of viscoelastic disks: half the collision rate of a disk times the mean of (1 - e^2) v^2 / 4,
    where e = 1 - a v^(1/5) and the speed v of colliding disks has the density v exp(-v^2 / 4 T)."""

    def mean(power):
        return (4.0 * temperature) ** (0.5 * power) * math.gamma(0.5 * power + 1.0)

    a = VISCOELASTIC
    return RATE * math.sqrt(temperature) / 8.0 * (2.0 * a * mean(2.2) - a * a * mean(2.4))


def theory(law: str, time: float) -> float:
    """The temperature at `time`, in units of tau, starting from 1."""
    if law == "constant":
        return (1.0 + time) ** -2
    t, steps = 1.0, 4000
    dt = time * TAU[law] / steps
    for _ in range(steps):
        t -= dt * loss(t - 0.5 * dt * loss(t))
    return t


def run() -> list:
    import carom

    rows = []
    for law, restitution in (("constant", RESTITUTION), ("viscoelastic", {"viscoelastic": VISCOELASTIC})):
        for seed in range(1, SEEDS + 1):
            scene = periodic_gas(
                DISKS, PACKING, seed, t_end=TIMES[-1] * TAU[law] * 1.01, physics={"restitution": restitution}
            )
            sim = carom.Simulation(carom.Scene(scene), threads=1)
            temperatures = []
            for time in TIMES:
                sim.run(until=time * TAU[law])
                d = sim.disks(at=time * TAU[law])
                temperatures.append(float(np.sum(d.vx**2 + d.vy**2)) / (2 * DISKS))
            rows.append(
                {
                    "law": law,
                    "seed": seed,
                    "temperatures": temperatures,
                    "collisions": sim.summary["collisions"],
                    "state_hash": sim.hash,
                }
            )
    return rows


def ratios(rows: list, law: str) -> list:
    """Mean and standard error of the temperature divided by that of theory, for each of TIMES."""
    measured = np.array([row["temperatures"] for row in rows if row["law"] == law])
    over = measured / [theory(law, time) for time in TIMES]
    return [(float(r.mean()), float(r.std(ddof=1)) / math.sqrt(len(r))) for r in over.T]


def numbers(rows: list) -> dict:
    made = {
        "disks": tex_numbers.count(DISKS),
        "seeds": str(SEEDS),
        "packing": str(PACKING),
        "restitution": str(RESTITUTION),
        "a": str(VISCOELASTIC),
        "last": str(TIMES[-1]),
    }
    for law in TAU:
        made[f"{law}.last_ratio"] = tex_numbers.with_error(*ratios(rows, law)[-1])
        made[f"{law}.worst"] = tex_numbers.digits(100.0 * max(abs(mean - 1.0) for mean, _ in ratios(rows, law)), 1)
    return made


def draw(rows: list, folder) -> None:
    points = {
        law: [
            (time, np.mean([row["temperatures"][k] for row in rows if row["law"] == law]))
            for k, time in enumerate(TIMES)
        ]
        for law in TAU
    }
    curve = [(t, theory("viscoelastic", t)) for t in np.geomspace(0.08, 6.0, 40)]
    gnuplot.draw(
        folder,
        "cooling",
        gnuplot.block("c", points["constant"])
        + gnuplot.block("v", points["viscoelastic"])
        + gnuplot.block("curve", curve)
        + r"""
set logscale xy
set xlabel '$t / \tau$'
set ylabel '$T / T_0$'
set xrange [0.08:6]
set yrange [0.025:1.05]
set key bottom left
plot (1+x)**-2 linetype 1 title '$(1 + t/\tau)^{-2}$', $c linetype 1 title '$e$ constant', \
     $curve with lines linetype 2 title 'viscoelastic, theory', $v linetype 2 title '$e = 1 - \alpha w^{1/5}$'
""",
    )
