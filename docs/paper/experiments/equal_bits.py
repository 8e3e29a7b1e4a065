"""The example scenes on the reference and on the engine: on 1 to 8 threads, with the kernels for any processor, saved and
resumed halfway, on ranks. One hash of the state at the end each."""

import json
import tomllib

import tex_numbers
from experiments.program import ROOT, RELEASE, run as run_program, scratch

SHARE = 0.05  # of the scene's own length
GAS = """
[box]
packing_fraction = {packing}
left = "{side}"
right = "{side}"
bottom = "periodic"
top = "periodic"
[[disks]]
count = {disks}
positions = "random"
velocities = {{ maxwell = 1.0 }}
radius = 0.5
mass = 1.0
[run]
method = "{method}"
dt = 0.005
t_end = {t_end}
"""
LARGE = {  # of the sizes at which threads have parts, regions, and many blocks
    "gas in parts": GAS.format(packing=0.5, side="periodic", disks=200_000, method="exact", t_end=40.0),
    "leaking gas in regions": GAS.format(packing=0.3, side="sink", disks=120_000, method="exact", t_end=40.0),
    "gas by steps": GAS.format(packing=0.5, side="periodic", disks=100_000, method="pairwise", t_end=20.0),
}
THREADS = [1, 2, 3, 8]
RANKS = [2, 3]
SKIPPED = {"gas_million"}  # an hour with the reference
QUIET = ["output.movie=false", "output.plots=[]", "output.series=false"]


def changes_of(file) -> dict:
    """Keys that make the scene shorter."""
    own = tomllib.loads(file.read_text())
    start = {"analysis.start": 0.0} if "start" in own.get("analysis", {}) else {}
    return {"run.t_end": SHARE * own["run"]["t_end"], **start}


def by_command(file, *arguments, environment={}):
    """The hash of `carom run`, or None where it refuses (not all scenes can be shared by ranks)."""
    changes = [*QUIET, *(f"{key}={value}" for key, value in changes_of(file).items())]
    options = [word for change in changes for word in ("--set", change)]
    with scratch() as folder:
        said = run_program(
            RELEASE / "carom",
            "run",
            file,
            "-o",
            folder / "out",
            "--json",
            "--quiet",
            *options,
            *arguments,
            environment=environment,
            statuses=(0, 2),
        )
    return json.loads(said)["state_hash"] if said else None


def resumed(scene, half: float) -> str:
    """Half of the run on one thread, the rest on two."""
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
    rows = [of_scene(file) for file in sorted((ROOT / "scenes").glob("*.toml")) if file.stem not in SKIPPED]
    with scratch() as folder:
        for name, text in LARGE.items():
            file = folder / f"{name}.toml"
            file.write_text(text)
            rows.append(of_scene(file))
    return rows


def numbers(rows: list) -> dict:
    hashes = [(h, row["state_hash"]) for row in rows for way, h in row["hashes"].items() if way != "reference"]
    large = [row for row in rows if row["scene"] in LARGE]
    return {
        "scenes": str(len(rows)),
        "compared": str(len(hashes)),
        "different": str(sum(h != reference for h, reference in hashes)) if any(h != r for h, r in hashes) else "none",
        "collisions": tex_numbers.significant(sum(row["collisions"] for row in rows), 2),
        "large": str(len(large)),
        "of_large": tex_numbers.significant(sum(row["collisions"] for row in large), 2),
    }
