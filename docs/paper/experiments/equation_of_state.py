"""Compressibility factor of equal disks, from the virial of collisions and from their number, against published values.

Z = P V / (N kT). The series of Clisby and McCoy (2006) is continued by a Pade approximant. At 0.67 a Monte Carlo value
is better; for it the system is as small as the published one.
"""

import math

import numpy as np

import tex_numbers
from experiments.gas import periodic_gas

DISKS = 4096
PACKINGS = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.67]
BLOCKS = 20
COLLISIONS_A_DISK = 400  # in each block
VIRIAL = [1, 2, 3.12802, 4.25785, 5.33690, 6.36296, 7.35186, 8.31910, 9.27214, 10.21629]
MONTE_CARLO = {0.67: (870, 9.36234)}  # Li et al. (2022), with the number of disks


def pade(coefficients: list, packing: float, below: int = 5) -> float:
    """The series as a ratio of two polynomials; the denominator has degree `below`."""
    c = np.array(coefficients, float)
    above = len(c) - 1 - below
    columns = range(1, below + 1)
    system = [[c[above + row - k] if k <= above + row else 0.0 for k in columns] for row in range(1, below + 1)]
    lower = np.concatenate([[1.0], np.linalg.solve(system, -c[above + 1 :])])
    upper = [sum(lower[k] * c[n - k] for k in range(min(n, below) + 1)) for n in range(above + 1)]
    return float(np.polyval(upper[::-1], packing) / np.polyval(lower[::-1], packing))


def published(packing: float) -> float:
    return MONTE_CARLO[packing][1] if packing in MONTE_CARLO else pade(VIRIAL, packing)


def uncertainty(packing: float) -> float:
    """The uncertainty of the published value: 3e-5 by Li et al., otherwise the greatest difference of approximants of
    other degrees."""
    if packing in MONTE_CARLO:
        return 3e-5
    return max(abs(pade(VIRIAL, packing, below) - published(packing)) for below in (3, 4, 6))


def disks_of(packing: float) -> int:
    return MONTE_CARLO[packing][0] if packing in MONTE_CARLO else DISKS


def of_finite_box(packing: float) -> float:
    """The excess of the series, which is for an infinite system, over a periodic box with a fixed number of disks: phi
    M' / (2 N M) with M = d (phi Z) / d phi (Lebowitz and Percus 1961)."""
    if packing in MONTE_CARLO:
        return 0.0
    h = 1e-3
    below, at, above = (p * pade(VIRIAL, p) for p in (packing - h, packing, packing + h))
    return packing * ((above - 2.0 * at + below) / h**2) / ((above - below) / (2.0 * h)) / (2.0 * DISKS)


def collision_rate(z: float) -> float:
    """The rate for each disk, at temperature 1."""
    return 4.0 * (z - 1.0) / math.sqrt(math.pi)


def measured(packing: float) -> dict:
    import carom

    disks = disks_of(packing)
    span = COLLISIONS_A_DISK * DISKS / disks / collision_rate(published(packing))
    scene = periodic_gas(disks, packing, t_end=(BLOCKS + 3) * span, positions="growth")
    sim = carom.Simulation(carom.Scene(scene), threads=1)
    area = disks * math.pi / 4.0 / packing
    temperature = disks / (disks - 1)  # the total momentum is zero
    by_virial, by_number, before = [], [], None
    for block in range(BLOCKS + 1):
        sim.run(until=(2 + block) * span)
        s = sim.summary
        now = (s["time"], s["pressure"] * s["time"], s["collisions"])
        if before:
            time, impulse, collisions = (b - a for a, b in zip(before, now))
            by_virial.append(1.0 + (impulse / time * area - disks) / (disks * temperature))
            rate = 2.0 * collisions / (time * disks) / math.sqrt(temperature)
            by_number.append(1.0 + rate * math.sqrt(math.pi) / 4.0)
        before = now
    error = [float(np.std(z, ddof=1)) / math.sqrt(BLOCKS) for z in (by_virial, by_number)]
    return {
        "packing": packing,
        "disks": disks,
        "collisions": s["collisions"],
        "z_virial": float(np.mean(by_virial)),
        "z_virial_error": error[0],
        "z_number": float(np.mean(by_number)),
        "z_number_error": error[1],
        "energy_drift": abs(s["energy_final"] / s["energy_initial"] - 1.0),
        "state_hash": s["state_hash"],
    }


def run() -> list:
    return [measured(packing) for packing in PACKINGS]


def deviation(row: dict, of: str) -> float:
    """The deviation from the published value."""
    return row[of] + of_finite_box(row["packing"]) - published(row["packing"])


def numbers(rows: list) -> dict:
    made = {
        "disks": tex_numbers.count(DISKS),
        "fewer": tex_numbers.count(MONTE_CARLO[0.67][0]),
        "blocks": str(BLOCKS),
        "a_value": tex_numbers.significant(rows[0]["collisions"], 2),
    }
    table, far, in_errors = "", 0.0, 0.0
    for row in rows:
        packing = row["packing"]
        z, unsure = published(packing), uncertainty(packing)
        cells = [tex_numbers.digits(packing, 2), tex_numbers.with_error(z, unsure) if unsure > 1e-6 else f"{z:.6f}"]
        for of in ("z_virial", "z_number"):
            cells.append(tex_numbers.with_error(row[of] + of_finite_box(packing), row[of + "_error"]))
            far = max(far, abs(deviation(row, of)) / z)
            in_errors = max(in_errors, abs(deviation(row, of)) / math.hypot(row[of + "_error"], unsure))
        table += " & ".join(cells) + " \\\\ "
    made["table"] = table
    made["worst"] = tex_numbers.significant(far, 1)
    made["worst_in_errors"] = tex_numbers.digits(in_errors, 1)
    made["collisions"] = tex_numbers.significant(sum(row["collisions"] for row in rows), 2)
    made["energy_drift"] = tex_numbers.significant(max(row["energy_drift"] for row in rows), 1)
    return made
