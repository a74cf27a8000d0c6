#!/usr/bin/env bash
# The workflow on a real Slurm of one node, started here and stopped again: a few quick cases, one job killed on the
# way and retried, and the same report as without Slurm, machine block apart.
#
# Needs root (munge and slurmd), Debian's slurm-wlm and munge, and Snakemake:
#   apt-get install slurm-wlm munge && python3 -m venv VENV && VENV/bin/pip install -r workflow/requirements.txt
#   tests/slurm.sh target/release/seam VENV/bin/snakemake
set -euo pipefail
seam=$(realpath "${1:?the seam program}")
snakemake=$(realpath "${2:?the snakemake program}")
workflow=$(realpath "$(dirname "$0")/../workflow/Snakefile")
home=$(mktemp -d)
chmod 755 "$home"
cd "$home"

stop() {
    # Pids are in the files of this script's own daemons; nothing else is ended.
    for daemon in slurmctld slurmd munged; do
        pid=$(cat "$home/$daemon.pid" 2> /dev/null) || continue
        kill "$pid" 2> /dev/null || true
        for _ in $(seq 50); do kill -0 "$pid" 2> /dev/null || break; sleep 0.1; done
    done
    rm -rf "$home"
}
trap stop EXIT

node=$(hostname -s)
mkdir munge state spool
chmod 755 munge
dd if=/dev/urandom of=munge/key bs=1024 count=1 status=none
chmod 400 munge/key
munged --force --key-file="$home/munge/key" --socket="$home/munge/munge.sock" --pid-file="$home/munged.pid" \
    --log-file="$home/munge/log" --seed-file="$home/munge/seed"
cat > slurm.conf <<EOF
ClusterName=seam
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=26817
SlurmdPort=26818
AuthType=auth/munge
AuthInfo=socket=$home/munge/munge.sock,cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MpiDefault=none
ReturnToService=2
MinJobAge=300
SlurmdParameters=config_overrides
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$home/state
SlurmdSpoolDir=$home/spool
SlurmctldPidFile=$home/slurmctld.pid
SlurmdPidFile=$home/slurmd.pid
SlurmctldLogFile=$home/slurmctld.log
SlurmdLogFile=$home/slurmd.log
NodeName=$node NodeAddr=127.0.0.1 NodeHostname=$node CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
EOF
export SLURM_CONF=$home/slurm.conf
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
for _ in $(seq 30); do
    if sinfo --noheader --format=%T | grep -q idle; then break; fi
    sleep 1
done
sinfo --noheader --format=%T | grep -q idle || { cat slurmctld.log slurmd.log; exit 1; }

cases=bond-matrix,patch-fe,patch-coupled,cook-membrane,long-run
run() { "$snakemake" -s "$workflow" --config seam="$seam" out="$1" cases="$cases" --cores 2 "${@:2}" > log 2>&1; }

# Each in a folder of its own, so that both say `seam report --from out`.
mkdir local cluster
(cd local && run out || { cat log; exit 1; })

cd cluster
run out --executor slurm --jobs 4 --retries 2 --slurm-status-command squeue \
    --slurm-init-seconds-before-status-checks 2 &
workflow_pid=$!
# The first job of ours that runs is ended by force: the workflow has to notice, and to run it again.
killed=
while [ -z "$killed" ] && kill -0 "$workflow_pid" 2> /dev/null; do
    killed=$(squeue --noheader --states=RUNNING --format=%i | head -n 1)
    if [ -n "$killed" ]; then scancel "$killed"; fi
    sleep 0.2
done
wait "$workflow_pid" || { cat log .snakemake/slurm_logs/*/*/*.log; exit 1; }
[ -n "$killed" ] || { echo "no job ever ran"; exit 1; }
cd ..

jobs=$(scontrol show job --oneliner | grep -c JobId=)
wanted=$(tr ',' '\n' <<< "$cases" | wc -l)
echo "$jobs jobs for $wanted cases; job $killed was killed"
[ "$jobs" -gt "$wanted" ] || { echo "the killed job was not run again"; exit 1; }
page() { sed '/<!-- machine: begin -->/,/<!-- machine: end -->/d' "$1/out/report.html"; }
cmp <(page local) <(page cluster)
"$seam" check --from cluster/out > /dev/null
echo "the report of the cluster is that of this machine, machine block apart"
