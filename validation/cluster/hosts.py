#!/usr/bin/env python3
"""Runs `steady --flow openfoam --ranks 2 --hostfile` on two hosts and compares it with both ranks on this machine. The hosts are network
namespaces with an address each. Open MPI starts its daemon on the second one by a script instead of ssh. Needs root."""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "reliability")]
import trial  # noqa: E402

ADDRESSES = ["10.97.31.1", "10.97.31.2"]
OPENFOAM = [*trial.COMMANDS["openfoam"].split(), "--ranks", "2"]


def ip(*words):
    done = subprocess.run(["ip", *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"this machine lets nobody make network namespaces: ip {' '.join(words)}: {done.stderr.strip()}")


class TwoHosts:
    """Namespaces rip-PID-1 and -2, joined by one cable."""

    def __enter__(self):
        self.names = [f"rip-{os.getpid()}-{i}" for i in (1, 2)]
        self.made = []
        try:
            for name in self.names:
                ip("netns", "add", name)
                self.made.append(name)
            ends = [f"rip{os.getpid() % 100000}{i}" for i in "ab"]
            ip("link", "add", ends[0], "netns", self.names[0], "type", "veth", "peer", "name", ends[1], "netns", self.names[1])
            for name, end, address in zip(self.names, ends, ADDRESSES):
                ip("-n", name, "address", "add", f"{address}/24", "dev", end)
                ip("-n", name, "link", "set", end, "up")
                ip("-n", name, "link", "set", "lo", "up")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for name in self.made:
            subprocess.run(["ip", "netns", "delete", name], check=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ripstop", type=pathlib.Path, required=True)
    program = parser.parse_args().ripstop.resolve()
    work = pathlib.Path(tempfile.mkdtemp(prefix="ripstop-hosts-"))
    case = work / "case.toml"
    case.write_text(trial.CASE)
    words = [str(program), *[str(case) if word == "{case}" else word for word in OPENFOAM]]
    subprocess.run([*words, "--out", str(work / "here/run")], check=True, capture_output=True)
    with TwoHosts() as hosts:
        agent = work / "enter"  # called like ssh: host and shell command
        agent.write_text(f"""#!/bin/sh
case "$1" in
{ADDRESSES[0]}) host={hosts.names[0]} ;;
{ADDRESSES[1]}) host={hosts.names[1]} ;;
*) echo "no host $1" >&2; exit 1 ;;
esac
echo "$1" >> '{work}/entered'
shift
exec ip netns exec "$host" sh -c "$*"
""")
        agent.chmod(0o755)
        hostfile = work / "hosts"
        hostfile.write_text("".join(f"{address} slots=1\n" for address in ADDRESSES))
        # TCP between the hosts: other networks of this machine are not in the namespaces.
        environment = {**os.environ, "OMPI_MCA_plm": "rsh", "OMPI_MCA_plm_rsh_agent": str(agent), "OMPI_MCA_btl": "tcp,self",
                       "OMPI_MCA_pml": "ob1"}
        done = subprocess.run(["ip", "netns", "exec", hosts.names[0], *words, "--hostfile", str(hostfile), "--out", str(work / "two/run")],
                              capture_output=True, text=True, env=environment)
        entered = (work / "entered").read_text().split() if (work / "entered").exists() else []
        links = json.loads(subprocess.run(["ip", "-j", "-s", "-n", hosts.names[0], "link"], capture_output=True, text=True, check=True).stdout)
        sent = sum(link["stats64"]["tx"]["bytes"] for link in links if link["ifname"].startswith("rip"))
    if done.returncode != 0 or not entered:
        print(f"FAILED: exit code {done.returncode}, entered {entered}: {done.stderr[-800:]}; see {work}")
        return 1
    unlike = trial.differences(work / "two/run", work / "here/run")
    print(f"{'ok' if not unlike else 'FAILED'}: 2 ranks on {len(ADDRESSES)} hosts, {set(entered)} entered {len(entered)} times, {1e-6 * sent:.1f} MB over the "
          f"cable, files {'the same as on one' if not unlike else 'that differ: ' + ' '.join(unlike[:8])}")
    shutil.rmtree(work)
    return 1 if unlike else 0


if __name__ == "__main__":
    sys.exit(main())
