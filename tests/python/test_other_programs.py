"""Frames and trajectories are read by ASE, MDAnalysis, GSD and freud."""

import os

import carom
import numpy as np
import pytest


def test_ase_writes_the_frames_that_it_takes(result, tmp_path):
    ase_io = pytest.importorskip("ase.io")
    ase_io.write(tmp_path / "gas.xyz", result.frames.to_ase())
    assert np.array_equal(ase_io.read(tmp_path / "gas.xyz", index=8).get_array("id"), result.frames[8].id)


def test_ase_takes_frames(result):
    ase = pytest.importorskip("ase")
    frames = list(result.frames)
    atoms = result.frames.to_ase()
    assert len(atoms) == len(frames) == 9 and isinstance(atoms[0], ase.Atoms)
    frame, last = frames[-1], atoms[-1]
    assert np.array_equal(last.get_array("radius"), frame.radius) and np.array_equal(last.get_array("id"), frame.id)
    assert np.array_equal(last.positions, frame.positions3d())
    assert np.allclose(last.get_velocities()[:, 0], frame.vx) and (last.get_masses() == 2.0).all()
    assert list(last.pbc) == [True, False, False] and np.allclose(last.cell.lengths(), [*frame.box, 0.0])
    # The distance across the periodic side, as ASE computes it.
    i, j = np.argmin(frame.x), np.argmax(frame.x)
    dx = frame.x[i] + frame.box[0] - frame.x[j]
    assert np.isclose(last.get_distance(i, j, mic=True), np.hypot(dx, frame.y[i] - frame.y[j]))


def test_mdanalysis_takes_trajectories(result):
    pytest.importorskip("MDAnalysis")
    frames = list(result.frames)
    universe = result.frames.to_mdanalysis()
    assert len(universe.trajectory) == len(frames) and (universe.atoms.masses == 2.0).all()
    assert (universe.atoms.radii == 0.5).all()
    for frame, step in zip(frames, universe.trajectory):
        assert np.array_equal(step.positions, frame.positions3d().astype(np.float32))
        assert np.array_equal(step.velocities[:, 1], frame.vy.astype(np.float32))
        assert np.isclose(step.time, frame.t)
        assert np.allclose(step.dimensions, [*frame.box, 1.0, 90.0, 90.0, 90.0])


def test_gsd_takes_frames(result, tmp_path):
    hoomd = pytest.importorskip("gsd.hoomd")
    frames = list(result.frames)
    result.frames.to_gsd(tmp_path / "run.gsd")
    with hoomd.open(str(tmp_path / "run.gsd"), "rb") as file:
        assert len(file) == len(frames)
        read = file[8]
    frame = frames[8]
    assert frame.to_gsd().configuration.step == 0
    read.validate()
    assert read.configuration.dimensions == 2 and read.configuration.step == 8
    assert np.allclose(read.configuration.box, [*frame.box, 0, 0, 0, 0])
    half = np.array([*frame.box, 0.0]) / 2
    assert np.allclose(read.particles.position + half, frame.positions3d(), atol=1e-5)
    assert (np.abs(read.particles.position) <= half.astype(np.float32)).all()
    assert read.particles.types == ["group 0"] and (read.particles.typeid == 0).all()
    assert (read.particles.diameter == 1.0).all() and (read.particles.mass == 2.0).all()
    assert np.allclose(read.particles.velocity[:, 0], frame.vx)


def test_gsd_has_the_groups_as_types():
    pytest.importorskip("gsd.hoomd")
    columns = {name: np.arange(3.0) for name in ("x", "y", "vx", "vy")}
    columns |= {"radius": np.ones(3), "mass": np.ones(3), "id": np.arange(3), "group": np.array([0, 2, 1])}
    particles = carom.Frame(0.0, 10.0, 10.0, False, False, columns).to_gsd().particles
    assert particles.types == ["group 0", "group 1", "group 2"] and list(particles.typeid) == [0, 2, 1]


def test_gsd_says_why_a_file_cannot_be_written(result, tmp_path):
    pytest.importorskip("gsd.hoomd")
    with pytest.raises(IsADirectoryError):
        result.frames.to_gsd(tmp_path)
    with pytest.raises(FileNotFoundError):
        result.frames.to_gsd(tmp_path / "no folder" / "run.gsd")
    result.frames.to_gsd(os.fsencode(tmp_path / "run.gsd"))
    assert (tmp_path / "run.gsd").exists()


def test_gsd_replaces_no_file_unasked(result, tmp_path):
    pytest.importorskip("gsd.hoomd")
    other = tmp_path / "trajectory.xyz"
    other.write_text("of another run")
    with pytest.raises(carom.SceneError, match="exists already; choose another file, or replace it with force=True"):
        result.frames.to_gsd(other)
    assert other.read_text() == "of another run"
    result.frames.to_gsd(other, force=True)
    assert other.read_bytes() != b"of another run"


def test_gsd_leaves_no_part_of_a_file(tmp_path):
    pytest.importorskip("gsd.hoomd")
    from carom import _export

    columns = {name: np.arange(3.0) for name in ("x", "y", "vx", "vy")}
    columns |= {"radius": np.ones(3), "mass": np.ones(3), "id": np.arange(3)}

    def frames():
        yield carom.Frame(0.0, 10.0, 10.0, False, False, columns)
        raise KeyError("on the way")

    path = tmp_path / "run.gsd"
    for before in (None, "of another run"):
        if before:
            path.write_text(before)
        with pytest.raises(KeyError):
            _export.write_gsd(path, frames(), True)
        assert [file.name for file in tmp_path.iterdir()] == ([path.name] if before else [])
        assert not before or path.read_text() == before


def test_gsd_has_the_rounds_across_periodic_sides(result, tmp_path):
    """If positions are unwrapped with these, as programs do for displacements, no disk jumps by half the box between
    two frames."""
    hoomd = pytest.importorskip("gsd.hoomd")
    result.frames.to_gsd(tmp_path / "run.gsd")
    with hoomd.open(str(tmp_path / "run.gsd"), "rb") as file:
        read = [snapshot for snapshot in file]
    for frame, snapshot in zip(result.frames, read):
        assert np.array_equal(snapshot.particles.image[:, 0], frame.image_x)
    assert any(snapshot.particles.image.any() for snapshot in read)
    size = read[0].configuration.box[0]
    for a, b in zip(read, read[1:]):
        moved = b.particles.position - a.particles.position + size * (b.particles.image - a.particles.image)
        assert (np.abs(moved[:, 0]) < size / 2).all()


def test_freud_gets_a_box_and_points(result):
    box, points = result.frames[3].to_freud()
    assert points.dtype == np.float32 and points.shape == (100, 3) and (points[:, 2] == 0.0).all()
    assert (np.abs(points[:, :2]) <= box / 2).all() and np.allclose(box, result.frames[3].box)
    freud = pytest.importorskip("freud")
    assert freud.density.LocalDensity(2.0, 1.0).compute((box, points)).density.shape == (100,)


def test_an_edge_stays_inside_where_points_are_rounded():
    n = 3
    columns = {"x": np.array([0.0, np.nextafter(10.1, 0), 5.0]), "y": np.zeros(n), "vx": np.zeros(n), "vy": np.zeros(n),
               "radius": np.ones(n), "mass": np.ones(n), "id": np.arange(n)}
    _, points = carom.Frame(0.0, 10.1, 4.0, True, True, columns).to_freud()
    assert points[0, 0] == -np.float32(5.05) and points[1, 0] == np.nextafter(np.float32(5.05), np.float32(0.0))


@pytest.mark.parametrize("stepping", [{}, {"run.method": "pairwise", "run.dt": 0.1}])
def test_mdanalysis_has_the_time_of_each_frame(stepping, tmp_path):
    pytest.importorskip("MDAnalysis")
    scene = carom.Scene({
        "box": {"width": 9.0, "height": 9.0},
        "disks": [{"count": 3, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 1.0}],
        "run": {"t_end": 1.0}, "output": {"trajectory": "xyz", "every": 0.25 if stepping else 0.3}}, stepping)
    frames = carom.run(scene, out=tmp_path / "run", warn=lambda _: None).frames
    times = [frame.t for frame in frames]
    assert len(set(np.diff(times).round(9))) > 1
    universe = frames.to_mdanalysis()
    for trajectory in (universe.trajectory, universe.copy().trajectory):
        assert [step.time for step in trajectory] == times
        assert trajectory[-1].time == times[-1] and trajectory.dt == times[1] - times[0]


def test_mdanalysis_takes_a_single_frame(tmp_path):
    pytest.importorskip("MDAnalysis")
    scene = carom.Scene({"box": {"width": 9.0, "height": 9.0}, "run": {"t_end": 0.0}, "output": {"trajectory": "xyz"},
                         "disks": [{"count": 3, "positions": "random", "radius": 0.5, "mass": 1.0}]})
    universe = carom.run(scene, out=tmp_path / "run").frames.to_mdanalysis()
    assert [step.time for step in universe.trajectory] == [0.0]


def test_mdanalysis_needs_the_same_disks_in_all_frames(tmp_path):
    pytest.importorskip("MDAnalysis")
    scene = carom.Scene({
        "box": {"width": 6.0, "height": 6.0, "right": "sink"},
        "disks": [{"count": 2, "positions": [[1.0, 1.0], [4.0, 4.0]], "velocities": [[0.0, 0.0], [2.0, 0.0]], "radius": 0.5,
                   "mass": 1.0}],
        "run": {"t_end": 2.0}, "output": {"trajectory": "xyz", "every": 1.0}})
    frames = carom.run(scene, out=tmp_path / "run").frames
    assert len(frames[0]) == 2 and len(frames[-1]) == 1
    with pytest.raises(ValueError, match="same disks"):
        frames.to_mdanalysis()
