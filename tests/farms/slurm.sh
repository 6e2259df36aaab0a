#!/usr/bin/env bash
# A Slurm with one node, in the root folder of the whole Blender: submits arrays, a line of standard
# input each, waits until all have ended, and prints how each task did. What it starts ends with the
# run of whole_blender.sh; nobody else can reach it, as that has a network of its own.
set -euo pipefail

ip link set lo up
ip address add 127.0.0.2 dev lo # with 127.0.0.1 alone, glibc looks up no IPv4 address
work=$(mktemp --directory)
cat >"$work/slurm.conf" <<END
ClusterName=farm
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
StateSaveLocation=$work
SlurmdSpoolDir=$work
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
NodeName=node NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=ALL Default=YES
END
echo CgroupPlugin=disabled >"$work/cgroup.conf" # a container may have none
printf '#!/bin/sh\nPYTHONPATH=/project exec python3 -m addon.cli "$@"\n' >"$work/reftrace"
chmod +x "$work/reftrace"
export SLURM_CONF="$work/slurm.conf" PATH="$work:$PATH"
export BLENDER_USER_RESOURCES=/project/out/farms/user

slurmctld -D -c &
slurmd -D -N node &
until [ "$(sinfo --noheader --format %T 2>/dev/null)" = idle ]; do sleep 0.2; done
cd /project/docs/farms
while read -r array; do
    # shellcheck disable=SC2086  # words
    sbatch --output="$work/%A-%a.log" $array
done
while [ -n "$(squeue --noheader)" ]; do sleep 0.2; done
head --lines=-0 "$work"/*-*.log
scontrol --oneliner show job
