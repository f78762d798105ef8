import json

import pytest

import scattermeter


def test_measures_what_was_simulated(rig, tmp_path):
    scattermeter.run("--quiet", "simulate", str(rig), "--out", str(tmp_path / "shots"))
    result = scattermeter.measure(
        tmp_path / "shots", rig, model="dipole", out=tmp_path / "out", threads=1
    )
    assert result == scattermeter.read_result(tmp_path / "out" / "result.json")
    pom = scattermeter.values(result)["POM"]
    assert set(pom) == {"R", "G", "B"}
    for channel, s, a in (("R", 1.4, 0.002), ("G", 1.6, 0.004), ("B", 1.75, 0.008)):
        entry = pom[channel]
        assert entry["model"] == "dipole"
        for key, truth in (("sigma_s_prime_per_mm", s), ("sigma_a_per_mm", a)):
            assert abs(entry[key]["value"] - truth) < 4.5 * entry[key]["std"], (channel, key)
    # Nothing is left behind without `out`.
    again = scattermeter.measure(tmp_path / "shots", rig, model="dipole", threads=1)
    assert again["results"] == result["results"]


def test_bad_input_is_an_input_error(tmp_path):
    with pytest.raises(scattermeter.InputError, match="nowhere.yaml"):
        scattermeter.measure(tmp_path, tmp_path / "nowhere.yaml")
    with pytest.raises(ValueError, match="guess"):
        scattermeter.measure(tmp_path, tmp_path / "rig.yaml", model="guess")


def test_no_program_is_told(monkeypatch, tmp_path):
    monkeypatch.delenv("SCATTERMETER_PROGRAM", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(FileNotFoundError, match="SCATTERMETER_PROGRAM"):
        scattermeter.run("--version")


def test_a_file_that_is_no_result_is_told(tmp_path):
    path = tmp_path / "result.json"
    with pytest.raises(scattermeter.InputError, match="result.json"):
        scattermeter.read_result(path)
    path.write_text("{")
    with pytest.raises(scattermeter.InputError, match="result.json"):
        scattermeter.read_result(path)
    path.write_text(json.dumps({"results": 3}))
    with pytest.raises(scattermeter.InputError, match="results"):
        scattermeter.read_result(path)
