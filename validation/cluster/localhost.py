"""Runs a Slurm of two nodes on this machine: munged, slurmctld and two slurmd on separate ports, with all files in one folder."""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "sinfo"]


def free_ports(count):
    held = [socket.socket() for _ in range(count)]
    for one in held:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in held]
    for one in held:
        one.close()
    return ports


def program(name):
    found = shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")
    if not found:
        raise SystemExit(f"{name} is not installed: make test-slurm installs it")
    return found


class Slurm:
    """with Slurm(folder) as slurm: slurm.call("squeue")"""

    def __init__(self, folder, cpus=2, memory_mb=4000):
        self.folder = pathlib.Path(folder).resolve()
        self.cpus, self.memory_mb = cpus, memory_mb
        self.children = []

    def __enter__(self):
        for name in PROGRAMS:
            program(name)
        for name in ["state", "spool1", "spool2"]:
            (self.folder / name).mkdir(parents=True)
        self.folder.chmod(0o755)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        controller, first, second = free_ports(3)
        host = socket.gethostname().split(".")[0]
        user = subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()
        nodes = "\n".join(f"NodeName=node{i} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={self.cpus} RealMemory={self.memory_mb}"
                          for i, port in [(1, first), (2, second)])
        self.config = self.folder / "slurm.conf"
        self.config.write_text(f"""ClusterName=trial
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={self.folder}/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool-%n
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd-%n.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobRequeue=1
KillWait=5
MinJobAge=3600
OverTimeLimit=0
ReturnToService=2
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = {**os.environ, "SLURM_CONF": str(self.config)}
        try:
            self.start([program("munged"), "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                        f"--pid-file={self.folder}/munged.pid", f"--seed-file={self.folder}/munged.seed",
                        f"--log-file={self.folder}/munged.log"], "munged")
            self.wait(lambda: (self.folder / "munge.socket").exists(), 20, "munged")
            self.start([program("slurmctld"), "-D", "-i", "-f", str(self.config)], "slurmctld")
            for node in ["node1", "node2"]:
                self.start([program("slurmd"), "-D", "-N", node, "-f", str(self.config)], node)
            self.wait(lambda: self.call("sinfo", "-h", "-N", "-o", "%T").split() == ["idle", "idle"], 60, "Slurm's nodes")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for child in reversed(self.children):
            if child.poll() is None:
                child.send_signal(signal.SIGTERM)
                try:
                    child.wait(20)
                except subprocess.TimeoutExpired:
                    child.kill()
                    child.wait()

    def start(self, command, name):
        with open(self.folder / f"{name}.out", "w") as out:
            self.children.append(subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, env=self.environment,
                                                  cwd=self.folder, start_new_session=True))

    def wait(self, ready, seconds, what):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for child in self.children:
                if child.poll() is not None:
                    raise RuntimeError(f"{child.args[0]} ended with {child.returncode}; see {self.folder}")
            if ready():
                return
            time.sleep(0.2)
        raise RuntimeError(f"{what}: not there after {seconds} s; see {self.folder}")

    def call(self, *command, check=False, **more):
        run = subprocess.run([program(command[0]), *command[1:]], capture_output=True, text=True, env=self.environment, **more)
        if check and run.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command))}: {run.returncode}: {run.stderr}")
        return run.stdout

    def jobs(self):
        """State by job: {"3": "COMPLETED", "4_1": "RUNNING"}."""
        lines = self.call("squeue", "-h", "-r", "-t", "all", "-o", "%i %T").splitlines()
        return dict(line.split() for line in lines)

    def wait_for_all(self, seconds):
        """Waits until no job runs or waits."""
        over = {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL", "OUT_OF_MEMORY"}
        self.wait(lambda: self.jobs() and all(state in over for state in self.jobs().values()), seconds, "the end of all jobs")
        return self.jobs()
