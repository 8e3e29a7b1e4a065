"""Functions that a simulation calls while it runs: when they are called, and exceptions that they raise."""

import carom
import numpy as np
import pytest

from small_gas import gas


def test_callbacks_come_at_their_times_and_what_they_raise_ends_the_run_only():
    sim = carom.Simulation(gas(), threads=1)
    seen = []
    sim.every(0.25, lambda s: seen.append(s.time))
    sim.run(until=1.0)
    assert seen == pytest.approx([0.25, 0.5, 0.75, 1.0])
    other = carom.Simulation(gas(), threads=1)

    def fail(s):
        raise ZeroDivisionError("on purpose")

    other.every(0.5, fail)
    with pytest.raises(ZeroDivisionError):
        other.run(until=1.0)
    assert other.time == pytest.approx(0.5)
    with pytest.raises(ZeroDivisionError):
        other.run(until=1.0)
    assert other.time == pytest.approx(1.0)
    assert other.hash == sim.hash


def test_a_run_until_a_time_that_has_come_makes_no_step():
    sim = carom.Simulation(gas(), threads=1)
    for until in (0, 0.0, -1.0):
        sim.run(until=until)
        assert sim.steps == 0
    sim.run(until=0.5)
    steps = sim.steps
    sim.run(until=sim.time)
    assert sim.steps == steps > 0


# Sums of dt are rounded, so a step may end a little early; the windows of the exact method end exactly at their end.
@pytest.mark.parametrize("method, t_end, calls", [("pairwise", 1.0 - 5e-7, 1), ("exact", 1.0 - 5e-7, 0), ("exact", 1.0, 1)])
def test_a_little_too_early_is_in_time_for_steps_alone(method, t_end, calls):
    sim = carom.Simulation(carom.Scene.parse(gas(2).toml(), {"run.method": method, "run.t_end": t_end}), threads=1)
    seen = []
    sim.every(1.0, lambda s: seen.append(s.time))
    sim.run()
    assert len(seen) == calls


# Steps end at multiples of the interval, and the quotient of the time and the interval may be rounded to above or below
# a whole number.
@pytest.mark.parametrize("dt, interval", [(0.1, 0.1), (0.01, 0.01), (0.07, 0.07), (0.01, 0.07), (0.03, 0.01)])
def test_callbacks_come_once_at_every_multiple(dt, interval):
    scene = carom.Scene.parse(gas(2).toml(), {"run.dt": dt, "run.t_end": 2000 * dt})
    sim = carom.Simulation(scene, threads=1)
    seen = []

    def note(s):
        assert not seen or s.time > seen[-1]
        seen.append(s.time)

    sim.every(interval, note)
    due, expected = 1, []
    other = carom.Simulation(scene, threads=1)
    while not other.done:
        other.step()
        if other.time >= interval * (due - 1e-6):
            expected.append(other.time)
        while other.time >= interval * (due - 1e-6):
            due += 1
    sim.run()
    assert seen == expected


def test_callbacks_come_with_the_frames_of_a_run(tmp_path):
    """The time 0.3, a sum of thirty dt, is less than 3 * 0.1: frames once accepted it as 0.3, but callbacks waited for
    0.31."""
    scene = carom.Scene.parse(gas(2).toml(), {
        "run.dt": 0.01, "run.t_end": 2.0, "output.every": 0.1, "output.series": True})
    sim, seen = carom.Simulation(scene, threads=1), []
    sim.every(0.1, lambda s: seen.append(s.time))
    sim.run()
    assert seen == list(carom.run(scene, out=tmp_path / "out", threads=1).series["t"][1:])


def test_callbacks_go_on_from_where_a_state_was_taken_up():
    sim = carom.Simulation(gas(2), threads=1)
    seen = []
    sim.every(0.25, lambda s: seen.append(s.time))
    sim.step(30)
    saved = sim.to_bytes()
    sim.run(until=1.0)
    sim.from_bytes(saved)
    sim.run(until=0.8)
    assert seen == pytest.approx([0.25, 0.5, 0.75, 1.0, 0.5, 0.75])


def test_the_next_multiple_is_the_least_beyond_a_time():
    from carom._simulation import _next_multiple
    for interval in (0.1, 0.3, 0.7, 1.1):
        for k in range(1, 300):
            for time in (np.nextafter(interval * k, 0.0), interval * k, np.nextafter(interval * k, np.inf)):
                found = _next_multiple(interval, time)
                assert interval * found > time and (found == 1 or interval * (found - 1) <= time), (interval, time)
    tiny = 1e-17  # 1 contains so many of these that they are not counted one by one
    assert tiny * _next_multiple(tiny, 1.0) > 1.0 >= tiny * np.nextafter(_next_multiple(tiny, 1.0), 0.0)
