from typing import Any, Callable, Dict, List, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class InputError(ValueError): ...

_Values = Union[float, NDArray[np.float64]]
_Progress = Optional[Callable[[str, int, int], None]]

def measure(
    shots: str,
    rig: str,
    model: str,
    patch_size_mm: Optional[float],
    time_limit_s: float,
    materials: List[str],
    channels: str,
    cache: str,
    threads: Optional[int],
    progress: _Progress,
) -> str: ...
def check(shots: str, rig: str, progress: _Progress) -> str: ...
def simulate(
    rig: str, out: str, volume: bool, paths: int, seed: int, noise: bool, progress: _Progress
) -> List[str]: ...
def plan(rig: str, other_shots: bool, progress: _Progress) -> str: ...
def calibrate_camera(shots: str, rig: str, progress: _Progress) -> str: ...
def calibrate_led(shots: str, rig: str, light: str, progress: _Progress) -> str: ...
def calibrate_radiance(shots: str, rig: str, progress: _Progress) -> str: ...
def export(
    result: str,
    format: str,
    out: str,
    materials: List[str],
    mm_per_unit: Optional[float],
    g: float,
) -> None: ...
def estimate(
    camera: Dict[str, Any],
    objects: Dict[str, Any],
    lights: Dict[str, Any],
    shots: List[Dict[str, Any]],
    model: str,
    patch_size_mm: Optional[float],
    time_limit_s: float,
    even_light_share_std: float,
    progress: _Progress,
) -> str: ...
def write_text_file(path: str, text: str) -> None: ...
def dipole_reflectance(
    distance_mm: ArrayLike,
    sigma_s_prime_per_mm: ArrayLike,
    sigma_a_per_mm: ArrayLike,
    eta: ArrayLike,
) -> _Values: ...
def dipole_total_reflectance(
    sigma_s_prime_per_mm: ArrayLike, sigma_a_per_mm: ArrayLike, eta: ArrayLike
) -> _Values: ...
def fresnel_transmittance(eta: ArrayLike, cos_theta: ArrayLike) -> _Values: ...
def half_space_albedo(albedo: ArrayLike) -> _Values: ...
