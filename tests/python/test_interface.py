"""Every name of the module has a doc string, and types."""

import inspect
import pickle
import typing

import carom
import numpy as np


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
        typing.get_type_hints(call)  # raises if a type is unknown


def test_every_column_has_a_type():
    scene = carom.Scene({
        "box": {"width": 9.0, "height": 9.0}, "physics": {"roughness": {"tangential_restitution": 0.5}},
        "disks": [{"count": 2, "positions": "random", "radius": 0.5, "mass": 1.0}], "run": {"t_end": 1.0}})
    frame = carom.Simulation(scene, threads=1).disks()
    types = typing.get_type_hints(carom.Frame)
    assert "spin" in frame.names and all(types[name] is np.ndarray for name in (*frame.names, "group"))
    assert set(vars(frame)) <= set(types)
