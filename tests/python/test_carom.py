"""The Python module: it gives the same bits as the command line, and keeps its promises on copies, views and
threads."""

import glob
import json
import os
import pathlib
import pickle
import signal
import subprocess
import threading
import time
import tomllib

import carom
import numpy as np
import pytest

from small_gas import gas

source = pathlib.Path(os.environ["CAROM_SOURCE_DIR"])
program = os.environ["CAROM_PROGRAM"]

# The time for which a scene runs here: a few steps of the large ones.
short = {"gas_million.toml": 0.02, "dense_mixture.toml": 0.05, "production_c.toml": 0.5}


@pytest.mark.parametrize("file", sorted(os.path.basename(f) for f in glob.glob(str(source / "scenes/*.toml"))))
def test_every_scene_has_the_command_lines_hash(file, tmp_path):
    path = source / "scenes" / file
    start = tomllib.loads(path.read_text()).get("analysis", {}).get("start", 0.0)
    changes = {"run.t_end": start + short.get(file, 1.0)}
    if file == "gas_million.toml":
        changes["disks.0.count"] = 100_000
    sets = [word for key, value in changes.items() for word in ("--set", f"{key}={value}")]
    line = [program, "run", path, *sets, "--json", "--quiet", "-o", tmp_path / "cli"]
    told = json.loads(subprocess.run(line, check=True, capture_output=True).stdout)
    result = carom.run(carom.Scene.load(path, changes), warn=lambda _: None)
    assert result.hash == told["state_hash"]
    assert result.summary["collisions"] == told["collisions"]


def test_stepping_has_the_bits_of_a_run():
    scene = gas(method="exact")
    sim = carom.Simulation(scene)
    sim.step(3)
    sim.run(until=1.0)
    assert sim.time >= 1.0
    sim.disks(at=1.0)
    sim.run()
    assert sim.done and sim.time == 5.0
    assert sim.hash == carom.run(scene).hash == sim.summary["state_hash"]


def test_a_bad_scene_says_what_the_command_line_says(tmp_path):
    bad = tmp_path / "bad.toml"
    bad.write_text("[box]\nwidht = 3\n")
    told = subprocess.run([program, "check", bad], capture_output=True, text=True).stderr
    with pytest.raises(carom.SceneError) as error:
        carom.Scene.load(bad)
    assert f"carom: error: {error.value}" == told.strip()
    with pytest.raises(ValueError, match="disks: missing"):
        carom.Scene({"box": {"width": 1.0, "height": 1.0}})
    with pytest.raises(TypeError, match="a scene holds"):
        carom.Scene({"box": {"width": object()}})


def test_a_scene_from_arrays_gives_their_numbers_back():
    places = np.array([[1.1, 2.2], [5.5, 1 / 3 + 1]])
    scene = carom.Scene({
        "box": {"width": 10.0, "height": 5.0},
        "disks": [{"count": 2, "positions": places, "velocities": np.array([[0.1, 0.0], [-0.3, 1e-9]]), "radius": [0.5, 0.25],
                   "mass": np.float64(2.0)}],
        "run": {"t_end": 1},
    })
    d = carom.Simulation(scene).disks()
    assert np.array_equal(np.column_stack([d.x, d.y]), places)
    assert d.vy[1] == 1e-9 and list(d.radius) == [0.5, 0.25] and list(d.mass) == [2.0, 2.0] and list(d.id) == [0, 1]
    assert d.positions3d().shape == (2, 3)
    assert carom.Scene.parse(scene.toml()).toml() == scene.toml()
    assert pickle.loads(pickle.dumps(scene)).toml() == scene.toml()


@pytest.mark.parametrize("title", ["a \x7f b", "\x00\x1f\n\t\"\\", "\x80 \u2028 \U0001d70b"])
def test_a_scene_has_any_string(title):
    for text in (title, pathlib.PurePosixPath(title)):
        tables = {"title": text, "box": {"packing_fraction": 0.3}, "run": {"t_end": 1.0},
                  "disks": [{"count": 5, "positions": "random", "radius": 0.5, "mass": 1.0}]}
        scene = carom.Scene(tables)
        assert scene.title == title
        assert carom.Scene.parse(scene.toml()).title == title
        with pytest.raises(carom.SceneError, match="unknown key"):
            carom.Scene(tables | {title: 1})


def test_a_view_copies_nothing_and_is_never_stale():
    sim = carom.Simulation(gas(), threads=1)
    with sim.view() as v, sim.view() as again:
        assert v.x.__array_interface__["data"] == again.x.__array_interface__["data"]
        assert not v.x.flags.writeable and not v.x.flags.owndata
        assert np.array_equal(np.sort(v.x), np.sort(sim.disks().x))
        with pytest.raises(RuntimeError, match="view"):
            sim.step()
        with pytest.raises(ValueError):
            v.x[0] = 1.0
    with pytest.raises(RuntimeError, match="closed"):
        v.x
    sim.step()
    view = sim.view()
    kept = view.x
    view.close()
    with pytest.raises(RuntimeError, match="in use"):
        sim.remove(0)
    del kept
    sim.step()


def test_summary_and_warnings_only_look():
    sim = carom.Simulation(gas(), threads=1)
    sim.step(3)

    def summary():
        return sim.summary | {"phase_s": None}  # a measured time

    expected = summary()
    for change in (lambda: None, lambda: sim.from_bytes(sim.to_bytes())):
        change()
        with sim.view() as v:
            before = v.x.copy()
            assert summary() == expected and sim.take_warnings() == []
            assert np.array_equal(v.x, before)
            with sim.view() as again:
                assert v.x.__array_interface__["data"] == again.x.__array_interface__["data"]
        sim.step(0)


def test_an_array_of_a_view_keeps_the_simulation():
    # This runs in a separate process, which crashes if it reads memory that was freed.
    script = """if True:
        import carom, sys
        scene = carom.Scene.parse(sys.argv[1])
        def column():
            sim = carom.Simulation(scene, threads=1)
            with sim.view() as v:
                return v.x, v.x.copy()
        x, before = column()
        sim = carom.Simulation(scene, threads=1)
        view = sim.view()
        sim = carom.Simulation(scene, threads=1)
        sim.step(2)
        assert (x == before).all() and (view.x == before).all()
        x = sim.view().x
        try:
            sim.step()
        except RuntimeError:
            del x
            sim.step()
        """
    subprocess.run(["/usr/bin/python3", "-c", script, gas(200_000).toml()], check=True)


def test_rough_disks_have_spins():
    group = {"count": 20, "positions": "random", "spin_temperature": 2.0, "radius": 0.5, "mass": 1.0}
    sim = carom.Simulation(carom.Scene({
        "box": {"packing_fraction": 0.3},
        "physics": {"roughness": {"tangential_restitution": 0.5}},
        "disks": [group],
        "run": {"method": "pairwise", "dt": 0.01, "t_end": 1.0},
    }), threads=1)
    disks = sim.disks()
    assert "spin" in disks.names and len(disks.spin) == len(disks)
    inertia = 0.5 * disks.mass * disks.radius**2
    assert np.isclose(np.mean(inertia * disks.spin**2), 2.0)
    with sim.view() as v:
        assert np.array_equal(np.sort(v.spin), np.sort(disks.spin))
    assert "spin" not in carom.Simulation(gas(), threads=1).disks().names


def test_changes_and_questions():
    sim = carom.Simulation(gas(50), threads=1)
    sim.step(10)
    d = sim.disks()
    assert sim.nearest(d.x[7], d.y[7]) == (7, 0.0)
    assert sim.add(d.x[7], d.y[7], radius=0.5) is None
    assert sim.remove(7) and not sim.remove(7) and len(sim) == 49
    new = sim.add(d.x[7], d.y[7], vx=1.0, radius=0.5, mass=2.0)
    with_new = sim.disks()
    assert [column[with_new.id == new][0] for column in (with_new.vx, with_new.radius, with_new.mass)] == [1.0, 0.5, 2.0]
    assert new == 50
    assert sim.set_velocity(50, 0.0, 3.0) and not sim.set_velocity(7, 0.0, 0.0)
    hit = sim.cast_ray(d.x[7], d.y[7], 1.0, 0.0, 1.0)
    assert hit == carom.Hit(50, 0.0, d.x[7], d.y[7])
    assert 50 in sim.disks_in(d.x[7] - 0.1, d.y[7] - 0.1, d.x[7] + 0.1, d.y[7] + 0.1)
    with pytest.raises(carom.SceneError):
        sim.add(np.nan, 1.0)
    sim.step(10)


def test_saved_and_resumed(tmp_path):
    sim = carom.Simulation(gas(method="exact"))
    sim.step(5)
    saved = sim.to_bytes()
    sim.save(tmp_path / "a.carom")
    sim.step(5)
    then = sim.hash
    sim.from_bytes(saved)
    sim.step(5)
    assert sim.hash == then
    for engine in ("parallel", "reference"):
        other = carom.resume(tmp_path / "a.carom", engine=engine)
        other.step(5)
        assert other.hash == then
    with pytest.raises(carom.SceneError, match="damaged"):
        sim.from_bytes(saved[:-8])
    with pytest.raises(carom.SceneError):
        carom.resume(tmp_path / "none.carom")


def test_a_folder_has_a_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = carom.Scene.parse(gas(5, t_end=0.1).toml(), {"output.series": True})
    with pytest.raises(carom.SceneError, match="out: is empty; expected a folder"):
        carom.run(scene, out="")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("form", ["xyz", "h5md"])
def test_results_as_columns_and_frames(form, tmp_path):
    scene = carom.Scene.parse(gas(method="exact", t_end=1.0).toml(), {
        "output.trajectory": form, "output.series": True, "output.every": 0.25, "analysis.what": ["pair_correlation"]})
    result = carom.run(scene, out=tmp_path / "run")
    series = result.series
    assert list(series["t"]) == [0.0, 0.25, 0.5, 0.75, 1.0]
    frames = result.frames
    assert len(frames) == 5
    assert [f.t for f in frames] == list(series["t"])
    sim = carom.Simulation(scene)
    sim.run()
    last = frames[-1]
    assert np.array_equal(last.x, sim.disks().x) and np.array_equal(last.vy, sim.disks().vy)
    assert last.positions3d().shape == (200, 3) and last.box == (scene.width, scene.height)
    with pytest.raises(IndexError):
        frames[5]
    assert any("pair_correlation" in name for name in result.analysis)
    with pytest.raises(carom.SceneError, match="holds"):
        carom.run(scene, out=tmp_path / "run")
    with pytest.raises(carom.SceneError, match="nothing.xyz: does not exist; expected a folder of a run, or a trajectory"):
        carom.Trajectory(tmp_path / "nothing.xyz")


def test_two_simulations_in_two_threads_while_python_runs():
    scene = gas(3000)
    alone = carom.Simulation(scene, threads=1)
    alone.step(3000)
    sims = [carom.Simulation(scene, threads=1) for _ in range(2)]
    threads = [threading.Thread(target=s.step, args=(3000,)) for s in sims]
    for t in threads:
        t.start()
    counted = 0  # it reaches hundreds on an idle machine
    while any(t.is_alive() for t in threads):
        counted += 1  # this loop runs during the steps
        time.sleep(0)
    assert counted > 10, counted
    assert [s.hash for s in sims] == [alone.hash] * 2


def test_a_fork_is_refused_where_threads_would_be_missing():
    several = carom.Simulation(gas(), threads=2)
    several.step(3)
    alone = carom.Simulation(gas(), threads=1)
    alone.step(3)
    read, write = os.pipe()
    pid = os.fork()
    if pid == 0:
        said = b""
        for threads in (2, None if os.cpu_count() > 1 else 2):  # None: all cores
            try:
                carom.Simulation(gas(), threads=threads)
            except RuntimeError as error:
                said += b"refused " if "forked" in str(error) else b"other "
        try:
            signal.alarm(30)  # missing threads would never answer
            several.step(1)
        except RuntimeError as error:
            said += b"both" if "began in another process" in str(error) else b"other"
        try:  # one thread works in any process; the reference has one for any number asked for
            for one in (alone, carom.Simulation(gas(), threads=1), carom.Simulation(gas(), threads=2, engine="reference")):
                one.step(6 - one.steps)
                said += b" " + one.hash.encode()
        except RuntimeError as error:
            said += b" " + str(error).encode()
        os.write(write, said)
        os._exit(0)
    os.waitpid(pid, 0)
    alone.step(3)
    assert os.read(read, 1000).decode() == "refused refused both" + 3 * f" {alone.hash}"


def test_a_series_has_the_columns_of_its_file_with_one_row_too(tmp_path):
    disks = [{"name": name, "count": 2, "positions": "random", "radius": 0.5, "mass": 1.0} for name in ("big-ones", "b")]
    scene = carom.Scene({"box": {"width": 9.0, "height": 9.0}, "disks": disks, "run": {"t_end": 0.0}, "output": {"series": True}})
    series = carom.run(scene, out=tmp_path / "run").series
    assert list(series) == (tmp_path / "run" / "series.csv").read_text().split("\n")[0].split(",")
    assert any("big-ones" in name for name in series)
    assert series["t"].shape == (1,) and series["disks"][0] == 4.0
    for name, expected in (("disk", "expected 'disks'"), ("zzz", "expected one of 't', "), (3, "no column 3; expected one of 't', ")):
        with pytest.raises(KeyError, match=expected):
            series[name]
    assert series.get("disk") is None and "disk" not in series


def test_map_says_which_scene_failed():
    box = {"width": 10.0, "height": 10.0}
    disks = [{"count": 1, "positions": [[5.0, 5.0]], "velocities": [[1.0, 0.0]], "radius": r, "mass": 1.0} for r in (1.0, 5.0)]
    free, jammed = (carom.Scene({"box": box, "disks": [d], "run": {"t_end": 1.0}}) for d in disks)
    with pytest.raises(carom.PhysicsError, match=r"^scenes\[2\]: exact: time stands still"):
        carom.map([free, free, jammed, free], jobs=2)


def test_map_runs_each_by_itself():
    scenes = [carom.Scene.parse(gas(50, t_end=0.5).toml(), {"seed": seed}) for seed in (1, 2, 3)]
    results = carom.map(scenes, jobs=2)
    assert [r.hash for r in results] == [carom.run(s).hash for s in scenes]
    assert len({r.hash for r in results}) == 3


def test_the_package_has_one_version_and_errors_of_pythons_kinds():
    project = tomllib.loads((source / "pyproject.toml").read_text())["project"]
    assert carom.__version__.split("+")[0] == project["version"]
    for error, kind in ((carom.SceneError, ValueError), (carom.PhysicsError, RuntimeError), (carom.RunError, OSError)):
        assert issubclass(error, kind)
    assert len({carom.SceneError, carom.PhysicsError, carom.RunError}) == 3


def test_import_is_quick():
    line = ["/usr/bin/python3", "-c", "import numpy, time; t = time.process_time(); import carom; print(time.process_time() - t)"]
    told = subprocess.run(line, check=True, capture_output=True, text=True).stdout
    assert float(told) < 0.3
