"""The viscosity of elastic disks in a homogeneous shear flow, compared with Enskog's theory."""

import math

import numpy as np

import tex_numbers
from experiments.gas import periodic_gas

DISKS, RATE, T_END, SEEDS = 2000, 0.1, 150.0, 8
PACKINGS = [0.1, 0.2, 0.3]


def enskog(packing: float) -> float:
    """The viscosity divided by the root of the temperature, for diameter 1 and mass 1 (Gass 1971; Garcia-Rojo, Luding
    and Brey 2006)."""
    chi = (1.0 - 7.0 * packing / 16.0) / (1.0 - packing) ** 2
    dilute = 1.022 / (2.0 * math.sqrt(math.pi))
    return dilute * (1.0 / chi + 2.0 * packing + (1.0 + 8.0 / math.pi) * chi * packing * packing)


def measured(packing: float, seed: int) -> dict:
    import carom
    from experiments.program import scratch

    scene = carom.Scene(
        periodic_gas(
            DISKS,
            packing,
            seed,
            t_end=T_END,
            box={"shear_rate": RATE},
            output={"every": 0.25, "series": True, "trajectory": "none"},
        )
    )
    with scratch() as folder:
        result = carom.run(scene, out=folder / "out", threads=1, warn=lambda _: None)
        series = result.series
    late = series["t"] > 5.0
    viscosity = series["shear_stress"][late] / RATE
    return {
        "packing": packing,
        "seed": seed,
        "viscosity": float(np.mean(viscosity / np.sqrt(series["temperature"][late]))),
        "state_hash": result.hash,
    }


def run() -> list:
    return [measured(packing, seed) for packing in PACKINGS for seed in range(1, SEEDS + 1)]


def numbers(rows: list) -> dict:
    made = {
        "disks": tex_numbers.count(DISKS),
        "rate": str(RATE),
        "packings": ", ".join(map(str, PACKINGS[:-1])) + f" and {PACKINGS[-1]}",
    }
    for packing in PACKINGS:
        over = np.array([row["viscosity"] for row in rows if row["packing"] == packing]) / enskog(packing)
        made[f"over_enskog_{packing}"] = tex_numbers.with_error(over.mean(), over.std(ddof=1) / math.sqrt(SEEDS))
    return made
