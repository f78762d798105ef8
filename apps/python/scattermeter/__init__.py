"""Scattering and absorption of translucent materials, from raw camera shots.

Lengths are mm, coefficients 1/mm. `measure` runs the program `scattermeter`; the forward models are
the program's own code on NumPy arrays.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Dict, List, Optional, Union

from ._models import (
    dipole_reflectance,
    dipole_total_reflectance,
    fresnel_transmittance,
    half_space_albedo,
)

__all__ = [
    "InputError",
    "dipole_reflectance",
    "dipole_total_reflectance",
    "fresnel_transmittance",
    "half_space_albedo",
    "measure",
    "read_result",
    "run",
    "values",
]

PathLike = Union[str, "os.PathLike[str]"]


class InputError(ValueError):
    """A file, a field or a value that cannot be used; the text names all three."""


def run(*arguments: str, program: Optional[PathLike] = None) -> "subprocess.CompletedProcess[str]":
    """Run the program with these arguments; its exit status is 0 or 1 (a value was refused).

    program: its path; by default that of the environment variable SCATTERMETER_PROGRAM, else the
    first `scattermeter` on PATH. Raises InputError for bad input (status 2) with the program's
    message, FileNotFoundError where there is no program, RuntimeError for anything else.
    """
    chosen = program or os.environ.get("SCATTERMETER_PROGRAM") or shutil.which("scattermeter")
    if not chosen:
        raise FileNotFoundError("scattermeter is not on PATH; set SCATTERMETER_PROGRAM")
    done = subprocess.run([os.fspath(chosen), *arguments], capture_output=True, text=True)
    if done.returncode == 2:
        raise InputError(done.stderr.strip().removeprefix("scattermeter: "))
    if done.returncode not in (0, 1):
        raise RuntimeError(f"scattermeter ended with status {done.returncode}: {done.stderr.strip()}")
    return done


def read_result(path: PathLike) -> Dict[str, Any]:
    """The content of a result.json as plain dictionaries, lists, numbers and None (not known).

    `results` has one entry per material and channel; sigma_s_prime_per_mm and sigma_a_per_mm in it
    have value, std and interval95, all in 1/mm. Raises InputError where the file is no result.
    """
    try:
        result = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{os.fspath(path)}: {error}") from error
    if not isinstance(result, dict) or not isinstance(result.get("results"), list):
        raise InputError(f"{os.fspath(path)}: results: is missing")
    return result


def values(result: Dict[str, Any]) -> Dict[str, Dict[str, Dict[str, Any]]]:
    """Entries of a result by material and channel: values(result)["POM"]["R"]."""
    out: Dict[str, Dict[str, Dict[str, Any]]] = {}
    for entry in result["results"]:
        out.setdefault(entry["material"], {})[entry["channel"]] = entry
    return out


def measure(
    shots: PathLike,
    rig: PathLike,
    *,
    out: Optional[PathLike] = None,
    model: str = "auto",
    patch_size_mm: Optional[float] = None,
    time_limit_s: Optional[float] = None,
    threads: Optional[int] = None,
    program: Optional[PathLike] = None,
) -> Dict[str, Any]:
    """Measure the materials in a folder of raw shots; returns what read_result() does.

    shots: folder of the raws. rig: the rig file (YAML). out: folder for result.json and result.html
    (default: none are kept). model: auto, dipole, transport or paper. patch_size_mm: edge of the
    surface patches, mm. time_limit_s: of transport, s per material and channel. threads: all cores
    by default. Raises as run() does; refused values are told by each entry's verdict and reasons.
    """
    arguments: List[str] = ["--quiet", "measure", os.fspath(shots), "--rig", os.fspath(rig)]
    arguments += ["--model", model]
    if patch_size_mm is not None:
        arguments += ["--patch-size", repr(float(patch_size_mm))]
    if time_limit_s is not None:
        arguments += ["--time-limit", repr(float(time_limit_s))]
    if threads is not None:
        arguments += ["--threads", str(int(threads))]
    with tempfile.TemporaryDirectory(prefix="scattermeter_") as temporary:
        folder = os.fspath(out) if out is not None else temporary
        run(*arguments, "--out", folder, program=program)
        return read_result(Path(folder) / "result.json")
