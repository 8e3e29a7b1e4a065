"""The result of a run, with a trajectory in either format."""

import carom
import pytest


@pytest.fixture(scope="session", params=["xyz", "h5md"])
def result(request, tmp_path_factory):
    scene = carom.Scene({
        "title": "gas <b>",
        "box": {"packing_fraction": 0.4, "left": "periodic", "right": "periodic"},
        "disks": [{"count": 100, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 2.0}],
        "run": {"method": "exact", "t_end": 4.0},
        "output": {"trajectory": request.param, "series": True, "every": 0.5},
        "analysis": {"what": ["pair_correlation", "pressure", "bond_order"], "every": 0.25},
    })
    return carom.run(scene, out=tmp_path_factory.mktemp("results") / "run")
