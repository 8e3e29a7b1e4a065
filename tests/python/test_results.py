"""What a run leaves as Python sees it: columns with their errors, plots, the viewer, and what other programs take."""

import copy
import html
import inspect
import json
import os
import pickle
import typing

import carom
import numpy as np
import pytest


@pytest.fixture(scope="module", params=["xyz", "h5md"])
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


def test_columns_have_what_the_file_says_of_them(result):
    pressure = result.analysis["pressure/value"]
    assert pressure.standard_error > 0.0
    known = np.isfinite(pressure)
    weights = result.analysis["pressure/interval"][known]
    assert np.isclose(np.average(pressure[known], weights=weights), pressure.attributes["mean"])
    assert abs(pressure.attributes["mean"] - pressure[known].mean()) < 10 * pressure.standard_error
    g = result.analysis["pair_correlation/g"]
    assert g.standard_error is None and g.attributes["samples"] == 17
    assert result.analysis["samples/time"].unit == "time"
    interval = result.analysis["pressure/interval"]
    assert interval.standard_error is None and "mean" not in interval.attributes and interval.attributes["samples"] > 0
    for name in ("local", "global"):
        order = result.analysis[f"bond_order/{name}"]
        assert order.standard_error == order.attributes[f"{name}_standard_error"] > 0.0
        assert np.isclose(order.attributes["mean"], order.mean())
    assert (2.0 * g).standard_error is None and (2.0 * pressure).attributes == {}
    assert result.series["kinetic"].shape == (9,)


def test_a_result_is_opened_again(result, tmp_path):
    again = carom.Result.load(os.fsencode(result.folder))
    assert again.summary == result.summary and again.folder == result.folder and repr(again) == repr(result)
    assert np.array_equal(again.series["kinetic"], result.series["kinetic"]) and again.plots == result.plots
    with pytest.raises(carom.SceneError, match="summary.json: No such file or directory; expected the folder of a run that is done"):
        carom.Result.load(tmp_path)
    for text in ("{", "[]", "{}", "\xff"):
        (tmp_path / "summary.json").write_text(text, encoding="latin-1")
        with pytest.raises(carom.SceneError, match="expected the folder of a run that is done"):
            carom.Result.load(tmp_path)
    for key, wrong in (("state_hash", 7), ("particles", "ten"), ("time", None), ("collisions", 1.5)):
        others = {name: value for name, value in result.summary.items() if name != key}
        for summary in (others, others | {key: wrong}):
            (tmp_path / "summary.json").write_text(json.dumps(summary))
            with pytest.raises(carom.SceneError, match=f"summary.json: has no {key}, a .*; expected the folder of a run"):
                carom.Result.load(tmp_path)


def test_a_scene_starts_from_files_and_frames(result, tmp_path):
    last = result.frames[-1]
    (tmp_path / "speeds.csv").write_text("".join(f"{vx!r},{vy!r}\n" for vx, vy in zip(last.vx.tolist(), last.vy.tolist())))
    text = f"""
box = {{ width = {last.box[0]!r}, height = {last.box[1]!r}, left = "periodic", right = "periodic" }}
run = {{ t_end = 1.0 }}
[[disks]]
count = {len(last)}
positions = {{ frame = "{result.folder}" }}
velocities = {{ file = "speeds.csv" }}
radius = 0.5
mass = 2.0
"""
    (tmp_path / "next.toml").write_text(text)
    for scene in (carom.Scene.load(tmp_path / "next.toml"), carom.Scene.parse(text, folder=tmp_path)):
        start = carom.Simulation(scene, threads=1).disks()
        assert all(np.array_equal(getattr(start, name), getattr(last, name)) for name in ("x", "y", "vx", "vy"))


def test_a_notebook_shows_the_plots_and_the_disks(result):
    assert "pair_correlation" in result.plots and result.plots["pair_correlation"].lstrip().startswith("<?xml")
    page = result._repr_html_()
    assert page.count("data:image/svg+xml;base64,") == len(result.plots) and result.hash in page
    sim = carom.Simulation(carom.Scene.parse(carom.Scene({
        "box": {"width": 10.0, "height": 10.0}, "disks": [{"count": 5, "positions": "random", "radius": 0.5, "mass": 1.0}],
        "run": {"t_end": 1.0}}).toml()), threads=1)
    assert sim.picture().startswith(b"\x89PNG")
    assert repr(sim) == "<carom.Simulation, 5 disks, t = 0, 0 collisions>"
    assert "data:image/png;base64," in sim._repr_html_() and "<td>5</td>" in sim._repr_html_()


def test_a_run_without_files_is_shown_too():
    scene = carom.Scene({"box": {"width": 9.0, "height": 9.0}, "run": {"t_end": 1.0}, "output": {"series": False},
                         "disks": [{"count": 3, "positions": "random", "radius": 0.5, "mass": 1.0}]})
    result = carom.run(scene)
    assert result.folder is None and result.plots == {} and result.hash in result._repr_html_() and result.hash in repr(result)
    with pytest.raises(carom.SceneError, match='^the run wrote no files; give carom.run a folder: out="out/gas"$'):
        result.frames


def test_the_viewer_is_one_page(result, tmp_path, monkeypatch):
    page = tmp_path / "page.html"
    assert result.show(page) is None
    text = page.read_text()
    assert "gas &lt;b&gt;" in text and "<canvas" in text
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    result.frames.show()
    assert len(opened) == 1 and opened[0].startswith("file:///") and opened[0].endswith("/run/view.html")
    assert os.path.getsize(os.path.join(result.folder, "view.html")) == len(text.encode())
    alone = tmp_path / os.path.basename(result.frames.file)
    alone.write_bytes(open(result.frames.file, "rb").read())
    carom.Trajectory(alone).show()
    assert (tmp_path / "view.html").exists()


def test_a_notebook_shows_the_page_and_writes_it_where_told(result, tmp_path, monkeypatch):
    monkeypatch.setattr("carom._notebook._in_notebook", lambda: True)
    monkeypatch.setattr("webbrowser.open", lambda _: pytest.fail("is in the notebook"))
    before = set(os.listdir(result.folder))
    shown = result.show()._repr_html_()
    assert set(os.listdir(result.folder)) == before
    assert result.show(tmp_path / "page.html") is None
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert shown.startswith("<iframe") and html.unescape(shown.split('srcdoc="')[1].split('"')[0]) == text


def test_the_viewer_says_its_complaints_in_words_of_python(result, tmp_path, monkeypatch):
    for notebook in (True, False):
        monkeypatch.setattr("carom._notebook._in_notebook", lambda: notebook)
        with pytest.raises(carom.SceneError, match="^max_size: "):
            result.show(None if notebook else tmp_path / "page.html", max_size=1)


def test_the_viewer_replaces_no_file_unless_told_to(result, tmp_path):
    page = tmp_path / "page.html"
    page.write_text("mine")
    with pytest.raises(carom.SceneError, match=r"page.html: exists already; .* replace it with force=True$"):
        result.show(page)
    assert page.read_text() == "mine"
    before = open(result.frames.file, "rb").read()
    for force in (False, True):
        with pytest.raises(carom.SceneError, match=r'ends in "\.(xyz|h5)"; expected .html'):
            result.frames.show(result.frames.file, force=force)
    assert open(result.frames.file, "rb").read() == before
    result.show(page, force=True)
    assert "<canvas" in page.read_text()


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
    # Across the periodic side, as ASE computes it.
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
    """Unwrapped by them, as programs do for displacements, no disk jumps by half the box between two frames."""
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


def test_a_trajectory_that_goes_on_is_read_as_far_as_it_is_there(result, tmp_path, monkeypatch):
    if not result.frames.file.endswith(".xyz"):
        pytest.skip("lines can be added to text alone")
    lines = open(result.frames.file).read().splitlines(keepends=True)
    whole = len(lines) // 9  # lines a frame
    unfinished = tmp_path / "carom-unfinished"
    unfinished.mkdir()
    (unfinished / "trajectory.xyz").write_text("".join(lines[:2 * whole]))
    frames = carom.Trajectory(tmp_path)
    assert len(frames) == 2 and frames[-1].t == 0.5
    monkeypatch.setattr("webbrowser.open", lambda _: None)
    frames.show()
    assert (tmp_path / "view.html").exists() and not (unfinished / "view.html").exists(), "where carom view puts it"
    with open(unfinished / "trajectory.xyz", "a") as file:
        file.write("".join(lines[2 * whole:5 * whole + 3]))
    assert len(frames) == 5 and frames[-1].t == 2.0
    (unfinished / "trajectory.xyz").rename(tmp_path / "trajectory.xyz")  # as a run that ends
    assert len(frames) == 5 and [f.t for f in frames][:2] == [0.0, 0.5]


def test_frames_are_taken_by_number_and_in_slices(result):
    frames = result.frames
    times = [frame.t for frame in frames]
    assert len(times) == 9
    for part in (slice(1, 3), slice(None), slice(-2, None), slice(None, None, -3), slice(5, 2), slice(7, 99)):
        assert [frame.t for frame in frames[part]] == times[part]
    assert frames[-1].t == times[-1] and frames[np.int64(2)].t == times[2]
    for wrong in ("1", 1.5, None):
        with pytest.raises(TypeError, match="cannot be interpreted as an integer"):
            frames[wrong]
    with pytest.raises(IndexError, match="^frame 9 of 9$"):
        frames[9]


def test_a_column_keeps_what_the_file_says_when_it_is_sent_on(result):
    pressure = result.analysis["pressure/value"]
    for other in (pickle.loads(pickle.dumps(pressure)), copy.copy(pressure), copy.deepcopy(pressure)):
        assert other.standard_error == pressure.standard_error and np.array_equal(other, pressure, equal_nan=True)


def test_the_viewer_names_its_own_arguments(result, tmp_path):
    for size in (-1, 0):
        with pytest.raises(ValueError, match=f"^max_size is {size}; expected 1 or more$"):
            result.show(tmp_path / "page.html", max_size=size)
    with pytest.raises(carom.SceneError, match="^max_size: 1 bytes are too few"):
        result.show(tmp_path / "page.html", max_size=1)
    with pytest.raises(carom.SceneError, match=r'^file: ".*" ends in ".txt"; expected .html$'):
        result.show(tmp_path / "page.txt")


def test_everything_has_a_docstring():
    for name in carom.__all__:
        thing = getattr(carom, name)
        assert thing.__doc__ and thing.__doc__ != getattr(thing.__class__, "__doc__", None), name
        if isinstance(thing, type):
            assert "__doc__" in vars(thing) and thing.__module__ == "carom", name
            public = {key: value for key, value in vars(thing).items() if not key.startswith("_")}
            assert all(getattr(value, "__doc__", None) for value in public.values()), name
    for error in (carom.SceneError("a"), carom.PhysicsError("b"), carom.RunError("c")):
        assert type(pickle.loads(pickle.dumps(error))) is type(error)


def test_damaged_files_are_named(result, tmp_path):
    damaged = carom.Result(result.summary, str(tmp_path))
    whole = open(os.path.join(result.folder, "series.csv"), "rb").read()
    for text in (b"", b"\n", whole[:whole.rindex(b",")]):
        (tmp_path / "series.csv").write_bytes(text)
        with pytest.raises(carom.SceneError, match="series.csv: has no heading, or .* expected series.csv of a run$"):
            damaged.series
    (tmp_path / "series.csv").write_bytes(whole[:whole.index(b"\n") + 1])
    assert damaged.series["kinetic"].shape == (0,)
    whole = open(os.path.join(result.folder, "analysis.h5"), "rb").read()
    for size in (0, 10, len(whole) // 2, len(whole) - 1):
        (tmp_path / "analysis.h5").write_bytes(whole[:size])
        with pytest.raises(carom.SceneError, match="analysis.h5: cannot be read: .*; expected analysis.h5 of a run$"):
            damaged.analysis


def test_every_call_has_types():
    calls = {name: getattr(carom, name) for name in carom.__all__}
    for name, thing in list(calls.items()):
        if isinstance(thing, type):
            del calls[name]
            calls |= {f"{name}.{key}": value for key, value in vars(thing).items() if not key.startswith("_")}
    for name, call in calls.items():
        call = call.fget if isinstance(call, property) else getattr(call, "__func__", call)
        if not inspect.isfunction(call):
            continue
        signature = inspect.signature(call)
        typed = [p.annotation for p in signature.parameters.values() if p.name not in ("self", "cls")]
        assert inspect.Signature.empty not in [*typed, signature.return_annotation], name
        typing.get_type_hints(call)  # whose names are all known


def test_every_column_has_a_type():
    scene = carom.Scene({
        "box": {"width": 9.0, "height": 9.0}, "physics": {"roughness": {"tangential_restitution": 0.5}},
        "disks": [{"count": 2, "positions": "random", "radius": 0.5, "mass": 1.0}], "run": {"t_end": 1.0}})
    frame = carom.Simulation(scene, threads=1).disks()
    types = typing.get_type_hints(carom.Frame)
    assert "spin" in frame.names and all(types[name] is np.ndarray for name in (*frame.names, "group"))
    assert set(vars(frame)) <= set(types)
