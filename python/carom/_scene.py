"""Scenes, read and checked."""

from __future__ import annotations

from typing import Any, Mapping

from . import _arguments, _carom
from ._text import in_words_of_python as _in_words_of_python, overrides as _overrides, toml as _toml


class Scene:
    """A scene, read and checked.

    Scene({...}) takes the tables and keys of a scene file as a dictionary; lists may be numpy arrays. changes replaces
    values of the scene: {"run.t_end": 50.0}. Raises SceneError with a line that says what is wrong and what was
    expected.
    """

    def __init__(self, tables: Mapping[str, Any], changes: Mapping[str, Any] = {}):
        with _in_words_of_python():
            self._scene = _carom.parse_scene(_toml(tables), "scene", "", _overrides(changes))

    @classmethod
    def load(cls, path: _arguments.AnyPath, changes: Mapping[str, Any] = {}) -> "Scene":
        """The scene in a TOML file. Raises SceneError (file, line, key, what was expected)."""
        return cls._of(_carom.load_scene, _arguments.path(path), _overrides(changes))

    @classmethod
    def parse(cls, text: str, changes: Mapping[str, Any] = {}, folder: str = "") -> "Scene":
        """The scene of a TOML text; paths in it are relative to folder."""
        text = _arguments.text(text, "the text of a scene")
        return cls._of(_carom.parse_scene, text, "scene", _arguments.path(folder), _overrides(changes))

    @classmethod
    def _of(cls, read, *arguments):
        scene = cls.__new__(cls)
        with _in_words_of_python():
            scene._scene = read(*arguments)
        return scene

    # As it was read: files that it came from may be changed by the time that it is taken up, or lie on another machine.
    def __getstate__(self):
        return self.toml(), self._scene.file

    def __setstate__(self, state):
        text, name = state
        self._scene = _carom.parse_scene(text, name, "", [])

    @classmethod
    def _checked(cls, scene):
        """The scene of the compiled module. Raises TypeError for anything but a Scene."""
        if not isinstance(scene, cls):
            raise TypeError(f"expected a carom.Scene, not {type(scene).__name__}: carom.Scene.load(path) reads a file, "
                            "carom.Scene({...}) takes a dictionary")
        return scene._scene

    @property
    def title(self) -> str:
        """Empty if the scene has none."""
        return self._scene.title

    @property
    def width(self) -> float:
        """Width of the box; length."""
        return self._scene.width

    @property
    def height(self) -> float:
        """Height of the box; length."""
        return self._scene.height

    @property
    def t_end(self) -> float:
        """Simulated time at which a run ends."""
        return self._scene.t_end

    @property
    def seed(self) -> int:
        """Seed of the random numbers."""
        return self._scene.seed

    @property
    def warnings(self) -> list:
        """Warnings about settings that are no errors but may not be intended, one line each."""
        return self._scene.warnings()

    def toml(self) -> str:
        """The scene as TOML, with the defaults of what it uses written out."""
        return self._scene.toml()

    def __repr__(self):
        return f"<carom.Scene {self.title or self._scene.file!r}, {self.width:g} x {self.height:g}, t_end {self.t_end:g}>"
