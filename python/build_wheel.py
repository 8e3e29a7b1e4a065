"""The PEP 517 backend of `pip install .`: CMake builds the compiled part, and this module packs the wheel. It needs no
network, and only Python's own library."""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

root = pathlib.Path(__file__).resolve().parent.parent
build = root / "build" / f"pip-{sys.implementation.cache_tag}"


def _project() -> dict:
    """Name, version and so on from pyproject.toml. Python before 3.11 has no tomllib, so only plain strings are
    read."""
    text = (root / "pyproject.toml").read_text()
    return dict(re.findall(r'^(name|version|description|requires-python) = "(.*)"$', text, re.MULTILINE))


def _metadata() -> str:
    project = _project()
    return (f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n"
            f"Summary: {project['description']}\nRequires-Python: {project['requires-python']}\nRequires-Dist: numpy\n")


def _tag() -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _compile() -> list:
    """The files of the built package that belong to the sources; the folder may still have files of earlier sources."""
    generator = ["-G", "Ninja"] if not (build / "CMakeCache.txt").exists() else []
    subprocess.run(["cmake", "-S", str(root), "-B", str(build), *generator, "-DCMAKE_BUILD_TYPE=Release",
                    "-DCAROM_PYTHON=ON", "-DCAROM_PROGRAM=OFF", "-DCAROM_LIBRARY=OFF", "-DBUILD_TESTING=OFF",
                    f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", str(build), "--target", "carom_python", "carom_python_files"], check=True)
    folder = build / "python" / "carom"
    return [*(folder / file.name for file in sorted((root / "python" / "carom").iterdir()) if file.is_file()),
            *sorted(folder.glob("_carom*.so"))]


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    project = _project()
    name = f"{project['name']}-{project['version']}"
    info = f"{name}.dist-info"
    files = {f"carom/{file.name}": file.read_bytes() for file in _compile()}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: carom\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    record = ""
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"{name}-{_tag()}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            archive.writestr(path, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """The files known to git, as they are now."""
    project = _project()
    name = f"{project['name']}-{project['version']}"
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], check=True, capture_output=True).stdout
    info = build / "PKG-INFO"
    build.mkdir(parents=True, exist_ok=True)
    info.write_text(_metadata())
    with tarfile.open(os.path.join(sdist_directory, f"{name}.tar.gz"), "w:gz") as archive:
        for path in filter(None, listed.decode().split("\0")):
            archive.add(root / path, f"{name}/{path}")
        archive.add(info, f"{name}/PKG-INFO")
    return f"{name}.tar.gz"
