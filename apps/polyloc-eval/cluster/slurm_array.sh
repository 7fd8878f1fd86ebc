#!/usr/bin/env bash
# slurm_array.sh: one share of a list for each task of a Slurm array. Submit it so, and the merge
# after it:
#   job=$(sbatch --parsable --array=1-20 slurm_array.sh LIST.yaml OUT)
#   sbatch --dependency=afterok:$job --wrap="polyloc-eval merge OUT.shares/* -o OUT"
# A task that was killed or requeued goes on where it was: submit the same array again. OUT must be
# on a disk that all nodes see. POLYLOC_EVAL names the program where it is not on the path.
#SBATCH --job-name=polyloc-eval
#SBATCH --cpus-per-task=1
#SBATCH --requeue
set -euo pipefail
if [ $# -lt 2 ] || [ -z "${SLURM_ARRAY_TASK_ID-}" ]; then
  echo "usage: sbatch --array=1-N slurm_array.sh LIST.yaml OUT [OPTION of polyloc-eval...]" >&2
  exit 2
fi
list=$1 out=$2
shift 2
mkdir -p "$out.shares"
exec "${POLYLOC_EVAL:-polyloc-eval}" "$list" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX" \
  --resume -o "$out.shares/$SLURM_ARRAY_TASK_ID" "$@"
