"""Simulations used by several threads, and copies of simulations."""

import copy
import pickle
import subprocess
import threading
import time

import carom
import numpy as np
import pytest
from test_carom import gas


def test_a_simulation_in_a_step_answers_no_other_thread():
    sim = carom.Simulation(gas(3000, t_end=1e9), threads=1)
    asks = {name: ask for name, ask in (("disks", sim.disks), ("to_bytes", sim.to_bytes), ("step", sim.step), ("view", sim.view),
                                        ("remove", lambda: sim.remove(0)), ("time", lambda: sim.time),
                                        ("take_warnings", sim.take_warnings), ("contacts", sim.contacts),
                                        ("nearest", lambda: sim.nearest(1.0, 1.0)), ("picture", sim.picture))}
    over = False

    def other_thread():
        while asks and not over:
            for name in list(asks):
                try:
                    asks[name]()
                    time.sleep(0)
                except RuntimeError as error:
                    assert "in a step of another thread" in str(error)
                    del asks[name]

    other = threading.Thread(target=other_thread)
    other.start()
    for _ in range(100000):  # a few steps are enough
        if not asks:
            break
        try:
            sim.step(20)
        except RuntimeError:  # the other thread steps, or has a view
            time.sleep(0)
    over = True
    other.join()
    assert not asks


def test_its_text_for_another_thread_says_that_it_steps():
    sim = carom.Simulation(gas(3000, t_end=1e9), threads=1)
    texts = {repr(sim)}
    over = threading.Event()

    def other_thread():
        while not over.is_set():
            texts.add(repr(sim))  # this once raised
            time.sleep(0)

    other = threading.Thread(target=other_thread)
    other.start()
    for _ in range(1000):  # a few steps are enough
        sim.step(20)
        if "<carom.Simulation, in a step of another thread>" in texts or not other.is_alive():
            break
    over.set()
    other.join()
    assert "<carom.Simulation, in a step of another thread>" in texts


@pytest.mark.parametrize("threads", [1, 2])
def test_python_ends_while_a_daemon_thread_steps(threads, tmp_path):
    script = """if True:
        import carom, os, sys, threading, time
        scene, threads = carom.Scene.parse(sys.argv[1], {"output.series": True}), int(sys.argv[2])
        sim = carom.Simulation(scene, threads=threads)
        threading.Thread(target=sim.run, daemon=True).start()
        threading.Thread(target=carom.run, args=(scene, "run", threads), kwargs={"warn": len}, daemon=True).start()
        while not os.path.exists("run/carom-unfinished/series.csv"):
            time.sleep(0.01)
        try:
            while sim.time >= 0.0:
                time.sleep(0.001)
        except RuntimeError:  # in a step now
            print("ends")
        """
    line = ["/usr/bin/python3", "-c", script, gas(1000, t_end=1e9).toml(), str(threads)]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ends\n", "")


@pytest.mark.parametrize("engine", ["parallel", "reference"])
def test_a_copy_is_another_simulation(engine):
    sim = carom.Simulation(gas(), threads=1, engine=engine)
    sim.step(5)
    sim.every(0.01, lambda s: pytest.fail("a copy has no callbacks"))
    copies = [copy.copy(sim), copy.deepcopy(sim), pickle.loads(pickle.dumps(sim))]
    before = sim.hash
    for other in copies:
        other.step(20)
    assert sim.hash == before
    assert [(c._sim.engine, c._sim.threads) for c in copies] == [(engine, 1)] * 3
    sim._callbacks.clear()
    sim.step(20)
    assert [c.hash for c in copies] == [sim.hash] * 3


# A worker of map or of dask starts a scene in its turn, which may be hours later and on another machine.
def test_a_scene_is_copied_as_it_was_read(tmp_path):
    file, places = tmp_path / "gas.toml", tmp_path / "places.csv"
    places.write_text("1.0,2.0\n3.0,4.0\n")
    file.write_text("""title = "two"
box = { width = 9.0, height = 9.0 }
disks = [{ count = 2, positions = { file = "places.csv" }, radius = 0.5, mass = 1.0 }]
run = { method = "exact", t_end = 1.0 }
""")
    scene = carom.Scene.load(file, {"run.t_end": 2.0})
    start = carom.Simulation(scene, threads=1).hash
    pickled = pickle.dumps(scene)
    file.write_text("[box]\n")
    places.unlink()
    for other in (copy.copy(scene), copy.deepcopy(scene), pickle.loads(pickled), pickle.loads(pickle.dumps(pickle.loads(pickled)))):
        assert other.toml() == scene.toml() and repr(other) == repr(scene) and other.t_end == 2.0
        sim = carom.Simulation(other, threads=1)
        assert sim.hash == start and sim.summary["scene"] == str(file)


def test_a_view_can_be_copied_and_pickled():
    sim = carom.Simulation(gas(30), threads=1)
    with sim.view() as v:
        for other in (copy.copy(v), pickle.loads(pickle.dumps(v))):
            assert np.array_equal(other.x, v.x)
        with pytest.raises(AttributeError, match="the view has no column radius"):
            other.radius
    del other
