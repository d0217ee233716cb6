#!/bin/sh
# unless_empty.sh COMMAND... -o OUTPUT INPUT: runs the command, or makes an empty output of an empty input.
for input; do output=$before; before=$input; done
if [ -s "$input" ]; then exec "$@"; fi
: > "$output"
