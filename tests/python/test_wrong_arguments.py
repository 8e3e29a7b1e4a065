"""Error messages for arguments of the wrong kind: they name what was expected, in terms of Python."""

import enum
import os
import shutil
import subprocess
from decimal import Decimal
from fractions import Fraction

import carom
import numpy as np
import pytest


def scene(**tables):
    return carom.Scene({
        "box": {"width": 10.0, "height": 10.0}, "disks": [{"count": 5, "positions": "random", "radius": 0.5, "mass": 1.0}],
        "run": {"t_end": 1.0}, **tables})


@pytest.mark.parametrize("call", [carom.run, carom.Simulation])
def test_a_file_or_a_dictionary_is_no_scene(call):
    for wrong in ("gas.toml", {"run": {"t_end": 1.0}}, None):
        with pytest.raises(TypeError, match=r"expected a carom.Scene, not \w+: carom.Scene.load"):
            call(wrong)


def test_a_scene_is_a_dictionary():
    for wrong in ("gas.toml", 3, [1, 2]):
        with pytest.raises(TypeError, match=r"a scene is a dictionary, not \w+; carom.Scene.load\(path\) reads a file"):
            carom.Scene(wrong)
    with pytest.raises(TypeError, match="the keys of a scene are strings; not int"):
        carom.Scene({"box": {1: 2.0}})


def test_what_a_scene_cannot_hold_is_named():
    group = {"count": 2, "radius": 0.5, "mass": 1.0}
    places = np.ma.array([[1.0, 1.0], [3.0, 3.0]], mask=[[False, False], [False, True]])
    for change, key in (({"title": b"gas"}, "title"), ({"run": {"t_end": None}}, "run.t_end"),
                        ({"disks": [group, group | {"velocities": {"maxwell": Decimal(1)}}]}, "disks.1.velocities.maxwell"),
                        ({"disks": [group | {"positions": places}]}, "disks.0.positions.1.1")):
        with pytest.raises(TypeError, match=rf"^{key}: a scene holds numbers, strings, lists and dictionaries; not \w+$"):
            scene(**change)
    with pytest.raises(TypeError, match="^run.t_end: a scene holds .*; not set$"):
        carom.Scene.parse(scene().toml(), {"run.t_end": {1.0}})


def test_numbers_have_all_digits_whatever_they_show():
    class Shown(float):
        def __repr__(self):
            return f"{self:.1f}"

    assert scene(seed=Kind.other, run={"t_end": Shown(1 / 3)}).t_end == 1 / 3
    assert scene(seed=Kind.other).seed == 7


class Kind(enum.IntEnum):
    other = 7


def test_steps_threads_and_callbacks():
    sim = carom.Simulation(scene(), threads=1)
    for wrong in (1.5, "two"):
        with pytest.raises(TypeError, match="cannot be interpreted as an integer"):
            sim.step(wrong)
        with pytest.raises(TypeError, match="cannot be interpreted as an integer"):
            carom.Simulation(scene(), threads=wrong)
    with pytest.raises(ValueError, match="^steps is -1; expected 0 or more$"):
        sim.step(-1)
    with pytest.raises(ValueError, match="could not convert string to float"):
        sim.run(until="the end")
    with pytest.raises(ValueError, match="^until is not a number$"):
        sim.run(until=np.nan)
    with pytest.raises(TypeError, match="expected a function of the simulation, not int"):
        sim.every(1.0, 3)
    sim.step(2**70)  # more steps than there are to the end
    assert sim.done


def test_intervals_are_kept_as_numbers():
    moving = scene(run={"method": "pairwise", "dt": 0.125, "t_end": 1.0})
    for interval in (Decimal("0.25"), Fraction(1, 4), np.array(0.25), np.array([0.25])):
        sim, seen = carom.Simulation(moving, threads=1), []
        sim.every(interval, lambda s: seen.append(s.time))
        if isinstance(interval, np.ndarray):
            interval *= 0  # changes the caller's array only
        sim.run()
        assert seen == [0.25, 0.5, 0.75, 1.0]
    with pytest.raises(ValueError, match="^interval is too large; expected a number below 1.8e308$"):
        sim.every(10**400, print)
    for wrong in (0, -1.0, np.nan):
        with pytest.raises(ValueError, match=rf"^interval is {wrong:g}; expected a time above 0$"):
            sim.every(wrong, print)


def test_a_run_is_told_what_is_wrong_before_it_begins(tmp_path):
    folder = tmp_path / "run"
    with pytest.raises(TypeError, match="^expected a function of a warning, not int$"):
        carom.run(scene(), out=folder, warn=3)
    for name in ("force", "strict"):
        for wrong in ("no", [False]):
            with pytest.raises(TypeError, match=rf"^{name} is .*; expected True or False$"):
                carom.run(scene(), out=folder, **{name: wrong})
    assert not folder.exists()
    result = carom.run(scene(output={"trajectory": "xyz"}), out=folder, force=np.bool_(True), strict=None)
    with pytest.raises(TypeError, match="^force is 'no'; expected True or False$"):
        result.show(tmp_path / "page.html", force="no")


def test_what_map_does_not_take(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for outs in ("ab", b"ab", tmp_path):
        with pytest.raises(TypeError, match="^outs is .*; expected a list of folders, one for each scene$"):
            carom.map([scene(), scene()], outs=outs)
    with pytest.raises(ValueError, match="^1 folders for 2 scenes$"):
        carom.map([scene(), scene()], outs=["a"])
    for jobs in (0, -1):
        with pytest.raises(ValueError, match=f"^jobs is {jobs}; expected 1 or more$"):
            carom.map([scene()], jobs=jobs)
    for jobs in (1.5, "2"):
        with pytest.raises(TypeError, match="cannot be interpreted as an integer"):
            carom.map([scene()], jobs=jobs)
    assert not any(tmp_path.iterdir())


def test_what_ends_a_run_is_said_in_words_of_python(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(carom.SceneError, match="is a file; expected a folder for the results$"):
        carom.run(scene(), out=tmp_path / "file")
    long_step = scene(run={"method": "pairwise", "dt": 1.0, "t_end": 2.0},
                      disks=[{"count": 5, "positions": "random", "velocities": {"maxwell": 9.0}, "radius": 0.5, "mass": 1.0}])
    with pytest.raises(carom.PhysicsError, match=r"more accurate \(strict=True\)$"):
        carom.run(long_step, strict=True)
    resting = {"box": {"width": 10.0, "height": 10.0, "wall_restitution": 0.5}, "physics": {"gravity": 1.0, "restitution": 0.5}}
    for end in (lambda s: carom.run(s), lambda s: carom.Simulation(s, threads=1).run()):
        with pytest.raises(carom.PhysicsError, match='run.method = "pairwise"'):
            end(scene(**resting, run={"t_end": 100.0}))


def test_what_a_run_did_not_write(tmp_path):
    result = carom.run(scene(), out=tmp_path / "run")
    with pytest.raises(carom.SceneError, match=r"analysis.h5: .* expected a scene with \[analysis\]"):
        result.analysis
    with pytest.raises(carom.SceneError, match=r"series.csv: .* expected a scene with series = true"):
        result.series


def test_numbers_have_points_in_any_locale(tmp_path):
    made = ["localedef", "-i", "de_DE", "-f", "UTF-8", str(tmp_path / "de_DE.UTF-8")]
    if shutil.which("localedef") is None or subprocess.run(made, capture_output=True).returncode != 0:
        pytest.skip("no locale to be had that writes commas")
    script = """
import carom, locale, sys
locale.setlocale(locale.LC_ALL, sys.argv[1])  # as a window system does by itself
scene = carom.Scene({"box": {"packing_fraction": 0.3}, "physics": {"restitution": 0.3, "gravity": 0.01}, "run": {
    "method": "auto", "accuracy": 3e-2, "t_end": 5.0}, "disks": [
        {"count": 500, "positions": "random", "radius": 0.5, "mass": 1.0, "velocities": {"maxwell": 1.0}}]})
print(scene.toml())
"""
    told = [subprocess.run(["/usr/bin/python3", "-c", script, name], env=os.environ | {"LOCPATH": str(tmp_path)}, check=True,
                           capture_output=True, text=True).stdout for name in ("C", "de_DE.UTF-8")]
    assert "dt = 0.0" in told[0] and told[0] == told[1]


def test_options_of_the_command_line_are_arguments(tmp_path):
    some = scene(output={"series": True})
    carom.run(some, out=tmp_path / "run")
    with pytest.raises(carom.SceneError, match="choose another folder, or replace it with force=True$"):
        carom.run(some, out=tmp_path / "run")
    with pytest.raises(carom.SceneError, match='^engine: there is no engine "refrence"'):
        carom.run(some, engine="refrence")
    with pytest.raises(carom.SceneError, match='^engine: there is no engine "refrence"'):
        carom.Simulation(some, engine="refrence")
    carom.Simulation(some, threads=1).save(tmp_path / "state.carom")
    with pytest.raises(carom.SceneError, match='^engine: there is no engine "refrence"'):
        carom.resume(tmp_path / "state.carom", engine="refrence")


def test_other_folders_are_no_options(tmp_path):
    for name in ("trajectory.xyz/kept", "frames/kept"):
        (tmp_path / "taken" / name).mkdir(parents=True)
        with pytest.raises(carom.SceneError, match="; choose another folder$"):
            carom.run(scene(output={"trajectory": "xyz"}), out=tmp_path / "taken", force=True)
        shutil.rmtree(tmp_path / "taken")
    with pytest.raises(carom.SceneError, match="^/: is the root of all folders; .* such as out/scene$"):
        carom.run(scene(), out="/")


# The message contains a command that can be typed as it is.
def test_a_remedy_of_the_command_line_stays_one(tmp_path):
    carom.run(scene(output={"series": True}), out=tmp_path / "run")
    with pytest.raises(carom.SceneError, match="carom run .*/scene.toml --set output.checkpoint=600 --t-end T -o DIR$"):
        carom.resume(tmp_path / "run")


def test_changes_are_no_options():
    with pytest.raises(carom.SceneError, match=r"^changes: run.tend: unknown key; expected one of .*nearest: t_end"):
        carom.Scene({"box": {"width": 9, "height": 9}, "run": {"t_end": 1},
                     "disks": [{"count": 1, "positions": [[4, 4]], "radius": 0.5, "mass": 1}]}, {"run.tend": 2.0})


def test_numbers_and_ids():
    sim = carom.Simulation(scene(), threads=1)
    for wrong in (-1, 2**32, 2**70):
        for call in (sim.remove, lambda id: sim.set_velocity(id, 0.0, 0.0)):
            with pytest.raises(ValueError, match=f"^id is {wrong}; expected a whole number from 0 to 4294967295$"):
                call(wrong)
    with pytest.raises(TypeError, match="cannot be interpreted as an integer"):
        sim.remove(1.0)
    assert not sim.remove(77) and not sim.remove(np.uint32(77)) and len(sim) == 5
    for call, name in ((lambda v: sim.add(1.0, v), "y"), (lambda v: sim.add(1.0, 1.0, spin=v), "spin"),
                       (lambda v: sim.set_velocity(0, 1.0, v), "vy"), (lambda v: sim.nearest(v, 1.0), "x"),
                       (lambda v: sim.disks_in(0.0, 0.0, v, 1.0), "x1"), (lambda v: sim.every(v, print), "interval"),
                       (lambda v: sim.cast_ray(1.0, 1.0, 1.0, 0.0, v), "length")):
        for wrong in ("5", b"5", [1.0], np.zeros(3)):
            with pytest.raises(TypeError, match=rf"^{name} is .*; expected a number$"):
                call(wrong)
    for wrong in ("5", [1.0]):
        with pytest.raises(TypeError, match=r"^at is .*; expected a number$"):
            sim.disks(at=wrong)
    with pytest.raises(ValueError, match=r"^x is too large; expected a number below 1.8e308$"):
        sim.nearest(10**400, 1.0)
    assert sim.nearest(np.float32(5.0), np.int8(5)) == sim.nearest(5.0, 5.0)


@pytest.mark.parametrize("threads", [-1, 0, 4097, 10**6, 2**31 - 1, 2**70])
def test_threads_that_no_machine_has(threads):
    for call in (carom.run, carom.Simulation):
        with pytest.raises(carom.SceneError, match=f"^threads: is {threads}; expected 1 or more, at most 4096$"):
            call(scene(), threads=threads)
        with pytest.raises(TypeError, match='^engine is "parallel" or "reference"; not int$'):
            call(scene(), engine=3)


def test_a_state_is_taken_from_whatever_holds_bytes():
    sim = carom.Simulation(scene(), threads=1)
    start, saved = sim.hash, sim.to_bytes()
    for held in (bytearray(saved), memoryview(saved), np.frombuffer(saved, np.uint8), np.repeat(np.frombuffer(saved, np.uint8), 2)[::2]):
        sim.step(3)
        sim.from_bytes(held)
        assert sim.hash == start
    with pytest.raises(TypeError, match="a bytes-like object is required, not 'str'"):
        sim.from_bytes("state")


def test_paths_and_texts_that_are_no_unicode(tmp_path):
    sim = carom.Simulation(scene(), threads=1)
    for name in ("state\0.carom", "state\udcff.carom"):
        for call in (sim.save, carom.resume, carom.Scene.load, carom.Trajectory, lambda path: carom.run(scene(), out=path)):
            with pytest.raises(ValueError, match="^the path is .*; expected one in UTF-8, without null characters$"):
                call(str(tmp_path / name))
    assert not any(tmp_path.iterdir())
    sim.save(os.fsencode(tmp_path / "state \u00fc\u2603.carom"))
    assert carom.resume(tmp_path / "state \u00fc\u2603.carom", threads=1).hash == sim.hash
    with pytest.raises(ValueError, match="^the text of a scene holds half a character, .*; expected Unicode text$"):
        carom.Scene.parse("title = '\ud800'")
    with pytest.raises(ValueError, match="^a name or a value of a scene holds half a character"):
        scene(title="\ud800")
    text = scene(title="\u00fc").toml()
    assert carom.Scene.parse(text.encode()).toml() == text
    with pytest.raises(TypeError, match="^the text of a scene is a string; not NoneType$"):
        carom.Scene.parse(None)
    with pytest.raises(TypeError, match="^the keys of changes are strings"):
        carom.Scene.parse("", {1: 2})
    for wrong in (["run.t_end=1"], "run.t_end=1", None):
        with pytest.raises(TypeError, match=r'^changes are a dictionary, such as {"run.t_end": 5.0}; not \w+$'):
            carom.Scene.parse("", wrong)


def test_a_damaged_trajectory_says_so(tmp_path):
    file = tmp_path / "gas.xyz"
    file.write_bytes(b"\xff\xfe\n")
    with pytest.raises(carom.SceneError, match=r"gas.xyz:1: '\?\?' is not a number of disks"):
        list(carom.Trajectory(file))


def test_warnings_are_said_in_words_of_python():
    coarse = scene(run={"method": "pairwise", "dt": 0.2, "t_end": 20.0},
                   disks=[{"count": 60, "positions": "random", "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 1.0}])
    told = []
    carom.run(coarse, warn=told.append)
    sim = carom.Simulation(coarse, threads=1)
    sim.run()
    with pytest.warns(RuntimeWarning) as raised:
        carom.run(coarse)
    assert {warning.filename for warning in raised} == {__file__}, "where the run was called"
    for lines in (told, sim.take_warnings(), [str(warning.message) for warning in raised]):
        assert any('use a smaller dt or run.method = "exact"' in line for line in lines), lines
        assert not any("--" in line for line in lines), lines
