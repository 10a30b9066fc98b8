#!/usr/bin/env bash
# Makes the pictures of README.md and share/doc that show the demo, from what it wrote.
# usage: share/demo.sh && cmake --build build/release --target pcl_slam6d_render &&
#        share/doc/pictures/make.sh [DEMO_DIR]     (default: build/demo)
set -euo pipefail
pictures=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$pictures/../../.." && pwd)
map=$(realpath "${1:-$root/build/demo}")/map
render=$root/build/release/bin/pcl_slam6d_render

cp "$map/top_view.png" "$pictures/demo_top_view.png"
picture() { # view, size, title, file
  "$render" picture "$map" --view "$1" --size "$2" --title "$3" -o "$4"
}
picture before-after 1600x700 before "$pictures/demo_before_after.png"
picture perspective 1200x675 "corridor, 40 scans" "$pictures/corridor_perspective.png"

# The report in a browser. No window is as narrow as a phone, so a frame stands for it.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
screenshot() { # width, height, file
  printf '<body style="margin:0"><iframe src="file://%s" width="%s" height="%s" style="border:0">' \
    "$map/report.html" "$1" "$2" >"$work/frame.html"
  chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
    --user-data-dir="$work/profile" --hide-scrollbars --window-size="$1,$2" \
    --virtual-time-budget=10000 --screenshot="$3" "file://$work/frame.html" 2>/dev/null
}
screenshot 1280 1400 "$pictures/report_desktop.png"
screenshot 390 1600 "$pictures/report_phone.png"

if command -v pngquant >/dev/null; then # a third of the bytes
  pngquant --force --ext .png "$pictures"/{demo_*,corridor_*,report_*}.png
fi
