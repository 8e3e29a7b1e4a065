"""Ctrl-C stops work that is going on, within steps or outside them, and leaves files from which a run can be
continued."""

import os
import signal
import subprocess
import threading
import time

import carom
import pytest
from test_carom import gas


def press_ctrl_c(seconds):
    timer = threading.Timer(seconds, lambda: signal.pthread_kill(threading.main_thread().ident, signal.SIGINT))
    timer.start()
    return timer


def test_ctrl_c_stops_between_steps_and_the_simulation_goes_on():
    scene = gas(2000, t_end=1e6)
    sim = carom.Simulation(scene, threads=1)
    timer = press_ctrl_c(0.3)
    with pytest.raises(KeyboardInterrupt):
        sim.run()
    timer.join()
    steps = sim.steps
    sim.step(10)
    other = carom.Simulation(scene, threads=1)
    other.step(steps + 10)
    assert other.hash == sim.hash


def test_ctrl_c_in_a_whole_run_leaves_a_checkpoint(tmp_path):
    scene = carom.Scene({"box": {"packing_fraction": 0.3}, "output": {"series": True},
                         "disks": [{"count": 2000, "positions": "random", "radius": 0.5, "mass": 1.0,
                                    "velocities": {"maxwell": 1.0}}],
                         "run": {"method": "pairwise", "dt": 0.01, "t_end": 1e6}})
    timer = press_ctrl_c(0.5)
    with pytest.raises(KeyboardInterrupt):
        carom.run(scene, out=tmp_path / "run")
    timer.join()
    assert carom.resume(tmp_path / "run").time > 0.0


def test_what_another_signal_raises_ends_a_run_too(tmp_path):
    class Late(Exception):
        pass

    def late(*_):
        raise Late("enough")

    before = signal.signal(signal.SIGALRM, late)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(Late, match="^enough$"):
            carom.run(carom.Scene.parse(gas(2000, t_end=1e6).toml(), {"output.series": True}), out=tmp_path / "run")
        assert carom.resume(tmp_path / "run").time > 0.0
        sim = carom.Simulation(gas(2000, t_end=1e6), threads=1)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(Late, match="^enough$"):
            sim.run()
    finally:
        signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("engine", ["parallel", "reference"])
def test_ctrl_c_while_disks_grow(engine, tmp_path):
    # Disks would grow for more than half a minute, and a step of growth takes seconds.
    scene = carom.Scene({"box": {"packing_fraction": 0.83}, "growth": {"slowness": 1000.0},
                         "disks": [{"count": 5000, "positions": "growth", "radius": 0.5, "mass": 1.0,
                                    "velocities": {"maxwell": 1.0}}],
                         "run": {"t_end": 1.0}, "output": {"series": True}})
    for make in (lambda: carom.Simulation(scene, threads=1, engine=engine),
                 lambda: carom.run(scene, out=tmp_path / "run", threads=1, engine=engine)):
        began = time.monotonic()
        timer = press_ctrl_c(0.3)
        with pytest.raises(KeyboardInterrupt):
            make()
        timer.join()
        assert time.monotonic() - began < 10.0
        assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("engine", ["parallel", "reference"])
def test_ctrl_c_while_disks_are_placed(engine):
    # A million disks have no room at this density, and finding this out takes almost a minute.
    scene = carom.Scene({"box": {"packing_fraction": 0.549}, "run": {"t_end": 1.0},
                         "disks": [{"count": 1000000, "positions": "random", "radius": 0.5, "mass": 1.0}]})
    began = time.monotonic()
    timer = press_ctrl_c(0.3)
    with pytest.raises(KeyboardInterrupt):
        carom.Simulation(scene, threads=1, engine=engine)
    timer.join()
    assert time.monotonic() - began < 10.0


@pytest.mark.parametrize("send", [os.kill, os.killpg])  # to the first process only, and to all of them, like a terminal
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
            assert script.poll() is None, "it ended by itself"
            time.sleep(0.05)
        send(script.pid, signal.SIGINT)
        assert script.communicate(timeout=60)[0] == "stopped\n"
    finally:
        if script.poll() is None:
            os.killpg(script.pid, signal.SIGKILL)
    assert sorted(path.name for path in tmp_path.glob("run*")) == ["run0", "run1"]
    assert all(carom.resume(tmp_path / run).time > 0.0 for run in ("run0", "run1"))
