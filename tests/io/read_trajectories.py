"""Reads a run's trajectory.xyz, with its own code, and the trajectory.h5 of the same run, with h5py, and compares them
bit by bit. Called by trajectory_h5md_test with both files and the scene of the run; reports differences."""
import struct
import sys
import xml.etree.ElementTree

import h5py
import numpy


def read_xyz(path):
    """Frames as (time, periodic, {id: (x, y, vx, vy, radius, mass)}), using only the rules of extended XYZ."""
    frames = []
    with open(path, encoding="ascii") as file:
        while line := file.readline():
            count = int(line)
            header = file.readline()
            keys, rest = {}, header.strip()
            while rest:
                key, rest = rest.split("=", 1)
                if rest[0] == '"':
                    value, rest = rest[1:].split('"', 1)
                else:
                    value, _, rest = rest.partition(" ")
                keys[key.strip()] = value
                rest = rest.strip()
            names = keys["Properties"].split(":")
            columns, at = {}, 0
            for name, kind, width in zip(names[0::3], names[1::3], names[2::3]):
                columns[name] = (at, kind)
                at += int(width)
            disks = {}
            for _ in range(count):
                words = file.readline().split()
                assert len(words) == at, f"{len(words)} words where Properties names {at}"
                pos, vel = columns["pos"][0], columns["velo"][0]
                picked = (pos, pos + 1, vel, vel + 1, columns["radius"][0], columns["mass"][0])
                disks[int(words[columns["id"][0]])] = tuple(float(words[k]) for k in picked)
            frames.append((float(keys["Time"]), keys["pbc"].split(), disks))
    return frames


def bits(value):
    return struct.pack("<d", value)


def check_h5md(file, scene):
    assert list(file["h5md"].attrs["version"]) == [1, 1]
    assert file["h5md/creator"].attrs["name"] == b"Carom"
    assert "version" in file["h5md/creator"].attrs and "name" in file["h5md/author"].attrs
    assert file["parameters/scene"][()].decode() == open(scene, encoding="utf-8").read()
    box = file["particles/disks/box"]
    assert box.attrs["dimension"] == 2 and len(box.attrs["boundary"]) == 2 and box["edges"].shape == (2,)
    for name in ("position", "velocity", "id"):
        value = file[f"particles/disks/{name}/value"]
        assert value.compression == "gzip" and value.shuffle, name
        assert file[f"particles/disks/{name}/time"] == file["particles/disks/position/time"], name
    steps = file["particles/disks/position/step"][:]
    assert (numpy.diff(steps) > 0).all()


def main(xyz_path, h5_path, scene):
    frames = read_xyz(xyz_path)
    with h5py.File(h5_path, "r") as file:
        check_h5md(file, scene)
        disks = file["particles/disks"]
        times = disks["position/time"][:]
        assert len(times) == len(frames), f"{len(times)} frames against {len(frames)}"
        boundary = [word.decode() for word in disks["box"].attrs["boundary"]]
        radius, mass, species = disks["radius"][:], disks["mass"][:], disks["species"][:]
        observed = file["observables/disks/value"][:]
        for k, (time, periodic, expected) in enumerate(frames):
            assert bits(times[k]) == bits(time), f"frame {k}: time {times[k]} against {time}"
            assert boundary == ["periodic" if p == "T" else "none" for p in periodic[:2]]
            ids = disks["id/value"][k]
            position, velocity = disks["position/value"][k], disks["velocity/value"][k]
            present = numpy.flatnonzero(ids != disks["id/value"].fillvalue)
            assert len(present) == len(expected) == observed[k], f"frame {k}: {len(present)} disks"
            gone = numpy.setdiff1d(numpy.arange(len(ids)), present)
            assert numpy.isnan(position[gone]).all() and numpy.isnan(velocity[gone]).all()
            for place in present:
                found = (*position[place], *velocity[place], radius[place], mass[place])
                for a, b in zip(found, expected[ids[place]]):
                    assert bits(a) == bits(b), f"frame {k}, disk {ids[place]}: {a} against {b}"
        lines = ["species {}".format(" ".join(map(str, species[:3]))), f"places {len(radius)}"]
    grids = xml.etree.ElementTree.parse(h5_path[:-3] + ".xdmf").findall(".//Grid/Grid")
    assert [float(grid.find("Time").get("Value")) for grid in grids] == [frame[0] for frame in frames]
    print("\n".join(lines))


main(*sys.argv[1:])
