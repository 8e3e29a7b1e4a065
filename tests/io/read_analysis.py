"""Reads the analysis.h5 of a run of analysis_run_test with h5py, compares it with the run's series.csv, checks that it
is consistent, and prints the number of samples."""
import csv
import sys

import h5py
import numpy


def check_origin(file):
    assert file.attrs["creator"].decode().startswith("Carom ")
    assert "[analysis]" in file["parameters/scene"][()].decode()
    assert file["samples/time"].attrs["unit"] == b"time"


def check_histograms(file, time, disks):
    g = file["pair_correlation"]
    assert len(g["r"]) == len(g["g"]) == len(g["pairs"]) and g.attrs["samples"] == len(time)
    assert g["pairs"][:].sum() > 0 and (g["g"][:][g["pairs"][:] == 0] == 0).all()
    speeds = file["speeds"]
    counted = speeds["counts"][:].sum() + speeds.attrs["beyond"]
    assert counted == disks.sum(), f"{counted} speeds of {disks.sum()} disks"
    width = speeds["u"][1] - speeds["u"][0]
    assert abs(speeds["measured"][:].sum() * width - 1.0) < 1e-9


def check_profiles(file, disks):
    density = file["density"]
    assert density["centres"][:].sum() == disks.sum()
    assert density.attrs["axis"] == b"y" and (density["packing_fraction"][:] < 1.0).all()
    profile = file["profile"]
    assert profile["disks"][:].sum() == disks.sum()
    seen = profile["disks"][:] > 0
    assert numpy.isfinite(profile["temperature"][:][seen]).all() and profile["velocity_y"].attrs["unit"] == b"length / time"
    for name, columns in (("profile", ("disks",)), ("density", ())):
        rows = file[name]["rows"]
        assert rows["samples"][:].sum() == file[name].attrs["samples"] and len(rows["time"]) > 1, name
        for column in columns:
            assert (rows[column][:].sum(axis=0) == file[name][column][:]).all(), column
    weights = file["density/rows/samples"][:] / file["density"].attrs["samples"]
    mean = weights @ file["density/rows/packing_fraction"][:]
    assert numpy.allclose(mean, file["density/packing_fraction"][:])


def check_rates(file):
    for name in ("pressure", "collision_rate"):
        value, interval = file[name]["value"][:], file[name]["interval"][:]
        known = numpy.isfinite(value)
        assert not known[0] and (known == (interval > 0.0)).all() and known.any(), name
        assert file[name].attrs["standard_error"] > 0.0
        assert numpy.isclose(file[name].attrs["mean"], numpy.average(value[known], weights=interval[known]))


def check_order_and_memory(file, time):
    assert file["velocity_autocorrelation/value"][0] > 0.0 and len(file["velocity_autocorrelation/value"]) == len(time)
    memory = file["bond_autocorrelation/value"][:]
    assert len(memory) == len(time) and memory[0] == 1.0 and (abs(memory) < 1.5).all()
    order = file["bond_order"]
    assert (order["global"][:] <= order["local"][:]).all() and (order["local"][:] < 1.0).all()
    assert numpy.isclose(order.attrs["local_mean"], order["local"][:].mean())
    bonds = file["bond_correlation"]
    some = bonds["pairs"][:] > 0
    assert some.any() and (abs(bonds["g6"][:][some]) <= 1.0).all() and not numpy.isfinite(bonds["g6"][:][~some]).any()


def check_displacement(file, time):
    squares = file["displacement/mean_square"][:]
    assert squares[0] == 0.0 and (squares[1:] > 0.0).all()
    assert (numpy.diff(file["displacement/disks"][:]) <= 0).all()
    attributes = file["displacement"].attrs
    first = list(time).index(attributes["diffusion_from"])
    dimensions = 1.0 if b"shear" in attributes["meaning"] else 2.0
    slope = (squares[-1] - squares[first]) / (2.0 * dimensions * (time[-1] - time[first]))
    assert numpy.isclose(attributes["diffusion"], slope) and attributes["diffusion_error"] > 0.0


def check_table(file, time, disks, csv_path):
    squares = file["displacement/mean_square"][:]
    with open(csv_path, newline="") as table:
        rows = {float(row["t"]): row for row in csv.DictReader(table)}
    assert list(rows) == list(time), "a row a sample in this run"
    for k, t in enumerate(time):
        assert float(rows[t]["displacement"]) == squares[k], t
        assert int(rows[t]["disks"]) == disks[k], t
        if numpy.isfinite(file["pressure/value"][k]):
            assert float(rows[t]["pressure"]) == file["pressure/value"][k], t
            assert float(rows[t]["collision_rate"]) == file["collision_rate/value"][k], t


def main(h5_path, csv_path):
    with h5py.File(h5_path, "r") as file:
        time, disks = file["samples/time"][:], file["samples/disks"][:]
        check_origin(file)
        check_histograms(file, time, disks)
        check_profiles(file, disks)
        check_rates(file)
        check_order_and_memory(file, time)
        check_displacement(file, time)
        if csv_path:
            check_table(file, time, disks, csv_path)
        print(len(time))


main(*sys.argv[1:])
