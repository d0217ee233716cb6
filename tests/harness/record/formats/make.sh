#!/bin/sh
# make.sh RAINGAUGE FOLDER: writes a file of each format that outlives its program.
# tests/harness/record/formats/1.0 is of version 1.0 of the formats.
# All cells are small, and on the CPU alone.
set -e
program=$(realpath "$1")
mkdir -p "$2"
cd "$2"
export OMP_NUM_THREADS=1 RG_FEW_SAMPLES=1

# --- what users write ---
cat >cells.txt <<'END'
# One cell a line: name, technique, size, frames, settings.
raster/torus raster 64x48 2 scene=mesh model=torus faces=300
flow/pane flow 64x48 2 view=pane resolution_px=64 environment=sky environment_px=16
END
cat >expectations.txt <<'END'
fail flow/p?ne
  device     cpu
  driver     *
  outcome    fail
  pixels     10..40
  difference 0.002..5
  reason     an example
  link       https://example.org/issues/1
  since      2026-11-01
  until      2027-01-30
END
cat >panes.table <<'END'
table     panes flow 64x64
about     frame rate by the texels of a pane
set       panes=mirror environment=sky environment_px=16 model=none
row       resolution_px=16 | fps=800
row       resolution_px=64 | fps=140
variant   paper move=paper
hardware  GeForce 8800 GTS
claim     falls | gets slower with more texels
claim     ratio rows=1-2 least=4 section=5 | "a fourth at 64"
END
cat >lights.json <<'END'
{"lights": [
  {"type": "sun", "direction": [-0.5, -0.7, -0.4], "colour": [0.9, 0.8, 0.7]},
  {"type": "spot", "position_m": [12, 8, -3], "direction": [0, -1, 0], "colour": [1, 0.7, 0.3], "intensity": 40,
   "inner_deg": 35, "outer_deg": 60, "near_m": 0.5},
  {"type": "point", "position_m": [0, 3, 5], "colour": [0.2, 0.4, 1], "intensity": 10, "shadows": false}],
 "sky": {"colour": [0.3, 0.34, 0.4]}}
END
printf '0 0 0\n1 30 3\n2 300 8\n' >wind.txt

# --- what raingauge writes and reads ---
cat >case.txt <<'END'
# A difference between two devices: raingauge render --case FILE --device D
technique raster
size 64x48
frames 1
set scene=mesh
set model=torus
set faces=300
behind 1
stage raster_mesh
asset target
class values
expected e3d83198b4a9c8f9
found fedcba9876543210
truth cpu:reference
device vulkan
END
mkdir run
"$program" table ./panes.table --quick --device cpu --fresh -o run
mv run/panes.json table.json
"$program" claims ./panes.table --quick --device cpu --fresh --budget 3s -o run
mv run/*.journal launches.journal
"$program" baseline --cells cells.txt --pictures --device cpu -o baseline.json
rm -r run

# --- what raingauge prints ---
for what in techniques tables figures devices; do
    "$program" list $what --json >list-$what.json
done
"$program" list params raster --json >list-params.json
"$program" diff raster --device cpu,cpu:reference --size 64x48 --frame 1 --json >diff.json
"$program" render raster --device cpu --size 64x48 --frame 1 -o picture.png --json >render.json
rm picture.png
"$program" verify raster --device cpu,cpu:reference --quick --json >verify.json
"$program" gate cpu cpu --cells cells.txt --expectations expectations.txt --pictures --json >gate.json || test $? = 1
"$program" claims ./panes.table --from launches.journal --json >claims.json
"$program" bisect --good 1 --bad 4 --run 'test "$RG_CANDIDATE" -lt 3' 2 3 --json >bisect.json
"$program" doctor --device cpu --json >doctor.json
