"""A gas for tests that need any scene."""

import carom


def gas(disks=200, **run):
    return carom.Scene({
        "title": "gas",
        "box": {"packing_fraction": 0.3},
        "disks": [{"count": disks, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 1.0}],
        "run": {"method": "pairwise", "dt": 0.01, "t_end": 5.0} | run,
    })
