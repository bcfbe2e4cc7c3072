#!/usr/bin/env bash
# Builds Vitrine, installing what is missing, and shows the samples: in a window where there is a display,
# otherwise as a gallery on disk. --gallery asks for the gallery anyway; other arguments go to `vitrine browse`.
set -u
# shellcheck source=samples/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

show=window
case "${1:-}" in
  -h | --help) sed -n "2,3s/^# //p" "${BASH_SOURCE[0]}"; exit 0 ;;
  --gallery) show=gallery; shift ;;
esac
[ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || show=gallery

needPackages "${build_packages[@]}" -- "${build_packages_optional[@]}"
options=(-DVITRINE_VIEWER=ON)
[ -f "$project_root/build/release/CMakeCache.txt" ] || options+=(-DVITRINE_TESTS=OFF)
buildPreset release vitrine "${options[@]}"
vitrine=$project_root/build/release/bin/vitrine

if [ "$show" = window ]; then
  say "opening the browser"
  "$vitrine" browse "$@"
  status=$?
  # A display that cannot be opened (exit 2) is as good as none, unless the scene was the reason.
  { [ $status -eq 2 ] && [ $# -eq 0 ]; } || exit $status
fi

gallery=$project_root/build/gallery
if [ "$gallery/index.html" -nt "$vitrine" ]; then
  say "the gallery is up to date"
else
  say "rendering the samples into build/gallery"
  rm -rf "$gallery"
  python3 -B "$project_root/samples/gallery.py" page "$vitrine" "$gallery" || fail "rendering the gallery failed"
fi
say "gallery: $gallery/index.html"
