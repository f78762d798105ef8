import json
import os
import threading
import time

import pytest

import scattermeter


@pytest.fixture(scope="module")
def shots(rig, tmp_path_factory):
    folder = tmp_path_factory.mktemp("shots")
    written = scattermeter.simulate(rig, folder)
    assert [path.name for path in written] == ["POM.dng"] and written[0].exists()
    return folder


def test_measures_what_was_simulated(rig, shots, tmp_path):
    stages = []
    result = scattermeter.measure(
        shots,
        rig,
        model="dipole",
        out=tmp_path / "out",
        threads=1,
        progress=lambda stage, done, total: stages.append((stage, done, total)),
    )
    assert result == scattermeter.read_result(tmp_path / "out" / "result.json")
    assert result["version"] == scattermeter.__version__
    pom = scattermeter.values(result)["POM"]
    assert set(pom) == {"R", "G", "B"}
    for channel, s, a in (("R", 1.4, 0.002), ("G", 1.6, 0.004), ("B", 1.75, 0.008)):
        entry = pom[channel]
        assert entry["model"] == "dipole"
        for key, truth in (("sigma_s_prime_per_mm", s), ("sigma_a_per_mm", a)):
            assert abs(entry[key]["value"] - truth) < 4.5 * entry[key]["std"], (channel, key)
    assert all(0 <= done <= total for _, done, total in stages)
    assert "POM" in repr(result)
    # Nothing is written without `out`, and only what is asked for is measured.
    again = scattermeter.measure(shots, rig, model="dipole", channels="G")
    assert [e["channel"] for e in again["results"]] == ["G"]
    for key in ("sigma_s_prime_per_mm", "sigma_a_per_mm"):
        # All channels of a material judge the rig together.
        alone = again["results"][0][key]["value"]
        assert abs(alone - pom["G"][key]["value"]) < 0.1 * pom["G"][key]["std"]


def test_results_become_a_table(rig, shots):
    pandas = pytest.importorskip("pandas")
    frame = scattermeter.measure(shots, rig, model="dipole").to_dataframe()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == 3
    assert (frame["sigma_s_prime_per_mm_low"] < frame["sigma_s_prime_per_mm"]).all()


def test_checks_plans_and_exports(rig, shots, tmp_path):
    assert scattermeter.check(shots, rig)["checks"]
    assert scattermeter.plan(rig, other_shots=False)["forecast"]
    scattermeter.measure(shots, rig, model="dipole", out=tmp_path)
    csv = scattermeter.export(tmp_path / "result.json", "csv", tmp_path / "pom.csv")
    assert csv.read_text().count("POM") == 3
    with pytest.raises(scattermeter.InputError, match="format"):
        scattermeter.export(tmp_path / "result.json", "word", tmp_path / "pom.doc")


def test_progress_may_raise(rig, shots):
    class Enough(Exception):
        pass

    def stop(stage, done, total):
        raise Enough(stage)

    with pytest.raises(Enough):
        scattermeter.measure(shots, rig, model="transport", time_limit_s=60, progress=stop)


def test_ctrl_c_ends_a_measurement(rig, shots):
    timer = threading.Timer(1.0, lambda: os.kill(os.getpid(), 2))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        scattermeter.measure(shots, rig, model="transport", time_limit_s=600)
    timer.join()


def test_other_threads_run_meanwhile(rig, shots):
    counted = []
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted.append(1)
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    scattermeter.measure(shots, rig, model="dipole")
    stop.set()
    thread.join()
    assert len(counted) > 3


def test_bad_input_is_an_input_error(rig, shots, tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere.yaml"):
        scattermeter.measure(tmp_path, tmp_path / "nowhere.yaml")
    with pytest.raises(FileNotFoundError, match="nowhere"):
        scattermeter.measure(tmp_path / "nowhere", rig)
    with pytest.raises(ValueError, match="guess"):
        scattermeter.measure(shots, rig, model="guess")
    bad = tmp_path / "rig.yaml"
    bad.write_text(rig.read_text().replace("eta: 1.4", "eta: 0.4"))
    with pytest.raises(scattermeter.InputError, match="eta"):
        scattermeter.measure(shots, bad)


def test_a_file_that_is_no_result_is_reported(tmp_path):
    path = tmp_path / "result.json"
    with pytest.raises(FileNotFoundError, match="result.json"):
        scattermeter.read_result(path)
    path.write_text("{")
    with pytest.raises(scattermeter.InputError, match="result.json"):
        scattermeter.read_result(path)
    path.write_text(json.dumps({"results": 3}))
    with pytest.raises(scattermeter.InputError, match="results"):
        scattermeter.read_result(path)
