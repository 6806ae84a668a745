#!/usr/bin/env python3
"""usage: tests/datasets/slurm_test.py FATHOM
scripts/slurm/shards.sbatch on a cluster of one node: munged, slurmctld and slurmd on this machine, in a folder of their
own. Four tasks make a data set, one of them is killed on the way; the set has the same bytes as that of one process. Then
four tasks search it with the detector; their report card has the same bytes as that of one process, too.
Skipped (exit code 77) where Debian's packages munge, slurmctld, slurmd and slurm-client are not installed."""
import os
import pwd
import re
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NEEDED = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"]
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"
FRAMES = 320  # in four folders


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """One node, whose daemons end with this object."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        folder.chmod(0o755)
        control, node = free_ports(2)
        user = pwd.getpwuid(os.getuid()).pw_name
        for name in ["munge", "state", "spool"]:
            (folder / name).mkdir(mode=0o755)
        key = folder / "munge/key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o400)
        host = socket.gethostname().split(".")[0]
        (folder / "slurm.conf").write_text(f"""ClusterName=fathom
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control}
SlurmdPort={node}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=bf_interval=2,sched_interval=2
ReturnToService=2
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
""")
        (folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(folder / "slurm.conf")}
        self.start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={folder}/munge/socket",
                   f"--pid-file={folder}/munge/pid", f"--log-file={folder}/munge/log", f"--seed-file={folder}/munge/seed")
        self.wait(lambda: (folder / "munge/socket").exists(), "munged")
        self.start("slurmctld", "-D", "-c")
        self.start("slurmd", "-D", "-N", host)
        self.wait(lambda: "idle" in self.run("sinfo", "-h", "-o", "%T"), "slurmd")

    def start(self, *command):
        log = open(self.folder / f"{command[0]}.out", "wb")
        self.daemons.append(subprocess.Popen([shutil.which(command[0], path=PATH), *command[1:]], env=self.environment, stdout=log,
                                             stderr=log, cwd=self.folder))

    def run(self, *command):
        return subprocess.run([shutil.which(command[0], path=PATH), *command[1:]], env=self.environment, capture_output=True, text=True,
                              cwd=self.folder).stdout

    def wait(self, is_done, what, seconds=60):
        end = time.monotonic() + seconds
        while not is_done():
            if time.monotonic() > end:
                logs = "".join(f"--- {log.name}\n{log.read_text()[-2000:]}" for log in self.folder.glob("*.log"))
                sys.exit(f"{what} takes longer than {seconds} s\n{logs}")
            time.sleep(0.1)

    def close(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def bytes_below(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name != ".fathom.lock"}


def processes_of(folder):
    """The data set's writers, by what they were called with."""
    return [int(pid) for pid in os.listdir("/proc") if pid.isdigit() and b"generate" in command_line(pid) and os.fsencode(folder) in command_line(pid)
            and b"sbatch" not in command_line(pid) and b"slurm_script" not in command_line(pid)]


def command_line(pid):
    try:
        return Path("/proc", pid, "cmdline").read_bytes()
    except OSError:
        return b""


def run_array(cluster, name, command, meanwhile=None):
    """Four tasks of one processor each, to their ends; what they said."""
    submitted = cluster.run("sbatch", "--array=0-3", "--cpus-per-task=1", "--mem=0", f"--output={cluster.folder}/{name}_%a.txt",
                            str(ROOT / "scripts/slurm/shards.sbatch"), *map(str, command))
    job = re.search(r"job (\d+)", submitted)
    if not job:
        sys.exit(f"sbatch says: {submitted}")
    if meanwhile:
        meanwhile()
    cluster.wait(lambda: not cluster.run("squeue", "-h", "-j", job[1]).strip(), f"the job array {name}", 400)
    return "".join(task.read_text() for task in sorted(cluster.folder.glob(f"{name}_*.txt")))


def finished(command, found):
    """What a command says when nothing is left to do."""
    said = subprocess.run([*map(str, command), "--quiet"], check=True, capture_output=True, text=True).stdout
    if not re.search(found, said, re.M):
        sys.exit(f"the array left something out:\n{said}")


def compare(what, array, alone):
    array, alone = bytes_below(array), bytes_below(alone)
    if array != alone:
        sys.exit(f"the array's {what} differ from one process's: " + ", ".join(sorted(
            name for name in array.keys() | alone.keys() if array.get(name) != alone.get(name))[:5]))
    print(f"four tasks made the {len(alone)} files of one process's {what}")


def main(program):
    program, folder = Path(program).resolve(), Path(tempfile.mkdtemp(prefix="fathom_slurm_"))
    cluster = Cluster(folder)
    try:
        spec = folder / "spec.json"
        spec.write_text('{"cups": {"number": [1, 1], "kinds": [{"shape": "mug"}]}, "objects": {"number": [0, 1], "kinds": [{"solid": "can"}]}}')

        def generate(name):
            return [program, "generate", spec, "--frames", FRAMES, "--threads", 1, "-o", folder / name]

        def evaluate(name):
            return [program, "evaluate", folder / "array", "--threads", 1, "-o", folder / name]

        def kill_one():
            cluster.wait(lambda: len(list((folder / "array").glob("train/*/labels/*.json"))) > 5, "the first frames", 120)
            os.kill(processes_of(folder / "array")[0], signal.SIGKILL)

        said = run_array(cluster, "frames", generate("array"), kill_one)
        if "queued again" not in said:
            sys.exit(f"no task was queued again:\n{said}")
        finished(generate("array"), r"frames_made_now +0$")
        finished(generate("alone"), rf"frames_made_now +{FRAMES}$")
        compare("frames", folder / "array", folder / "alone")
        run_array(cluster, "card", evaluate("card"))
        finished(evaluate("card"), r"recognised ")
        finished(evaluate("card_alone"), r"recognised ")
        compare("answers", folder / "card", folder / "card_alone")
    finally:
        cluster.close()
    shutil.rmtree(folder)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if missing := [name for name in NEEDED if not shutil.which(name, path=PATH)]:
        print(f"... skipped 'no {', '.join(missing)}: install munge, slurmctld, slurmd and slurm-client'")
        sys.exit(77)
    main(sys.argv[1])
