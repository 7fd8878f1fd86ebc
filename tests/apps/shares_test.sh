#!/usr/bin/env bash
# shares_test.sh parallel|slurm PROGRAMS CLUSTER: runs a list in three shares, put together, and
# compares with the list in one go. Exits 77 (skipped) where GNU parallel, or a Slurm that may be
# started here (root, slurmctld, slurmd, munged), is missing.
set -euo pipefail
way=$1 programs=$2 cluster=$3
work=$(mktemp -d)
daemons=()
cleanup() {
  for pid in "${daemons[@]}"; do kill "$pid" 2> /dev/null || true; done
  for pid in "${daemons[@]}"; do # they write their state as they end, and leave no folder alone
    timeout 20 tail --pid="$pid" -f /dev/null || kill -9 "$pid" 2> /dev/null || true
  done
  wait || true
  rm -rf "$work"
}
trap cleanup EXIT
cd "$work"
export POLYLOC_EVAL=$programs/polyloc-eval
cat > room.wkt <<'WKT'
POLYGON ((0 0, 8 0, 8 3, 6 3, 6 5, 2.5 5, 2.5 6.2, 1 6.2, 1 5, 0 5, 0 0), (4 1, 4 2.2, 5.5 1.6, 4 1))
WKT
cat > list.yaml <<'YAML'
datasets:
  - {name: a, map: room.wkt, simulate: {n: 130, seed: 1, short: 0.3}}
  - {name: b, map: room.wkt, simulate: {n: 9, seed: 2, fov: 180}}
methods: [certified, {name: few, method: certified, max_hypotheses: 2}]
YAML

# All of a summary that does not hang on clocks.
figures() {
  grep -v -E '"(ms_|index_build_s|cold_start_s|date|command|threads)' "$1/summary.json"
}

start_slurm() {
  local node
  node=$(hostname -s)
  mkdir -p run spool state munge
  dd if=/dev/urandom of=munge/key bs=64 count=1 2> /dev/null
  chown -R munge: munge && chmod 700 munge && chmod 400 munge/key
  chmod 755 "$work" # munged wants to see its socket's folders
  mkdir -p socket && chown munge: socket && chmod 755 socket
  runuser -u munge -- munged --foreground --key-file="$work/munge/key" \
    --socket="$work/socket/munge" --pid-file="$work/socket/pid" --log-file="$work/munge/log" \
    --seed-file="$work/munge/seed" > munged.out 2>&1 &
  daemons+=($!)
  cat > slurm.conf <<CONF
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/socket/munge
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/run/slurmctld.pid
SlurmdPidFile=$work/run/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
MpiDefault=none
ReturnToService=2
MailProg=/bin/true
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES State=UP
CONF
  export SLURM_CONF=$work/slurm.conf
  slurmctld -D > ctld.out 2>&1 &
  daemons+=($!)
  slurmd -D > slurmd.out 2>&1 &
  daemons+=($!)
  for _ in $(seq 60); do
    [ "$(sinfo -h -o %t 2> /dev/null || true)" = idle ] && return
    sleep 1
  done
  echo "a Slurm of one node does not start here:" >&2
  tail -n 3 munged.out ctld.out slurmd.out >&2
  exit 77
}

case $way in
  parallel)
    command -v parallel > /dev/null || { echo "GNU parallel is not here"; exit 77; }
    "$cluster/run_shares.sh" list.yaml 3 merged
    ;;
  slurm)
    for program in munged slurmctld slurmd sbatch; do
      command -v $program > /dev/null || { echo "$program is not here"; exit 77; }
    done
    [ "$(id -u)" -eq 0 ] || { echo "only root may start a Slurm"; exit 77; }
    start_slurm
    sbatch --wait --array=1-3 --output=task-%a.out "$cluster/slurm_array.sh" list.yaml merged ||
      { cat task-*.out; exit 1; }
    "$POLYLOC_EVAL" merge merged.shares/* -o merged
    ;;
esac
"$POLYLOC_EVAL" list.yaml -o whole > /dev/null
diff <(figures whole) <(figures merged)
diff -r whole/estimates merged/estimates
[ "$(grep -c . merged/scans.csv)" -eq 279 ]
echo "three shares by $way are the whole"
