# SPDX-License-Identifier: MIT
"""Builds a wheel of the module with CMake: as much of a build backend as pip asks for.

config settings: cmake-args="-D ..." goes to CMake; the code is portable unless that says otherwise.
"""

import base64
import hashlib
import os
import pathlib
import shlex
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]


def _project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def _metadata(project):
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
             f"Summary: {project['description']}", "License: MIT", f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {need}" for need in project["dependencies"]]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (ROOT / "README.md").read_text(encoding="utf-8")])


def _tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _built(settings):
    """The folder of the package, built."""
    build = ROOT / "build" / "wheel"
    more = shlex.split((settings or {}).get("cmake-args", ""))
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DSHAKEDOWN_PYTHON=ON",
                    "-DSHAKEDOWN_CPU=portable", "-DSHAKEDOWN_TOGETHER=ON", "-DSHAKEDOWN_WERROR=OFF", "-DSHAKEDOWN_TESTS=OFF",
                    "-DSHAKEDOWN_BENCH=OFF", "-DSHAKEDOWN_INSTALL=OFF",
                    f"-DPython_EXECUTABLE={sys.executable}", *more], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "shakedown_python", "--parallel", str(os.cpu_count() or 1)], check=True)
    return build / "python" / "shakedown"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    project = _project()
    package, tag = _built(config_settings), _tag()
    about = f"{project['name']}-{project['version']}.dist-info"
    files = {f"shakedown/{file.name}": file.read_bytes() for file in sorted(package.iterdir()) if file.is_file()}
    files[f"{about}/METADATA"] = _metadata(project).encode()
    files[f"{about}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: shakedown\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{about}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = ""
    name = f"{project['name']}-{project['version']}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for file, contents in files.items():
            wheel.writestr(file, contents)
            digest = base64.urlsafe_b64encode(hashlib.sha256(contents).digest()).rstrip(b"=").decode()
            record += f"{file},sha256={digest},{len(contents)}\n"
        wheel.writestr(f"{about}/RECORD", record + f"{about}/RECORD,,\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    project = _project()
    base = f"{project['name']}-{project['version']}"
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\n")
    with tarfile.open(pathlib.Path(sdist_directory) / f"{base}.tar.gz", "w:gz") as archive:
        for file in filter(None, listed):
            archive.add(ROOT / file, f"{base}/{file}")
    return f"{base}.tar.gz"
