#!/usr/bin/env python3
"""Sweeps by docs/cluster: a Snakemake workflow and a Slurm array of which one shard is killed end with
the store of a single sweep. Slurm's controller and node, and munge, are started here, for the test.

usage: cluster_test.py SLIPCHECK SOURCE_DIR
"""
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
from sweep_store import contents, runs_in  # noqa: E402

SLIPCHECK, SOURCE = sys.argv[1], Path(sys.argv[2])
CLUSTER = SOURCE / "docs/cluster"
SHARDS = 4

# Long enough that a shard is caught at work.
SWEEP = (SOURCE / "scenarios/symmetric-30cms.yaml").read_text().split("compare:")[0] + """
compare: {tolerance: {sliding_time: 1 %, effective_restitution: 0.005}}
sweep:
  grid:
    engine: bullet
    rate: [240, 1000, 4000]
    contacts.0.normal.restitution: {from: 0.3, to: 0.9, count: 16}
    phases: [16, 64]
"""


def writer_of(written):
    """The process that writes this store, as its command has it written; None if it is not there."""
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if str(written).encode() in words and words[0] == SLIPCHECK.encode():
            return int(entry.name)
    return None


class Cluster(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.path = Path(self.directory.name)
        (self.path / "s.yaml").write_text(SWEEP)
        subprocess.run([SLIPCHECK, "sweep", self.path / "s.yaml", "-o", self.path / "whole.db",
                        "--quiet"], check=True)

    def tearDown(self):
        self.directory.cleanup()

    def kill_shard(self, written, patience=240):
        """Kills it at work, once it has made a run. It stands while that is looked at, so that it
        cannot be done before. patience [s]: schedulers start slowly where much else runs."""
        store = self.path / written
        end = time.monotonic() + patience
        while time.monotonic() < end:
            pid = writer_of(written)
            try:
                while pid is not None and time.monotonic() < end:
                    os.kill(pid, signal.SIGSTOP)
                    if runs_in(store) > 0:
                        os.kill(pid, signal.SIGKILL)
                        return
                    os.kill(pid, signal.SIGCONT)
                    time.sleep(0.001)
            except ProcessLookupError:  # it was done, or was what starts the writer
                continue
            time.sleep(0.01)
        self.fail(f"no process came to write {store}")

    def same(self, store):
        self.assertEqual(contents(store), contents(self.path / "whole.db"))

    @unittest.skipUnless(shutil.which("snakemake"), "package snakemake is not installed")
    def test_snakemake(self):
        environment = dict(os.environ, HOME=str(self.path), XDG_CACHE_HOME=str(self.path / "cache"))
        process = subprocess.Popen(
            ["snakemake", "-s", CLUSTER / "Snakefile", "--directory", self.path, "--cores", "2",
             "--config", "sweep=s.yaml", f"shards={SHARDS}", "out=out.db",
             f"slipcheck={SLIPCHECK}"],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        try:
            self.kill_shard(f"out.db.shards/2-of-{SHARDS}.db")
        finally:
            said = process.communicate(timeout=120)[0]
        self.assertEqual(process.returncode, 0, said)
        self.same(self.path / "out.db")

    @unittest.skipUnless(all(shutil.which(each, path="/usr/sbin:/usr/bin") for each in
                             ("munged", "slurmctld", "slurmd", "sbatch")),
                         "packages slurm-wlm and munge are not installed")
    def test_slurm(self):
        with Slurm(self.path) as slurm:
            job = slurm.run("sbatch", "--parsable", f"--array=1-{SHARDS}",
                            f"--output={self.path}/%A-%a.log", CLUSTER / "sweep.sbatch",
                            self.path / "s.yaml", self.path / "shards").strip()
            merge = slurm.run("sbatch", "--parsable", f"--dependency=afterok:{job}",
                              f"--output={self.path}/merge.log", "--wrap",
                              f"{SLIPCHECK} merge {self.path}/out.db {self.path}/shards/*.db").strip()
            self.kill_shard(self.path / "shards" / "2.db")
            for k in range(1, SHARDS + 1):
                self.assertEqual(slurm.wait_for(f"{job}_{k}", {"COMPLETED"}), "COMPLETED")
            self.assertEqual(slurm.wait_for(merge, {"COMPLETED"}), "COMPLETED")
        self.same(self.path / "out.db")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Slurm:
    """A controller and a node of two cores on this machine, with keys and state of their own."""

    def __init__(self, folder):
        self.folder = folder / "slurm"
        self.folder.mkdir()
        self.processes = []
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"),
                                SLIPCHECK=SLIPCHECK,
                                PATH=os.environ["PATH"] + ":/usr/sbin:/usr/bin")

    def write_configuration(self):
        node = socket.gethostname().split(".")[0]
        user = "root" if os.getuid() == 0 else os.environ["USER"]
        (self.folder / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={node}(127.0.0.1)
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={self.folder}/munge.socket,cred_expire=5
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
MailProg=/bin/true
MpiDefault=none
ReturnToService=2
MinJobAge=3600
SchedulerParameters=sched_interval=2
NodeName={node} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes={node} Default=YES MaxTime=INFINITE State=UP
""")
        (self.folder / "cgroup.conf").write_text("CgroupAutomount=no\n")
        for name in ("state", "spool"):
            (self.folder / name).mkdir()

    def start(self, *command):
        with open(self.folder / f"{Path(command[0]).name}.out", "w") as log:
            self.processes.append(subprocess.Popen(
                list(map(str, command)), env=self.environment, stdout=log, stderr=log,
                start_new_session=True))

    def __enter__(self):
        self.write_configuration()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        self.folder.chmod(0o755)
        self.folder.parent.chmod(0o755)
        self.start("munged", "--foreground", "--force", f"--key-file={key}",
                   f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munge.pid",
                   f"--log-file={self.folder}/munge.log", f"--seed-file={self.folder}/munge.seed")
        try:
            self.until(lambda: (self.folder / "munge.socket").exists())
            self.start("slurmctld", "-D")
            self.start("slurmd", "-D", "-N", socket.gethostname().split(".")[0])
            self.until(lambda: "idle" in self.try_run("sinfo", "-h", "-o", "%T"))
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
        for process in reversed(self.processes):
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def logs(self):
        return "\n".join(f"{each}:\n{each.read_text(errors='replace')[-2000:]}"
                         for each in sorted(self.folder.glob("*.log")) +
                         sorted(self.folder.glob("*.out")))

    def until(self, holds, patience=60):
        end = time.monotonic() + patience
        while not holds():
            if time.monotonic() > end:
                raise AssertionError("Slurm does not come up\n" + self.logs())
            time.sleep(0.2)

    def try_run(self, *command):
        return subprocess.run(list(map(str, command)), env=self.environment, capture_output=True,
                              text=True).stdout

    def run(self, *command):
        done = subprocess.run(list(map(str, command)), env=self.environment, capture_output=True,
                              text=True)
        if done.returncode != 0:
            raise AssertionError(done.stderr + self.logs())
        return done.stdout

    def wait_for(self, job, states, patience=200):
        """The job's state, once it is one of these."""
        end = time.monotonic() + patience
        state = ""
        while time.monotonic() < end:
            words = self.try_run("scontrol", "show", "job", job).split()
            found = [word.split("=", 1)[1] for word in words if word.startswith("JobState=")]
            state = found[0] if found else ""
            if state in states:
                return state
            time.sleep(0.2)
        raise AssertionError(f"{job} is {state}\n" + self.logs())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
