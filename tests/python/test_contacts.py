"""Contacts of the last step as a numpy column, and queries for fixed disks."""

import carom
import numpy as np


def gas(method, **box):
    return carom.Scene({
        "box": {"packing_fraction": 0.3} | box,
        "disks": [{"count": 100, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 1.0}],
        "run": {"method": method, "dt": 0.02, "t_end": 5.0},
    })


def test_contacts_are_the_collisions_of_the_window():
    sim = carom.Simulation(gas("exact"), threads=1)
    assert len(sim.contacts()) == 0
    before = sim.collisions
    sim.step(3)
    windows = sim.collisions
    sim.step()
    met = sim.contacts()
    assert len(met) == sim.collisions - windows > 0 and windows > before
    assert (met["id1"] < met["id2"]).all() and (np.diff(met["time"]) >= 0).all()
    i = len(met) // 2
    d = sim.disks(at=met["time"][i])
    a, b = met["id1"][i], met["id2"][i]
    assert abs(np.hypot(d.x[a] - d.x[b], d.y[a] - d.y[b]) - 1.0) < 1e-9
    sim.set_velocity(0, 0.0, 0.0)
    assert len(sim.contacts()) == 0


def test_fixed_disks_are_seen():
    scene = carom.Scene({
        "box": {"width": 20.0, "height": 10.0},
        "disks": [{"count": 1, "positions": [[3.0, 5.0]], "velocities": [[0.0, 0.0]], "radius": 1.0, "mass": 1.0},
                  {"count": 1, "positions": [[10.0, 5.0]], "radius": 2.0, "fixed": True}],
        "run": {"t_end": 1.0},
    })
    sim = carom.Simulation(scene, threads=1)
    assert sim.nearest(11.0, 5.0) == (1, 1.0)
    assert sim.cast_ray(5.0, 5.0, 1.0, 0.0, 10.0) == carom.Hit(1, 3.0, 8.0, 5.0)
    assert list(sim.disks_in(0.0, 0.0, 20.0, 10.0)) == [0, 1]
    assert sim.add(12.2, 5.0, radius=0.5) is None


def test_rays_end_at_inner_walls():
    scene = carom.Scene({
        "box": {"width": 20.0, "height": 10.0},
        "walls": [{"from": [6.0, 1.0], "to": [6.0, 9.0]}],
        "disks": [{"count": 1, "positions": [[10.0, 5.0]], "velocities": [[0.0, 0.0]], "radius": 1.0, "mass": 1.0}],
        "run": {"t_end": 1.0},
    })
    sim = carom.Simulation(scene, threads=1)
    assert sim.cast_ray(5.0, 5.0, 1.0, 0.0, 10.0) == carom.Hit(0, 1.0, 6.0, 5.0, "wall")
    assert sim.cast_ray(7.0, 5.0, 1.0, 0.0, 10.0) == carom.Hit(0, 2.0, 9.0, 5.0, "disk")


def test_rough_disks_come_with_a_spin():
    scene = carom.Scene({
        "box": {"width": 20.0, "height": 10.0},
        "physics": {"roughness": {"tangential_restitution": 0.5}},
        "disks": [{"count": 1, "positions": [[10.0, 5.0]], "radius": 1.0, "mass": 1.0, "spin": 2.0}],
        "run": {"t_end": 1.0},
    })
    sim = carom.Simulation(scene, threads=1)
    assert sim.add(5.0, 5.0, radius=0.5, spin=-3.0) == 1
    assert list(sim.disks().spin) == [2.0, -3.0]
