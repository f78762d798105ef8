from typing import Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Result = Union[float, NDArray[np.float64]]

def dipole_reflectance(
    distance_mm: ArrayLike,
    sigma_s_prime_per_mm: ArrayLike,
    sigma_a_per_mm: ArrayLike,
    eta: ArrayLike,
) -> _Result: ...
def dipole_total_reflectance(
    sigma_s_prime_per_mm: ArrayLike, sigma_a_per_mm: ArrayLike, eta: ArrayLike
) -> _Result: ...
def fresnel_transmittance(eta: ArrayLike, cos_theta: ArrayLike) -> _Result: ...
def half_space_albedo(albedo: ArrayLike) -> _Result: ...
