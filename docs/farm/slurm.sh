#!/bin/bash
# raingauge's plan on Slurm: shards as an array, then the merge. On a shared folder with plan.json:
#
#     raingauge plan --full --device cpu,vulkan --from results/tables --shards 8 -o plan.json
#     sbatch --array=1-8 slurm.sh
#     sbatch --array="$(raingauge plan --missing plan.json records)" slurm.sh    # what is left
#     sbatch --dependency=afterany:ARRAY --wrap 'raingauge merge plan.json records -o tables'
#
# Nodes are exclusive, for another job would slow what is measured. Name the GPU that the devices
# need with --gres. A job that Slurm requeues goes on with the groups that have no record yet.
# A shard that fails ends with another status than 0, so that the merge waits for afterany.
#SBATCH --job-name=raingauge --exclusive --requeue --open-mode=append
#SBATCH --output=raingauge-%a.log
#SBATCH --signal=B:TERM@60
exec raingauge table --plan plan.json --shard auto -o records
