#!/bin/bash
# raingauge's plan on Slurm: shards as an array, then the merge. On a shared folder with plan.json:
#
#     raingauge plan --full --device cpu,vulkan --from results/tables --shards 8 -o plan.json
#     DEVICES=cpu,vulkan sbatch --array=1-8 slurm.sh
#     sbatch --array="$(raingauge plan --missing plan.json records)" slurm.sh    # what is left
#     sbatch --dependency=afterany:ARRAY --wrap 'raingauge merge plan.json records -o tables'
#
# Nodes are exclusive, for another job would slow what is measured. Name the GPU that the devices
# need with --gres. A job that Slurm requeues goes on with the groups that have no record yet.
# A shard that fails ends with another status than 0, so that the merge waits for afterany.
# From a container image: RAINGAUGE='apptainer exec raingauge.sif raingauge', or as docs/farm.md says.
#SBATCH --job-name=raingauge --exclusive --requeue --open-mode=append
#SBATCH --output=raingauge-%a.log
#SBATCH --signal=B:TERM@60

RAINGAUGE=${RAINGAUGE:-raingauge} # words of a command, in which a star is none of file names
set -f

# A node that is busy, hot or broken takes no cells: Slurm tries the job again, two minutes later.
$RAINGAUGE doctor --prologue --device "${DEVICES:-cpu}"
status=$?
[ $status != 75 ] || scontrol requeue "$SLURM_JOB_ID"
[ $status = 0 ] || exit $status
exec $RAINGAUGE table --plan plan.json --shard auto -o records
