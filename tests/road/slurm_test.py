#!/usr/bin/env python3
"""slurm_test.py PROGRAM SNAKEFILE: samples/campaign with its profile for Slurm, on a Slurm of one node.

The test starts munged, slurmctld and slurmd itself and stops them again. Status 77, with the reason:
this machine does not let it, or Snakemake is not there.
"""
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from one_node_slurm import CannotStart, OneNodeSlurm
from small_rig import write_small_rig

PROGRAM, SNAKEFILE = (Path(p).resolve() for p in sys.argv[1:3])
SAMPLE = SNAKEFILE.parent.parent / "three_plastics"
FOLDERS = 4
SLURM = None


class SlurmCampaign(unittest.TestCase):
    def test_every_folder_is_a_job(self):
        home = Path(tempfile.mkdtemp(prefix="slurm campaign "))
        self.addCleanup(shutil.rmtree, home, ignore_errors=True)
        write_small_rig(SAMPLE, home)
        subprocess.run([PROGRAM, "-q", "simulate", home / "rig.yaml", "--out", home / "shots"], check=True)
        counted = home / "counted"  # notes which job of Slurm measured what
        counted.write_text(f'#!/bin/sh\n"{PROGRAM}" "$@" || [ $? -eq 1 ] || exit 2\n'
                           f'echo "$SLURM_JOB_ID $SLURM_JOB_NAME" >>"{home}/done"\n', encoding="utf-8")
        counted.chmod(0o755)
        lines = [f"scattermeter: {json.dumps(str(counted))}", "options: --model dipole", "measurements:"]
        lines += [f"  day{i}: {{shots: shots, rig: rig.yaml}}" for i in range(FOLDERS)]
        (home / "campaign.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
        done = subprocess.run(
            ["snakemake", "--snakefile", SNAKEFILE, "--configfile", home / "campaign.yaml", "--directory",
             home / "out", "--profile", SNAKEFILE.parent / "slurm"],
            env=SLURM.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + SLURM.last_words())
        jobs = (home / "done").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(jobs), FOLDERS)
        self.assertEqual(len(set(jobs)), FOLDERS, jobs)
        for job in jobs:
            self.assertRegex(job, r"^[0-9]+ scattermeter$")
        subprocess.run([PROGRAM, "-q", "measure", home / "shots", "--rig", home / "rig.yaml", "--out",
                        home / "by hand", "--model", "dipole"], check=False)
        expected = json.loads((home / "by hand" / "result.json").read_text(encoding="utf-8"))["results"]
        for i in range(FOLDERS):
            path = home / "out" / "results" / f"day{i}" / "result.json"
            self.assertEqual(json.loads(path.read_text(encoding="utf-8"))["results"], expected)
        table = (home / "out" / "summary.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(table), 1 + FOLDERS * len(expected))


def main():
    global SLURM
    if shutil.which("snakemake") is None:
        print("skipped: snakemake is not installed")
        return 77
    with tempfile.TemporaryDirectory(prefix="slurm-", dir="/tmp") as home:
        try:
            SLURM = OneNodeSlurm(home, cpus=2)
        except CannotStart as why:
            print(f"skipped: {why}")
            return 77
        try:
            passed = unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful()
        finally:
            SLURM.stop()
        if SLURM.remains():
            print(f"still alive: {SLURM.remains()}")
            return 1
        return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
