"""A sweep over many machines with dask.distributed (Debian: python3-distributed): the equation of state of hard disks.

    sweep_dask.py                       # two workers on this machine
    sweep_dask.py tcp://head:8786       # those of a cluster: `dask-scheduler` on head, `dask-worker tcp://head:8786` elsewhere

Each run uses one thread of a worker, and gives the same bits on any of them.
"""

import contextlib
import sys

import carom
from dask.distributed import Client, LocalCluster


def gas(packing_fraction, seed):
    return carom.Scene({
        "seed": seed,
        "box": {"packing_fraction": packing_fraction, "left": "periodic", "right": "periodic", "bottom": "periodic",
                "top": "periodic"},
        "disks": [{"count": 500, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 1.0}],
        "run": {"method": "exact", "t_end": 20.0},
    })


def compressibility(scene):
    """Z = P V / (N k T) of a run, and its hash. Called on the workers."""
    s = carom.run(scene, threads=1, warn=lambda _: None).summary
    n = s["particles"]
    return s["pressure"] * scene.width * scene.height / s["energy_final"] * (n - 1) / n, s["state_hash"]


def main():
    fractions, seeds = (0.1, 0.2, 0.3), (1, 2, 3, 4)
    scenes = [gas(f, seed) for f in fractions for seed in seeds]
    with contextlib.ExitStack() as open_until_done:  # a cluster given by its address is not stopped
        address = sys.argv[1] if len(sys.argv) > 1 else open_until_done.enter_context(
            LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None))
        client = open_until_done.enter_context(Client(address))
        runs = client.gather(client.map(compressibility, scenes))
    for k, f in enumerate(fractions):
        values = [z for z, _ in runs[k * len(seeds):(k + 1) * len(seeds)]]
        print(f"{f} {sum(values) / len(values):.4f}")
    print("hashes", *(state_hash for _, state_hash in runs))


if __name__ == "__main__":
    main()
