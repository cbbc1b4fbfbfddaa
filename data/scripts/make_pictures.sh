#!/usr/bin/env bash
# Makes the pictures of the README anew.
#
# Usage: make_pictures.sh [PROGRAMS [PICTURES]]
#   PROGRAMS  folder of transillum and transillum-view (default: build/release/bin)
#   PICTURES  folder to write into (default: data/pictures)
#
# Takes about a minute on two cores. Needs python3 and, without a display, xvfb-run (Debian: xvfb).
# The same programs make the same pictures every time; those of transillum-view, on the same OpenGL.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
programs=$(realpath "${1:-$root/build/release/bin}")
pictures=${2:-$root/data/pictures}
mkdir -p "$pictures"
pictures=$(realpath "$pictures")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

transillum() {
    "$programs/transillum" "$@" --quiet
}

# shoot SOLUTION CAMERA QUANTITY NAME: what transillum-view shows, by the number of its key. In a
# narrower window the legend does not fit.
shoot() {
    local window=()
    [[ -n ${DISPLAY:-} ]] || window=(xvfb-run --auto-servernum)
    "${window[@]}" "$programs/transillum-view" "$work/$1.vtm" --camera "$2" --quantity "$3" \
        --width 500 --height 340 --screenshot "$pictures/$4.png"
}

# look CAMERA NAME OPTION...: a picture of the Cornell box.
look() {
    transillum render "$work/box.vtm" --camera "$1" --size 256x256 "${@:3}" -o "$pictures/$2.png"
}

transillum bake "$root/data/scenes/cornell.gltf" -o "$work/box.vtm"
look front front
look corner corner
# Alike exposed, so that they add up to the whole.
for part in total emission direct finite-element; do
    chosen=(--components "$part")
    [[ $part == total ]] && chosen=()
    look front "$part" --no-auto-exposure --exposure 2 "${chosen[@]}"
done

transillum bake "$root/data/scenes/cornell.gltf" -o "$work/refined.vtm" --leaves 2000 --refine 4 --max-leaves 8500 \
    --monte-carlo subpatch
shoot refined front 5 direct-irradiance
shoot refined front 6 indirect-irradiance
shoot refined front 7 level
shoot refined front 8 standard-error
shoot refined front 9 spatial-error

# V_d is 0 on diffuse surfaces: here everything is glossy.
python3 "$root/data/scripts/cornell_chickens.py" --closed "$work" >/dev/null
transillum bake "$work/cornell_chickens_closed.obj" -o "$work/glossy.vtm" --leaves 9000 --monte-carlo subpatch
shoot glossy front 10 directional-error
