"""Simulations between threads, processes and copies, and Ctrl-C where there is no step to wait for."""

import copy
import os
import pickle
import signal
import subprocess
import threading
import time

import carom
import numpy as np
import pytest
from test_carom import gas, press_ctrl_c


@pytest.mark.parametrize("engine", ["parallel", "reference"])
def test_ctrl_c_while_disks_are_placed(engine):
    # No million finds room at this density, which takes the best part of a minute to find out.
    scene = carom.Scene({"box": {"packing_fraction": 0.549}, "run": {"t_end": 1.0},
                         "disks": [{"count": 1000000, "positions": "random", "radius": 0.5, "mass": 1.0}]})
    began = time.monotonic()
    timer = press_ctrl_c(0.3)
    with pytest.raises(KeyboardInterrupt):
        carom.Simulation(scene, threads=1, engine=engine)
    timer.join()
    assert time.monotonic() - began < 10.0


def test_a_simulation_in_a_step_answers_no_other_thread():
    sim = carom.Simulation(gas(3000, t_end=1e9), threads=1)
    asks = {name: ask for name, ask in (("disks", sim.disks), ("to_bytes", sim.to_bytes), ("step", sim.step), ("view", sim.view),
                                        ("remove", lambda: sim.remove(0)), ("time", lambda: sim.time))}
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
    for _ in range(100000):  # a few are enough
        if not asks:
            break
        try:
            sim.step(20)
        except RuntimeError:  # the other one steps, or has a view
            time.sleep(0)
    over = True
    other.join()
    assert not asks


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
    sim._callbacks.clear()
    sim.step(20)
    assert [c.hash for c in copies] == [sim.hash] * 3


@pytest.mark.parametrize("send", [os.kill, os.killpg])  # to the first process; to all, as a terminal does
def test_ctrl_c_stops_all_runs_of_a_map(send, tmp_path):
    (tmp_path / "many.py").write_text("""
import carom
if __name__ == "__main__":
    scene = {"box": {"packing_fraction": 0.3}, "run": {"t_end": 1e9}, "output": {"series": True, "every": 1e3, "checkpoint": 0.1},
             "disks": [{"count": 500, "positions": "random", "radius": 0.5, "mass": 1.0, "velocities": {"maxwell": 1.0}}]}
    try:
        carom.map([carom.Scene(scene)] * 6, outs=[f"run{k}" for k in range(6)], jobs=2)
    except KeyboardInterrupt:
        print("stopped")
""")
    script = subprocess.Popen(["/usr/bin/python3", "many.py"], cwd=tmp_path, stdout=subprocess.PIPE, text=True, start_new_session=True)
    try:
        while len(list(tmp_path.glob("run*/carom-unfinished/checkpoint.carom"))) < 2:
            time.sleep(0.05)
        send(script.pid, signal.SIGINT)
        assert script.communicate(timeout=60)[0] == "stopped\n"
    finally:
        if script.poll() is None:
            os.killpg(script.pid, signal.SIGKILL)
    assert sorted(path.name for path in tmp_path.glob("run*")) == ["run0", "run1"]
    assert all(carom.resume(tmp_path / run).time > 0.0 for run in ("run0", "run1"))


def test_a_view_can_be_copied_and_pickled():
    sim = carom.Simulation(gas(30), threads=1)
    with sim.view() as v:
        for other in (copy.copy(v), pickle.loads(pickle.dumps(v))):
            assert np.array_equal(other.x, v.x)
        with pytest.raises(AttributeError, match="the view has no column radius"):
            other.radius
    del other
