"""Galperin's collisions: a wall, a disk at rest, and a moving one that is 100^k times as heavy. Their number is
floor(10^k pi)."""

from experiments.program import summary

POWERS = [0, 1, 2, 3, 4]
METHODS = ["exact", "pairwise", "rollback"]


def scene(power: int) -> str:
    return f"""
[box]
width = 1e9
height = 10.0
[[disks]]
count = 2
positions = [[50.0, 5.0], [100.0, 5.0]]
velocities = [[0.0, 0.0], [-1.0, 0.0]]
radius = 1.0
mass = [1.0, {100**power}.0]
[run]
dt = 0.01
t_end = 4000.0
[output]
trajectory = "none"
"""


def run() -> list:
    rows = []
    for method in METHODS:
        for power in POWERS:
            s = summary(scene(power), "--method", method, statuses=(0, 1, 3))
            rows.append(
                {
                    "method": method,
                    "power": power,
                    "collisions": s["collisions"] + s["wall_collisions"],
                    "energy_drift": abs(s["energy_final"] / s["energy_initial"] - 1.0),
                    "state_hash": s["state_hash"],
                }
            )
    return rows


def numbers(rows: list) -> dict:
    """One list of counts for all methods, as they must agree."""
    counts = {method: [row["collisions"] for row in rows if row["method"] == method] for method in METHODS}
    if any(of_method != counts["exact"] for of_method in counts.values()):
        raise RuntimeError(f"counting_pi: the methods do not count alike: {counts}")
    return {"counts": ", ".join(map(str, counts["exact"]))}
