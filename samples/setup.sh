# What the project needs from the system and how it is built: sourced by samples/run.sh and tests/run.sh.
# The package lists stand here and nowhere else.

project_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=${VITRINE_JOBS:-$(nproc 2>/dev/null || echo 2)}

# To build and run the program.
build_packages=(
  g++ cmake ninja-build pkg-config python3
  libeigen3-dev libglfw3-dev libgl-dev libegl-dev libimgui-dev libstb-dev python3-glad
  libcli11-dev nlohmann-json3-dev libpugixml-dev libxxhash-dev libpng-dev
  libegl1 libgl1-mesa-dri
)
# Used where the distribution has them: newer ones ship no OSMesa, and EGL does its work there.
build_packages_optional=(libosmesa6 libosmesa6-dev liburdfdom-dev)

# To run every test as well. The optional ones: a browser that reads the golden report, and engines to compare with.
test_packages=(libgtest-dev libbenchmark-dev xvfb xauth xdotool imagemagick)
test_packages_optional=(chromium libbullet-dev libode-dev valgrind doxygen)

say() { printf '\033[1m== %s\033[0m\n' "$*"; }
fail() { printf '%s\n' "$1" >&2; exit "${2:-1}"; }

# Prints those of its arguments that dpkg does not know as installed.
missingPackages() {
  local installed
  [ $# -gt 0 ] || return 0
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null | awk '$2 == "installed" { print $1 }')
  printf '%s\n' "$@" | grep -vxF "${installed:-none}"
}

# Prints those of its arguments that apt could install.
availablePackages() {
  [ $# -gt 0 ] || return 0
  LC_ALL=C apt-cache policy "$@" 2>/dev/null |
    awk '/^[^ ]/ { name = substr($1, 1, length($1) - 1) } /Candidate:/ && $2 != "(none)" { print name }'
}

# needPackages REQUIRED... -- OPTIONAL...: installs what is missing. Touches no network when nothing is.
needPackages() {
  local required=() optional=() sudo=()
  while [ "$1" != "--" ]; do required+=("$1"); shift; done
  shift

  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "not a Debian or Ubuntu system: building with what is here; needed are the likes of ${required[*]}"
    return
  fi
  mapfile -t required < <(missingPackages "${required[@]}")
  mapfile -t optional < <(missingPackages "$@")
  if [ ${#required[@]} -eq 0 ]; then
    mapfile -t optional < <(availablePackages "${optional[@]}")
    [ ${#optional[@]} -eq 0 ] && return
  fi

  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
      sudo=(sudo -n)
    elif [ ${#required[@]} -eq 0 ]; then
      return
    else
      fail "These packages are missing; install them and run this again:
  sudo apt-get install ${required[*]}" 2
    fi
  fi
  if [ ${#required[@]} -gt 0 ]; then
    say "looking up packages"
    "${sudo[@]}" apt-get -qq update || fail "apt-get update failed; missing packages: ${required[*]}" 2
    mapfile -t optional < <(availablePackages "${optional[@]}")
  fi
  say "installing ${required[*]} ${optional[*]}"
  mkdir -p "$project_root/build"
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y --no-install-recommends install \
    "${required[@]}" "${optional[@]}" >"$project_root/build/packages.log" 2>&1 || {
    tail -20 "$project_root/build/packages.log" >&2
    fail "apt-get could not install: ${required[*]} ${optional[*]}" 2
  }
}

# buildPreset PRESET "TARGET..." [CMAKE_OPTION...]: configures and builds into build/PRESET.
buildPreset() {
  local preset=$1 targets=$2 cache=$project_root/build/$1/CMakeCache.txt fresh=() log=$project_root/build/$1/configure.log
  shift 2
  # A tree that was configured in another place cannot be used in this one.
  if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$project_root" "$cache"; then fresh=(--fresh); fi
  say "$preset: configuring and building (build/$preset)"
  mkdir -p "${log%/*}"
  (cd "$project_root" && cmake --preset "$preset" "${fresh[@]}" "$@") >"$log" 2>&1 || { cat "$log" >&2; fail "configuring $preset failed"; }
  # shellcheck disable=SC2086
  cmake --build "$project_root/build/$preset" -j "$jobs" --target $targets || fail "building $preset failed"
}
