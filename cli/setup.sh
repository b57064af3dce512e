# Functions that install packages and build.

build_packages=(g++ cmake ninja-build pkg-config libeigen3-dev libosmesa6-dev libpng-dev libisal-dev libcli11-dev libtomlplusplus-dev
                libmuparser-dev libfmt-dev nlohmann-json3-dev libcairo2-dev libfreetype-dev fonts-dejavu-core zlib1g-dev
                libedit-dev libchafa-dev libglib2.0-dev libpolyclipping-dev libqhull-dev libjs-chart.js libwebp-dev
                libassimp-dev gnuplot-nox librsvg2-bin)
# libegl-dev to libgl1-mesa-dri: second OpenGL context; chromium to python3-selenium: tests in a browser
test_packages=(doctest-dev help2man python3-junitparser python3-jsonschema dpkg-dev file libegl-dev libopengl-dev
               libgl1-mesa-dri chromium chromium-driver python3-selenium)

fail() { echo "$0: $*" >&2; exit 1; }

# Prints a package per line. Mesa 25.1 and later have no OSMesa; there, EGL replaces it.
missing_packages() {
  local installed
  if [[ " $* " == *" libosmesa6-dev "* ]] && is_known libegl-dev && ! is_known libosmesa6-dev; then
    set -- "${@/libosmesa6-dev/libegl-dev}" libopengl-dev libgl1-mesa-dri
  fi
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
              sed -n 's/ installed$//p') || true
  printf '%s\n' "$@" | grep -vxF -e "${installed:-none}" || true
}

is_known() { apt-cache show --no-all-versions "$@" >/dev/null 2>&1; }

install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    echo "This system is not Debian, so no packages are installed. The build needs (names of Debian): $*"
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  echo "Packages to install with apt-get: ${missing[*]}"
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  if ((EUID != 0)); then
    command -v sudo >/dev/null || fail "apt-get needs root, and there is no sudo. As root, run
  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}
and then run this script again."
    apt=(sudo "${apt[@]}")
  fi
  local install=("${apt[@]}" install -y --no-install-recommends)
  # fails if the package lists are missing or old
  if is_known "${missing[@]}" && "${install[@]}" "${missing[@]}"; then return; fi
  "${apt[@]}" update && mapfile -t missing < <(missing_packages "$@") && "${install[@]}" "${missing[@]}" || fail "apt-get could not install ${missing[*]}; its messages are above"
}

# is_configured FOLDER [-DNAME=VALUE...]: whether FOLDER was configured from this source folder with these options.
is_configured() {
  local cache=$1/CMakeCache.txt option
  [[ -f $1/build.ninja || -f $1/Makefile ]] && grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$cache" || return 1
  for option in "${@:2}"; do
    grep -qxE "${option:2}" <(sed 's/:[A-Z]*=/=/' "$cache") || return 1
  done
} 2>/dev/null

# build FOLDER [-DNAME=VALUE...]: configures FOLDER if necessary, and builds.
build() {
  local folder=$1 fresh=()
  if ! is_configured "$@"; then
    if ! is_configured "$folder"; then
      [[ -f $folder/CMakeCache.txt ]] && fresh=(--fresh)
      command -v ninja >/dev/null && fresh+=(-G Ninja)
    fi
    echo "Configuring $folder"
    cmake -S . -B "$folder" "${fresh[@]}" -DCMAKE_BUILD_TYPE=Release "${@:2}" >"$folder.log" 2>&1 ||
      { cat "$folder.log" >&2; rm -f "$folder.log"; fail "cmake could not configure $folder; its messages are above"; }
    rm -f "$folder.log"
  fi
  echo "Building $folder"
  cmake --build "$folder" --parallel "$(nproc)" || fail "the build failed; its messages are above"
}
