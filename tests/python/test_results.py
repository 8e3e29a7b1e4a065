"""The results of a run in Python: columns with their errors, plots, the viewer, frames."""

import copy
import html
import json
import os
import pickle

import carom
import numpy as np
import pytest


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


def test_a_run_without_files_is_measured_too(tmp_path):
    scene = carom.Scene({
        "box": {"packing_fraction": 0.3, "left": "periodic", "right": "periodic", "bottom": "periodic", "top": "periodic"},
        "disks": [{"count": 100, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 1.0}],
        "run": {"method": "exact", "t_end": 8.0},
        "analysis": {"what": ["pressure", "collision_rate", "displacement", "bond_order"], "every": 0.25, "start": 1.0},
    })
    with_files = carom.run(scene, out=tmp_path / "run")
    without = carom.run(scene)
    assert without.summary["analysis"] == with_files.summary["analysis"] and without.hash == with_files.hash
    assert without.summary["analysis"]["diffusion"] > 0.0 and without.summary["analysis"]["pressure_error"] > 0.0
    with pytest.raises(carom.SceneError, match="the run wrote no files"):
        without.analysis
    for result in carom.map([scene, scene]):
        assert result.summary["analysis"] == with_files.summary["analysis"]


# Warnings during a run: the only disk leaves before the first sample.
def test_a_run_without_files_warns_of_what_is_not_measured(tmp_path):
    scene = carom.Scene({
        "box": {"width": 4.0, "height": 4.0, "right": "sink"},
        "disks": [{"count": 1, "positions": [[2.0, 2.0]], "velocities": [[4.0, 0.0]], "radius": 0.5, "mass": 1.0}],
        "run": {"method": "pairwise", "dt": 0.0625, "t_end": 2.0},
        "analysis": {"what": ["displacement"], "every": 0.5, "start": 1.0},
    })
    told = []
    for out in (tmp_path / "run", None):
        told.append([])
        carom.run(scene, out=out, warn=told[-1].append)
    assert told[0] == told[1] and any("use a later analysis.start" in warning for warning in told[1]), told


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


def test_a_run_without_a_trajectory_names_its_folder_once(tmp_path):
    scene = carom.Scene({"box": {"width": 9.0, "height": 9.0}, "run": {"t_end": 1.0}, "output": {"series": True},
                         "disks": [{"count": 3, "positions": "random", "radius": 0.5, "mass": 1.0}]})
    with pytest.raises(carom.SceneError) as error:
        carom.run(scene, out=tmp_path / "run").frames
    assert str(error.value) == f"{tmp_path / 'run'}: holds no trajectory; expected trajectory.xyz or trajectory.h5"


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


def test_a_trajectory_that_goes_on_is_read_as_far_as_it_is_there(result, tmp_path, monkeypatch):
    if not result.frames.file.endswith(".xyz"):
        pytest.skip("lines can be added to text alone")
    lines = open(result.frames.file).read().splitlines(keepends=True)
    whole = len(lines) // 9  # lines of each frame
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
    (unfinished / "trajectory.xyz").rename(tmp_path / "trajectory.xyz")  # like at the end of a run
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
