#!/bin/sh
# docs/knee.png: rain within culling radii of 10, 20 and 40 m, one a row, and beside it where that differs from rain without
# limits: FLIP's error, the brighter the larger.
# Usage, from the root of the sources: docs/knee.sh build/harness/raingauge
set -e
program=$1
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

# A picture as creus-5.4 has it in quick mode: FILE SETTING...
draw() {
  file=$folder/$1.png
  shift
  sets=
  for set in spectrum=off swings=database thin_streaks=points splash_materials=off splash_up=vertical splash_s=0.15 \
    splash_width_mm=40 splash_gain=0.35 splash_opacity=0.35 splash_light=matt splash_fade=0 far_layers=0 atlas=small city=small depth_map_px=2048 \
    cull=exact "$@"; do
    sets="$sets --set $set"
  done
  "$program" render streaks $sets --frame 2 --size 1280x720 -o "$file" > /dev/null
}

draw truth limits=off
files=
for radius in 10 20 40; do
  draw "$radius" culling_radius_m=$radius
  "$program" diff "$folder/truth.png" "$folder/$radius.png" -o "$folder/$radius" > /dev/null || true
  files="$files $folder/$radius.png $folder/$radius-flip.png"
done
python3 "$(dirname "$0")/sheet.py" "$(dirname "$0")/knee.png" 2 $files
