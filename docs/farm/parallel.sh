#!/bin/bash
# raingauge's plan on machines that ssh reaches, by GNU parallel: one shard at a time on each of the
# machines in the file `machines`, one a line. They share this folder, with plan.json, and have the
# same build of raingauge in their PATH.
#
#     raingauge plan --device cpu --shards 8 -o plan.json
#     bash parallel.sh 8 machines
#
# A shard that fails is tried on another machine, twice. Nothing keeps others off a machine meanwhile.
DEVICES=${DEVICES:-cpu}
parallel --jobs 1 --sshloginfile "$2" --workdir "$PWD" --retries 3 --joblog jobs.log \
  "raingauge doctor --prologue --device $DEVICES && raingauge table --plan plan.json --shard {}/$1 -o records" ::: $(seq "$1")
raingauge merge plan.json records -o tables
