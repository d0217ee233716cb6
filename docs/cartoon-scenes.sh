#!/bin/sh
# docs/cartoon-scenes.png: the seven scenes, one a row, in the five styles of the paper and in hatching.
# Usage, from the root of the sources: docs/cartoon-scenes.sh build/harness/raingauge
set -e
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
files=
for scene in car house1 house2 table park1 park2 ground; do
  for style in gooch gooch_outlines cartoon cartoon_outlines outlines hatching; do
    file=$folder/$scene-$style.png
    "$1" render cartoon --frame 0 --size 300x300 --set scene=$scene --set style=$style \
      --set outline_px=1.7 --set inner_px=1 -o "$file" > /dev/null
    files="$files $file"
  done
done
python3 "$(dirname "$0")/sheet.py" "$(dirname "$0")/cartoon-scenes.png" 6 $files
