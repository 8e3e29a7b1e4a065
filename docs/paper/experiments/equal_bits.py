"""The example scenes on the reference and on the engine: with 1 to 8 threads, with the kernels for any processor, saved
and resumed halfway, and on ranks. A row has the hash of the final state for each."""

import tomllib

import tex_numbers
from experiments.gas import periodic_gas
from experiments.program import ROOT, scratch, summary

SHARE = 0.05  # of the scene's own t_end
LARGE = {  # large enough for parts of threads, for regions, and for many blocks
    "gas in parts": periodic_gas(200_000, 0.5, t_end=40.0),
    "leaking gas in regions": periodic_gas(120_000, 0.3, t_end=40.0, box={"left": "sink", "right": "sink"}),
    "gas by steps": periodic_gas(100_000, 0.5, t_end=20.0, method="pairwise", dt=0.005),
}
THREADS = [1, 2, 3, 8]
RANKS = [2, 3]
SKIPPED = {"gas_million"}  # it would take the reference too long
QUIET = ["output.movie=false", "output.plots=[]", "output.series=false"]


def changes_of(file) -> dict:
    """Changes of keys that make the scene shorter."""
    own = tomllib.loads(file.read_text())
    start = {"analysis.start": 0.0} if "start" in own.get("analysis", {}) else {}
    return {"run.t_end": SHARE * own["run"]["t_end"], **start}


def by_command(file, *arguments, environment={}):
    """The hash of `carom run`, or None if it refuses the scene (not all scenes can be shared by ranks)."""
    changes = [*QUIET, *(f"{key}={value}" for key, value in changes_of(file).items())]
    options = [word for change in changes for word in ("--set", change)]
    made = summary(file, *options, *arguments, environment=environment, statuses=(0, 2))
    return made and made["state_hash"]


def resumed(scene, half: float) -> str:
    """The hash of a run whose first half uses one thread, and the rest two."""
    import carom

    first = carom.Simulation(scene, threads=1)
    first.run(until=half)
    second = carom.Simulation(scene, threads=2)
    second.from_bytes(first.to_bytes())
    second.run()
    return second.hash


def of_scene(file) -> dict:
    import carom

    changes = changes_of(file)
    scene = carom.Scene.load(file, changes)

    def in_process(**how):
        sim = carom.Simulation(scene, **how)
        sim.run()
        return sim

    reference = in_process(engine="reference")
    hashes = {"reference": reference.hash}
    for threads in THREADS:
        hashes[f"{threads} threads"] = in_process(threads=threads).hash
    hashes["resumed"] = resumed(scene, 0.5 * changes["run.t_end"])
    hashes["baseline kernels"] = by_command(file, "--threads", 2, environment={"CAROM_KERNELS": "baseline"})
    for ranks in RANKS:
        of_ranks = by_command(file, "--ranks", ranks, "--threads", 1)
        if of_ranks:
            hashes[f"{ranks} ranks"] = of_ranks
    s = reference.summary
    return {
        "scene": file.stem,
        "method": s["method"],
        "disks": s["particles"],
        "collisions": s["collisions"],
        "hashes": hashes,
        "state_hash": reference.hash,
    }


def run() -> list:
    import carom

    rows = [of_scene(file) for file in sorted((ROOT / "scenes").glob("*.toml")) if file.stem not in SKIPPED]
    with scratch() as folder:
        for name, scene in LARGE.items():
            file = folder / f"{name}.toml"
            file.write_text(carom.Scene(scene).toml())
            rows.append(of_scene(file))
    return rows


def numbers(rows: list) -> dict:
    hashes = [(h, row["state_hash"]) for row in rows for way, h in row["hashes"].items() if way != "reference"]
    different = sum(h != reference for h, reference in hashes)
    return {
        "scenes": str(len(rows)),
        "compared": str(len(hashes)),
        "different": str(different) if different else "none",
        "collisions": tex_numbers.significant(sum(row["collisions"] for row in rows), 2),
    }
