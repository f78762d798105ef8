#!/usr/bin/env python3
"""campaign_test.py PROGRAM SNAKEFILE KILLS KILLS_LONG: twenty small folders, two at a time, killed and resumed.

Every folder ends up measured once, with the digits of a run by hand. Then KILLS times (KILLS_LONG with
SCATTERMETER_LONG set) kill -9 at random moments of a smaller campaign, resumed each time. Status 77:
Snakemake is not there.
"""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from small_rig import write_small_rig

PROGRAM, SNAKEFILE = (Path(p).resolve() for p in sys.argv[1:3])
KILLS = int(sys.argv[4 if "SCATTERMETER_LONG" in os.environ else 3])
SAMPLE = SNAKEFILE.parent.parent / "three_plastics"
FOLDERS = 20
FEW = 4  # of the campaign that is killed at random


class Campaign(unittest.TestCase):
    def setUp(self):
        self.home = Path(tempfile.mkdtemp(prefix="campaign it's "))
        self.addCleanup(shutil.rmtree, self.home, ignore_errors=True)
        write_small_rig(SAMPLE, self.home)
        subprocess.run([PROGRAM, "-q", "simulate", self.home / "rig.yaml", "--out", self.home / "shots"], check=True)
        # The same shots under twenty names: what is tested here is who measures them, and how often.
        lines = [f"scattermeter: {json.dumps(str(self.home / 'counted'))}", "options: --model dipole", "measurements:"]
        for i in range(FOLDERS):
            folder = f"day {i:02}"
            shutil.copytree(self.home / "shots", self.home / folder)
            lines.append(f"  {json.dumps(folder)}: {{shots: {json.dumps(folder)}, rig: rig.yaml}}")
        (self.home / "campaign.yaml").write_text("\n".join(lines) + "\n", encoding="utf-8")
        (self.home / "few.yaml").write_text("\n".join(lines[:3 + FEW]) + "\n", encoding="utf-8")
        counted = self.home / "counted"
        # Notes every measurement that came to its end.
        counted.write_text(f'#!/bin/sh\n"{PROGRAM}" "$@" || [ $? -eq 1 ] || exit 2\n'
                           f'echo "$3" >>"{self.home}/done"\n', encoding="utf-8")
        counted.chmod(0o755)

    def run_campaign(self, *more, config="campaign.yaml", **options):
        command = ["snakemake", "--snakefile", str(SNAKEFILE), "--configfile", str(self.home / config),
                   "--directory", str(self.home / "out"), "--cores", "2", "--nolock", *more]
        # Not in the log of the test, but for what fails.
        log = open(self.home / "log", "ab")
        self.addCleanup(log.close)
        return subprocess.Popen(command, stdout=log, stderr=log, start_new_session=True, **options)

    def by_hand(self):
        """The results of the folders, which are all alike."""
        subprocess.run([PROGRAM, "-q", "measure", self.home / "shots", "--rig", self.home / "rig.yaml", "--out",
                        self.home / "by hand", "--model", "dipole"], check=False)
        return json.loads((self.home / "by hand" / "result.json").read_text(encoding="utf-8"))["results"]

    def measured(self):
        done = self.home / "done"
        return done.read_text(encoding="utf-8").splitlines() if done.exists() else []

    def test_killed_in_the_middle_and_resumed(self):
        first = self.run_campaign()
        while len(self.measured()) < FOLDERS // 2 and first.poll() is None:
            time.sleep(0.05)
        os.killpg(first.pid, signal.SIGKILL)
        first.wait()
        self.assertEqual(first.returncode, -signal.SIGKILL, (self.home / "log").read_text())
        before = {p: p.stat().st_mtime_ns for p in (self.home / "out").glob("results/*/result.json")}
        self.assertGreaterEqual(len(before), FOLDERS // 2 - 2)
        self.assertLess(len(before), FOLDERS)
        for path in before:
            json.loads(path.read_text(encoding="utf-8"))  # none is half
        second = self.run_campaign("--rerun-incomplete")
        self.assertEqual(second.wait(), 0, (self.home / "log").read_text())
        results = sorted((self.home / "out").glob("results/*/result.json"))
        self.assertEqual(len(results), FOLDERS)
        # At most the two that ran when the kill came are measured again.
        again = [p for p, at in before.items() if p.stat().st_mtime_ns != at]
        self.assertLessEqual(len(again), 2)
        self.assertLessEqual(len(self.measured()), FOLDERS + 2)
        self.assertEqual(len(set(self.measured())), FOLDERS)
        expected = self.by_hand()
        for path in results:
            self.assertEqual(json.loads(path.read_text(encoding="utf-8"))["results"], expected)
        table = (self.home / "out" / "summary.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(table), 1 + FOLDERS * len(expected))
        self.assertEqual((self.home / "out" / "summary.html").read_text(encoding="utf-8").count("<tr class"),
                         FOLDERS * len(expected))
        count = len(self.measured())
        third = self.run_campaign()
        self.assertEqual(third.wait(), 0)
        self.assertEqual(len(self.measured()), count)  # nothing left to do

    def check_final_names(self, expected, whole):
        """What stands under a final name is whole; `whole`: and all of it is there."""
        out = self.home / "out"
        results = list(out.glob("results/*/result.json"))
        for path in results:
            self.assertEqual(json.loads(path.read_text(encoding="utf-8"))["results"], expected)
        if whole:
            self.assertEqual(len(results), FEW)
        if whole or (out / "summary.csv").exists():
            table = (out / "summary.csv").read_text(encoding="utf-8").splitlines()
            self.assertEqual(len(table), 1 + FEW * len(expected))
        if whole or (out / "summary.html").exists():
            self.assertTrue((out / "summary.html").read_text(encoding="utf-8").rstrip().endswith("</html>"))

    def test_killed_at_random_moments(self):
        expected = self.by_hand()
        began = time.monotonic()
        self.assertEqual(self.run_campaign(config="few.yaml").wait(), 0)
        takes = time.monotonic() - began
        self.check_final_names(expected, True)
        shutil.rmtree(self.home / "out")
        draw = random.Random(7)
        killed = 0
        while killed < KILLS:
            run = self.run_campaign("--rerun-incomplete", config="few.yaml")
            try:
                self.assertEqual(run.wait(timeout=draw.uniform(0, takes)), 0, (self.home / "log").read_text())
                self.check_final_names(expected, True)
                shutil.rmtree(self.home / "out")  # came to its end: begin anew
            except subprocess.TimeoutExpired:
                os.killpg(run.pid, signal.SIGKILL)
                run.wait()
                killed += 1
                self.check_final_names(expected, False)
        self.assertEqual(self.run_campaign("--rerun-incomplete", config="few.yaml").wait(), 0,
                         (self.home / "log").read_text())
        self.check_final_names(expected, True)

    def test_a_missing_folder_is_named(self):
        shutil.rmtree(self.home / "day 07")
        self.assertNotEqual(self.run_campaign().wait(), 0)
        self.assertIn("measurements.day 07.shots", (self.home / "log").read_text(encoding="utf-8"))


if __name__ == "__main__":
    if shutil.which("snakemake") is None:
        print("skipped: snakemake is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
