#!/usr/bin/env python3
"""schema_test.py PROGRAM SOURCE: the schemas of rig and result against the files that the program reads and writes."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import jsonschema
    import yaml
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# 2.4e10 is a number in YAML 1.2, which the rig is read as.
yaml.SafeLoader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"[-+]?[\d.]+[eE][-+]?\d+$"),
                                      list("-+.0123456789"))
PROGRAM, SOURCE = (Path(p).resolve() for p in sys.argv[1:3])
RIG = json.loads((SOURCE / "apps/rig/rig.schema.json").read_text(encoding="utf-8"))
RESULT = json.loads((SOURCE / "apps/results/result.schema.json").read_text(encoding="utf-8"))


def objects(schema):
    """Every set of keys of an object in the schema that allows no others."""
    if isinstance(schema, dict):
        if schema.get("additionalProperties") is False:
            yield frozenset(schema["properties"])
        for value in schema.values():
            yield from objects(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from objects(value)


class Schema(unittest.TestCase):
    def run_program(self, *words):
        done = subprocess.run([PROGRAM, "-q", *words], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def rig(self, path):
        return yaml.safe_load(Path(path).read_text(encoding="utf-8"))

    def test_knows_the_keys_that_the_reader_knows(self):
        known = set(objects(RIG))
        for source in sorted((SOURCE / "apps/rig").glob("rig_*.cc")):
            for keys in re.findall(r"only\(\s*\{(.*?)\}\)", source.read_text(encoding="utf-8"), re.S):
                self.assertIn(frozenset(re.findall(r'"([^"]+)"', keys)), known, source.name)

    def test_the_samples_are_valid_and_mistakes_are_not(self):
        jsonschema.Draft7Validator.check_schema(RIG)
        samples = sorted((SOURCE / "samples").glob("*/*.yaml"))
        rigs = [path for path in samples if "scattermeter_rig:" in path.read_text(encoding="utf-8")]
        self.assertGreaterEqual(len(rigs), 4)
        for path in rigs:
            jsonschema.validate(self.rig(path), RIG)
        for change in ({"lihgts": {}}, {"shots": []}, {"scattermeter_rig": 2}):
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate({**self.rig(rigs[-1]), **change}, RIG)
        bad = self.rig(rigs[-1])
        next(iter(bad["objects"].values()))["eta"] = "1,49"
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.validate(bad, RIG)

    def test_what_the_program_writes_is_valid(self):
        with tempfile.TemporaryDirectory() as home:
            rig = f"{home}/rig.yaml"
            self.run_program("init", "--example", "--out", rig, "--led", "led1", "--led", "led2")
            text = Path(rig).read_text(encoding="utf-8")
            # The first line leads editors to the schema.
            schema = re.match(r"# yaml-language-server: \$schema=(.*)\n", text).group(1)
            self.assertEqual(json.loads(Path(schema).read_text(encoding="utf-8")), RIG)
            jsonschema.validate(self.rig(rig), RIG)
            for full, quarter in (("[3872, 2592]", "[1936, 1296]"), ("9680", "4840"), ("1935.5", "967.5"),
                                  ("1295.5", "647.5")):
                text = text.replace(full, quarter)
            Path(rig).write_text(text, encoding="utf-8")
            self.run_program("simulate", rig, "--out", f"{home}/shots")
            self.run_program("measure", f"{home}/shots", "--rig", rig, "--out", f"{home}/result")
            result = json.loads(Path(f"{home}/result/result.json").read_text(encoding="utf-8"))
            jsonschema.Draft7Validator.check_schema(RESULT)
            jsonschema.validate(result, RESULT)
            # It names its schema, as results of earlier versions do not.
            self.assertEqual(result["$schema"], RESULT["$id"])
            jsonschema.validate({key: value for key, value in result.items() if key != "$schema"}, RESULT)
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate({**result, "$schema": "urn:scattermeter:result:2"}, RESULT)
            # Every key of a channel is described.
            self.assertLessEqual(set(result["results"][0]), set(RESULT["definitions"]["channel"]["properties"]))
            del result["results"][0]["verdict"]
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(result, RESULT)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
