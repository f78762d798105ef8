import inspect

import numpy as np
import pytest

import scattermeter


def dipole(d, s, a, eta):
    """The paper's equations 3 to 9, once more."""
    f = -1.440 / eta**2 + 0.710 / eta + 0.668 + 0.0636 * eta
    mismatch = (1 + f) / (1 - f)
    t = s + a
    k = np.sqrt(3 * a * t)
    zr = 1 / t
    zv = zr * (1 + 4 * mismatch / 3)
    total = 0
    for z in (zr, zv):
        r = np.sqrt(d**2 + z**2)
        total = total + z * (k + 1 / r) * np.exp(-k * r) / r**2
    return s / t / (4 * np.pi) * total


def test_dipole_is_that_of_the_paper():
    d = np.geomspace(0.01, 30, 50)
    r = scattermeter.dipole_reflectance(d, 2.19, 0.002, 1.3)
    assert r.shape == d.shape and r.dtype == np.float64
    np.testing.assert_allclose(r, dipole(d, 2.19, 0.002, 1.3), rtol=1e-12)


def test_arguments_are_broadcast():
    d = np.linspace(0.1, 5, 7)[:, None]
    s = np.array([0.5, 1.0, 2.0])[None, :]
    r = scattermeter.dipole_reflectance(d, s, 0.01, 1.4)
    assert r.shape == (7, 3)
    np.testing.assert_allclose(r, dipole(d, s, 0.01, 1.4), rtol=1e-12)
    assert isinstance(scattermeter.dipole_reflectance(1.0, 1.0, 0.01, 1.4), float)


def test_total_is_the_integral_over_the_plane():
    d = np.geomspace(1e-4, 500, 20001)
    ring = 2 * np.pi * d * scattermeter.dipole_reflectance(d, 1.0, 0.05, 1.3)
    integral = np.trapz(ring * d, np.log(d))
    assert scattermeter.dipole_total_reflectance(1.0, 0.05, 1.3) == pytest.approx(integral, rel=1e-5)


def test_fresnel_at_normal_incidence():
    eta = np.array([1.0, 1.3, 1.5])
    expected = 1 - ((eta - 1) / (eta + 1)) ** 2
    np.testing.assert_allclose(scattermeter.fresnel_transmittance(eta, 1.0), expected, rtol=1e-12)


def test_half_space_sends_everything_back_without_absorption():
    albedo = scattermeter.half_space_albedo(np.array([0.0, 0.5, 1.0]))
    assert albedo[0] == 0 and albedo[2] == pytest.approx(1, abs=1e-12)
    # Van de Hulst's approximation is within 0.0021.
    s = np.sqrt(0.5)
    assert albedo[1] == pytest.approx((1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s), abs=0.0021)


@pytest.mark.parametrize("medium", [(-1, 0.1, 1.3), (1, -0.1, 1.3), (1, 0.1, 0), (np.nan, 0, 1.3)])
def test_values_outside_the_domain_are_refused(medium):
    with pytest.raises(ValueError, match="Dipole"):
        scattermeter.dipole_reflectance(1.0, *medium)


def test_everything_public_says_its_units():
    for name in scattermeter.__all__:
        doc = inspect.getdoc(getattr(scattermeter, name))
        assert doc, name
    assert "1/mm^2" in scattermeter.dipole_reflectance.__doc__
    assert "mm" in scattermeter.measure.__doc__
