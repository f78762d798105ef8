"""A Slurm of one node, this machine, with everything it needs in a folder of its own.

No configuration of the machine is read or changed, no accounting, no cgroups, ports that are free.
"""
import ctypes
import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

CONFIG = """\
ClusterName=scattermeter
SlurmctldHost={node}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controller_port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={home}/munge.socket
StateSaveLocation={home}/state
SlurmdSpoolDir={home}/spool
SlurmctldPidFile={home}/slurmctld.pid
SlurmdPidFile={home}/slurmd.pid
SlurmctldLogFile={home}/slurmctld.log
SlurmdLogFile={home}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName={node} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=8000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
WAIT_S = 40  # for daemons that take a second where they can be had


class CannotStart(Exception):
    """Says why there is no Slurm on this machine."""


def die_with_parent():
    """In a child: SIGTERM when this test ends, however it does (prctl's PR_SET_PDEATHSIG)."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class OneNodeSlurm:
    def __init__(self, home, cpus):
        """Starts it; raises CannotStart, with all stopped again, where that doesn't work. home: no blanks in its path."""
        self.home = Path(home)
        self.daemons = []
        config = self.home / "slurm.conf"
        self.environment = {**os.environ, "SLURM_CONF": str(config),
                            "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
        for name in [n for n in self.environment if n.startswith(("SLURM_", "SBATCH_")) and n != "SLURM_CONF"]:
            del self.environment[name]
        for program in ("munged", "slurmctld", "slurmd", "sbatch"):
            if shutil.which(program, path=self.environment["PATH"]) is None:
                raise CannotStart(f"{program} is not installed (packages slurm-wlm, munge)")
        if os.geteuid() != 0:
            raise CannotStart("slurmd needs root")
        for folder in ("state", "spool"):
            (self.home / folder).mkdir()
        key = self.home / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        config.write_text(CONFIG.format(home=self.home, node=socket.gethostname().split(".")[0], user="root", cpus=cpus,
                                        controller_port=free_port(), node_port=free_port()), encoding="utf-8")
        try:
            self.start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.home}/munge.socket",
                       f"--pid-file={self.home}/munged.pid", f"--log-file={self.home}/munged.log",
                       f"--seed-file={self.home}/munge.seed")
            self.wait_for(lambda: (self.home / "munge.socket").exists())
            self.start("slurmctld", "-D", "-i", "-f", str(config))
            self.start("slurmd", "-D", "-f", str(config))
            self.wait_for(lambda: self.run("sinfo", "--noheader", "--format=%T").stdout.strip() == "idle")
        except BaseException:
            self.stop()
            raise

    def start(self, program, *words):
        with open(self.home / f"{program}.out", "wb") as out:
            self.daemons.append(subprocess.Popen(
                [program, *words], env=self.environment, stdin=subprocess.DEVNULL, stdout=out,
                stderr=subprocess.STDOUT, preexec_fn=die_with_parent))

    def run(self, *words):
        return subprocess.run(words, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=60, check=False)

    def wait_for(self, ready):
        end = time.monotonic() + WAIT_S
        while not ready():
            for daemon in self.daemons:
                if daemon.poll() is not None:
                    raise CannotStart(f"{daemon.args[0]} ended with status {daemon.returncode}: {self.last_words()}")
            if time.monotonic() > end:
                raise CannotStart(f"no node is idle after {WAIT_S} s: {self.last_words()}")
            time.sleep(0.1)

    def last_words(self):
        """The ends of the daemons' logs."""
        texts = [p.read_text(encoding="utf-8", errors="replace").splitlines()[-3:]
                 for p in sorted([*self.home.glob("*.log"), *self.home.glob("*.out")])]
        return " | ".join(line for lines in texts for line in lines)

    def remains(self):
        """Processes that live by this configuration, steps of jobs among them."""
        wanted = f"SLURM_CONF={self.home}/slurm.conf".encode()
        pids = []
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit() or int(entry.name) == os.getpid():
                continue
            try:
                if wanted in (entry / "environ").read_bytes().split(b"\0"):
                    pids.append(int(entry.name))
            except OSError:  # gone, or another user's
                pass
        return pids

    def stop(self):
        if len(self.daemons) == 3 and self.daemons[1].poll() is None:
            try:
                self.run("scancel", "--state=PENDING", "--user=root")
                self.run("scancel", "--user=root")
            except subprocess.TimeoutExpired:
                pass
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        end = time.monotonic() + 10
        while self.remains() and time.monotonic() < end:
            for pid in self.remains():
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            time.sleep(0.1)
