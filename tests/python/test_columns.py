"""Columns, properties and options of the module, each checked to differ from similar ones."""

import json
import os
import subprocess

import carom
import numpy as np
import pytest

program = os.environ["CAROM_PROGRAM"]


def mixture(changes={}, **tables):
    """Rough disks that all differ, in a box that is wider than high and periodic only from left to right."""
    return carom.Scene({
        "title": "mixture", "seed": 7,
        "box": {"width": 24.0, "height": 12.0, "left": "periodic", "right": "periodic"},
        "physics": {"roughness": {"tangential_restitution": 0.5}},
        "disks": [
            {"count": 20, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": {"uniform": [0.3, 0.6]},
             "mass": {"uniform": [1.0, 3.0]}, "spin_temperature": 1.0},
            {"count": 10, "positions": "random", "radius": 0.5, "mass": 4.0}],
        "run": {"method": "pairwise", "dt": 0.01, "t_end": 2.0}, **tables}, changes)


def test_a_view_has_the_columns_of_the_copies():
    sim = carom.Simulation(mixture(), threads=1)
    sim.step(50)
    disks = sim.disks()
    assert disks.names == ("x", "y", "vx", "vy", "radius", "mass", "id", "spin", "group")
    assert list(disks.group) == [0] * 20 + [1] * 10, "which a view does not have, as nothing in memory is it"
    with sim.view() as v:
        order = np.argsort(v.id)
        for name in disks.names[:-1]:
            column = getattr(v, name)
            assert not column.flags.writeable and np.array_equal(column[order], getattr(disks, name)), name
    assert len({tuple(getattr(disks, name)) for name in disks.names}) == len(disks.names)


def test_a_scene_knows_its_box():
    scene = mixture({"seed": 9})
    assert (scene.title, scene.width, scene.height, scene.t_end, scene.seed) == ("mixture", 24.0, 12.0, 2.0, 9)
    frame = carom.Simulation(scene, threads=1).disks()
    assert frame.box == (24.0, 12.0) and frame.periodic == (True, False) and frame.t == 0.0
    assert scene.warnings == []
    warned, = mixture({"output.every": 1e-4, "output.series": True}).warnings
    assert warned.startswith("scene: output.every: is 0.0001, shorter than dt = 0.01: ")


def test_tables_within_tables_have_all_their_keys():
    motion = {"vibrate": (0.0, 0.5), "period": 2.0, "shape": "sine"}
    scene = mixture({"box.top": {"place": 11.0, "motion": motion}},
                    box={"width": 24.0, "height": 12.0, "bottom": {"place": 1.0, "motion": motion}})
    assert scene.toml().count('shape = "sine"') == 2 and scene.toml().count("period = 2.0") == 2


def test_counters_are_those_of_the_command_line(tmp_path):
    scene = mixture()
    (tmp_path / "mixture.toml").write_text(scene.toml())
    line = [program, "run", tmp_path / "mixture.toml", "--json", "--quiet", "-o", tmp_path / "run"]
    told = json.loads(subprocess.run(line, check=True, capture_output=True).stdout)
    sim = carom.Simulation(scene, threads=1)
    sim.step(150)
    assert sim.steps == 150
    sim.run()
    assert (sim.steps, sim.collisions, sim.wall_collisions) == (told["steps"], told["collisions"], told["wall_collisions"])
    assert len({sim.steps, sim.collisions, sim.wall_collisions, 0}) == 4
    assert sim.time == told["time"] and sim.hash == told["state_hash"]


def test_changes_reach_the_disk_and_the_column():
    sim = carom.Simulation(mixture(), threads=1)
    for id in range(30):
        sim.remove(id)
    assert sim.add(5.0, 6.0, vx=0.25, vy=-0.5, radius=0.75, mass=2.0, spin=3.0) == 30
    disks = sim.disks()
    assert [float(getattr(disks, name)[0]) for name in disks.names] == [5.0, 6.0, 0.25, -0.5, 0.75, 2.0, 30.0, 3.0, 2.0]
    assert sim.add(12.0, 6.0) == 31
    disks = sim.disks()
    assert [float(getattr(disks, name)[1]) for name in disks.names] == [12.0, 6.0, 0.0, 0.0, 1.0, 1.0, 31.0, 0.0, 2.0]
    sim.remove(31)
    assert sim.set_velocity(30, 1.5, -2.5)
    disks = sim.disks()
    assert (disks.vx[0], disks.vy[0]) == (1.5, -2.5)
    assert sim.nearest(5.0, 8.0) == (30, 2.0) and sim.nearest(23.0, 6.0) == (30, 6.0)
    assert list(sim.disks_in(4.0, 5.0, 6.0, 7.0)) == [30] and len(sim.disks_in(5.5, 5.0, 6.0, 7.0)) == 0


def test_what_a_ray_meets_and_where():
    walls = [{"from": [12.0, 1.0], "to": [12.0, 5.0]}, {"kind": "sink", "from": [8.0, 7.0], "to": [8.0, 11.0]}]
    sim = carom.Simulation(mixture(walls=walls, physics={}, disks=[
        {"count": 1, "positions": [[20.0, 9.0]], "radius": 0.5, "mass": 1.0}]), threads=1)
    assert sim.cast_ray(10.0, 2.0, 3.0, 0.0, 9.0) == carom.Hit(0, 2.0, 12.0, 2.0, "wall")
    assert sim.cast_ray(10.0, 9.0, -1.0, 0.0, 9.0) == carom.Hit(1, 2.0, 8.0, 9.0, "sink")
    assert sim.cast_ray(20.0, 4.0, 0.0, 1.0, 9.0) == carom.Hit(0, 4.5, 20.0, 8.5, "disk")
    assert sim.cast_ray(20.0, 4.0, 0.0, 1.0, 4.0) is None


def test_a_view_holds_off_every_change():
    sim = carom.Simulation(mixture(), threads=1)
    saved = sim.to_bytes()
    with sim.view():
        for change in (lambda: sim.from_bytes(saved), lambda: sim.remove(0), lambda: sim.add(1.0, 1.0),
                       lambda: sim.set_velocity(0, 1.0, 1.0), lambda: sim.step(), lambda: sim.run(until=0.1)):
            with pytest.raises(RuntimeError, match="a view of the disks is open"):
                change()
    sim.from_bytes(saved)


def test_the_time_of_disks_is_said():
    sim = carom.Simulation(mixture(), threads=1)
    sim.step(3)
    assert sim.disks(at=0.025).t == sim.time, "pairwise has but the step's end"
    with pytest.raises(carom.SceneError, match="before the last step"):
        sim.disks(at=0.015)


@pytest.mark.parametrize("form", ["xyz", "h5md"])
def test_frames_have_their_box_and_groups(form, tmp_path):
    scene = mixture({"output.trajectory": form, "output.every": 0.5})
    last = carom.run(scene, out=tmp_path / "run", warn=lambda _: None).frames[-1]
    assert last.box == (24.0, 12.0) and last.periodic == (True, False) and last.t == 2.0
    assert list(last.group) == [0] * 20 + [1] * 10
    sim = carom.Simulation(scene, threads=1)
    sim.run()
    assert "group" in sim.disks().names
    for name in sim.disks().names:
        assert np.array_equal(getattr(last, name), getattr(sim.disks(), name)), name
        assert getattr(last, name).dtype == getattr(sim.disks(), name).dtype, name


def test_options_of_a_run(tmp_path):
    scene = mixture({"output.trajectory": "xyz", "output.every": 0.01, "output.plots": ["energy"]})
    first = carom.run(scene, out=tmp_path / "run", warn=lambda _: None, threads=1, engine="reference")
    assert first.summary["engine"] == "reference"
    (tmp_path / "run" / "summary.json").write_text("{}")
    assert carom.run(scene, out=tmp_path / "run", warn=lambda _: None, force=True).hash == first.hash
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["state_hash"] == first.hash
    page = tmp_path / "page.html"
    first.show(page)
    whole = page.stat().st_size
    first.show(page, max_size=whole - 1000, force=True)
    assert page.stat().st_size <= whole - 1000


def test_a_plot_that_could_not_be_drawn_is_an_error(tmp_path, monkeypatch):
    gnuplot = tmp_path / "gnuplot"
    gnuplot.write_text("#!/bin/sh\nexit 1\n")
    gnuplot.chmod(0o700)
    monkeypatch.setenv("PATH", str(tmp_path))
    scene = mixture({"output.trajectory": "xyz", "output.every": 0.1, "output.plots": ["energy"]})
    with pytest.raises(carom.RunError, match="energy"):
        carom.run(scene, out=tmp_path / "run", warn=lambda _: None)
    assert (tmp_path / "run" / "trajectory.xyz").exists() and (tmp_path / "run" / "summary.json").exists()


@pytest.mark.parametrize("form", ["xyz", "h5md"])
def test_frames_without_disks_have_the_same_columns(form, tmp_path):
    """A loop over f.group or f.spin once failed after a sink had taken the last disk."""
    scene = carom.Scene({
        "box": {"width": 6.0, "height": 6.0, "left": "sink", "bottom": "periodic", "top": "periodic"},
        "physics": {"roughness": {"tangential_restitution": 0.5}},
        "disks": [{"count": 1, "positions": [[2.0, y]], "velocities": [[-2.0, 0.0]], "radius": 0.5, "mass": 1.0}
                  for y in (2.0, 4.0)],
        "run": {"method": "pairwise", "dt": 0.01, "t_end": 4.0}, "output": {"trajectory": form, "every": 1.0}})
    frames = list(carom.run(scene, out=tmp_path / "run", warn=lambda _: None).frames)
    assert len(frames[0]) == 2 and len(frames[-1]) == 0
    assert {"group", "image_x", "image_y", "spin"} < set(frames[0].names)
    for frame in frames:
        assert frame.names == frames[0].names
        assert [getattr(frame, name).dtype for name in frame.names] == [getattr(frames[0], name).dtype for name in frame.names]
        assert len(frame.spin) == len(frame.group) == len(frame.image_x) == len(frame)
    sim = carom.Simulation(scene, threads=1)
    names = sim.disks().names
    with sim.view() as v:
        assert len(v.spin) == 2
    sim.run()
    assert len(sim) == 0 and sim.disks().names == names
    with sim.view() as v:
        assert len(v.spin) == 0
