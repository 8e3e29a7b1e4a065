"""Reads a run's trajectory.xyz with ASE and MDAnalysis, and its trajectory.h5 (dimensions = 3) with MDAnalysis, if
there is one, and compares them with the numbers in the text. Called by trajectory_programs_test; reports
differences."""
import sys
import warnings

warnings.simplefilter("ignore")  # MDAnalysis warns of masses that it cannot guess from an element

import ase.io  # noqa: E402
import h5py  # noqa: E402
import MDAnalysis  # noqa: E402
import numpy  # noqa: E402


def read_text(path):
    """Frames as (header, columns by name), from the file's text, split only at spaces."""
    frames = []
    with open(path, encoding="ascii") as file:
        while line := file.readline():
            header = file.readline()
            words = header.split("Properties=")[1].split()[0].split(":")
            table = numpy.array([file.readline().split()[1:] for _ in range(int(line))], dtype=float)
            columns, at = {}, 0
            for name, width in zip(words[3::3], map(int, words[5::3])):
                columns[name] = table[:, at:at + width]
                at += width
            frames.append((float(header.split("Time=")[1]), columns))
    return frames


def check_ase(path, frames):
    read = ase.io.read(path, index=":")
    assert len(read) == len(frames), f"ASE reads {len(read)} frames of {len(frames)}"
    for atoms, (time, columns) in zip(read, frames):
        assert atoms.info["Time"] == time and set(atoms.symbols) == {"X"}
        assert (atoms.positions == columns["pos"]).all(), "positions in ASE"
        assert (atoms.arrays["velo"] == columns["velo"]).all(), "velocities in ASE"
        for name in ("radius", "mass", "id", "group", "map_shift"):
            if name in columns:
                assert (atoms.arrays[name].reshape(columns[name].shape) == columns[name]).all(), name
    print("cell", *read[-1].cell.lengths(), "pbc", *read[-1].pbc)


def check_same(found, expected, what):
    assert (found == expected.astype(numpy.float32)).all(), f"{what} in MDAnalysis: {found[0]} against {expected[0]}"


def check_mdanalysis(universe, frames, velocities):
    assert len(universe.trajectory) == len(frames)
    for step, (time, columns) in zip(universe.trajectory, frames):
        check_same(step.positions, columns["pos"], "positions")
        if velocities:
            check_same(step.velocities, columns["velo"], "velocities")
            assert step.time == time, f"{step.time} against {time}"
    print("dimensions", universe.dimensions)


def main(xyz_path, h5_path=None):
    frames = read_text(xyz_path)
    check_ase(xyz_path, frames)
    check_mdanalysis(MDAnalysis.Universe(xyz_path), frames, False)
    if h5_path is None:
        return
    universe = MDAnalysis.Universe.empty(len(frames[0][1]["pos"]), trajectory=True)
    universe.load_new(h5_path, format="H5MD", convert_units=False)
    check_mdanalysis(universe, frames, True)
    with h5py.File(h5_path, "r") as file:
        disks = file["particles/disks"]
        box = disks["box"]
        assert box.attrs["dimension"] == 3 and len(box.attrs["boundary"]) == 3
        assert box["edges/time"] == disks["position/time"] and box["edges/step"] == disks["position/step"]
        for k, (_, columns) in enumerate(frames):
            assert (disks["image/value"][k] == columns["map_shift"]).all(), "image"


main(*sys.argv[1:])
