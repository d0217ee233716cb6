#!/bin/sh
# Makes docs/page.png, the first screen of the page of results/tables, from the folder of a built tree: docs/page.sh
set -e
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
build/harness/raingauge report results/tables docs/pictures.md -o "$folder/page.html"
chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars --window-size=1280,1000 --user-data-dir="$folder/user" \
  --screenshot="$PWD/docs/page.png" "file://$folder/page.html" 2>/dev/null
