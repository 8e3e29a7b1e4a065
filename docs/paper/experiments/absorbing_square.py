"""Brownian disks removed by an absorbing square, with long steps, compared with the series of the diffusion
equation."""

import math

import tex_numbers

SIDE, DIFFUSION, DT, RADIUS = 1.0, 1.0, 0.0025, 0.001
DISKS, SEEDS = 50, 2000
TIMES = [0.01, 0.02, 0.05, 0.1, 0.2]
METHODS = ["exact", "pairwise"]


def theory(tau: float) -> float:
    """The share of a uniform start that is left, with tau = D t / L^2:
    [(8 / pi^2) sum over odd n of exp(-n^2 pi^2 tau) / n^2]^2."""
    total = sum(math.exp(-n * n * math.pi**2 * tau) / (n * n) for n in range(1, 400, 2))
    return (8.0 / math.pi**2 * total) ** 2


def run() -> list:
    import carom

    rows = []
    for method in METHODS:
        left, hashes = [0] * len(TIMES), []
        for seed in range(1, SEEDS + 1):
            box = {"width": SIDE + 2 * RADIUS, "height": SIDE + 2 * RADIUS}
            sim = carom.Simulation(
                carom.Scene(
                    {
                        "seed": seed,
                        "box": box | {side: "sink" for side in ("left", "right", "bottom", "top")},
                        "physics": {"diffusion": DIFFUSION},
                        "disks": [{"count": DISKS, "positions": "random", "radius": RADIUS, "mass": 1.0}],
                        "run": {"method": method, "dt": DT, "t_end": TIMES[-1]},
                    }
                ),
                threads=1,
            )
            for k, time in enumerate(TIMES):
                sim.run(until=time * (1.0 - 1e-9))
                left[k] += len(sim)
            hashes.append(sim.hash)
        rows += [
            {"method": method, "tau": time, "left": count, "of": DISKS * SEEDS, "state_hash": hashes[-1]}
            for time, count in zip(TIMES, left)
        ]
    return rows


def numbers(rows: list) -> dict:
    made = {"disks": tex_numbers.count(DISKS * SEEDS), "dt": str(DT)}
    table, worst = "", 0.0
    for tau in TIMES:
        s = theory(tau)
        of_tau = {row["method"]: row for row in rows if row["tau"] == tau}
        table += f"{tau} & {s:.5f}"
        for method in METHODS:
            row = of_tau[method]
            error = math.sqrt(s * (1.0 - s) / row["of"])
            worst = max(worst, abs(row["left"] / row["of"] - s) / error)
            table += " & " + tex_numbers.with_error(row["left"] / row["of"], error)
        table += " \\\\ "
    made["table"] = table
    made["worst"] = tex_numbers.digits(worst, 1)
    # Walls that absorb only at the ends of steps act as if they were 0.5826 sqrt(2 D dt) further out.
    far = SIDE + 2 * 0.5826 * math.sqrt(2.0 * DIFFUSION * DT)
    made["unseen_last"] = tex_numbers.digits(theory(TIMES[-1] / far**2), 3)
    return made
