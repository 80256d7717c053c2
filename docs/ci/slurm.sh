#!/bin/bash
# Pictures on a Slurm cluster, in eight parts at once, then one report. Start it with: bash slurm.sh [dejag.toml]
#SBATCH --array=1-8
#SBATCH --cpus-per-task=2
#SBATCH --time=01:00:00
#SBATCH --requeue
set -euo pipefail

manifest=${MANIFEST:-${1:-dejag.toml}}
export MANIFEST=$manifest

# On the login node: the parts, and a job that waits for all of them, whether they pass or not.
if [ -z "${SLURM_JOB_ID:-}" ]; then
  # A part that does not get to its end must not be merged as it was another day.
  rm -f shard-*/check.json
  parts=$(sbatch --parsable --export=ALL "$0")
  sbatch --array=1-1 --dependency="afterany:${parts%%;*}" --export=ALL,MERGE=1 "$0"
  exit
fi

if [ -n "${MERGE:-}" ]; then
  exec dejag merge shard-*/check.json --manifest "$manifest" --json check.json --junit junit.xml --report report
fi

# Threads as many as this job has cores, not as the machine has.
export RAYON_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} LP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} NODEVICE_SELECT=1
# A job that was stopped goes on where it was: what is drawn is not drawn again.
exec dejag check --manifest "$manifest" --output "shard-$SLURM_ARRAY_TASK_ID" --resume \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
