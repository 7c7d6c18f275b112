# Sourced by app/run and tests/run: what both do before they differ. Expects `root`, the source tree's folder.
# Works without the network and at once when nothing is missing.
# shellcheck shell=bash
: "${root:?}"

logs=$root/build/logs

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }
[ -t 2 ] || say() { printf '%s\n' "$*" >&2; }

die() {
  say "$1"
  shift
  printf '  %s\n' "$@" >&2
  exit 1
}

# Runs a command with its output in a log; shows ninja's [n/m] as progress and, if it fails, the end of the log.
quietly() {
  local title=$1 log=$logs/$2.log started=$SECONDS
  shift 2
  mkdir -p "$logs"
  if ! "$@" 2>&1 | tee "$log" | progress "$title"; then
    tail -n 30 "$log" >&2
    die "$title failed." "the whole log: $log"
  fi
  say "$title: done in $((SECONDS - started)) s"
}

# A line that is rewritten on a terminal; elsewhere one line every tenth part.
progress() {
  local line shown=-1 tenth
  while IFS= read -r line; do
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] || continue
    tenth=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
    if [ -t 2 ]; then
      printf '\r%s: %s of %s ' "$1" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" >&2
    elif [ "$tenth" -gt "$shown" ]; then
      printf '%s: %s of %s\n' "$1" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" >&2
      shown=$tenth
    fi
  done
  [ ! -t 2 ] || printf '\r\033[K' >&2
}

# install_packages LIST...: installs what these files list and this machine lacks. PACKAGE=COMMAND in a list asks for the
# package only where there is no such command: npm, say, comes with other builds of nodejs, which conflict with Debian's.
install_packages() {
  local entry wanted=() missing as_root=()
  command -v dpkg-query >/dev/null ||
    die "This is no Debian: Helical installs its packages on Debian 12 only." \
      "install what app/packages.txt lists and build with: cmake --preset release && cmake --build --preset release"
  while read -r entry; do
    [[ $entry == *=* ]] && command -v "${entry#*=}" >/dev/null || wanted+=("${entry%%=*}")
  done < <(sed 's/#.*//' "$@" | tr -s ' \n' '\n' | sed '/^$/d')
  mapfile -t missing < <(comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
    <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
      sed -n 's/^installed //p' | sort -u))
  [ ${#missing[@]} -gt 0 ] || return 0
  say "Installing Debian packages: ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || die "These packages are missing and there is no sudo." \
      "as root: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  quietly "Updating the package lists" apt-update "${as_root[@]}" apt-get update
  quietly "Installing ${#missing[@]} packages" apt-install "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"
}

# configure PRESET [CMAKE OPTIONS...]: sets up build/PRESET.
configure() {
  local preset=$1
  shift
  quietly "Configuring $preset" "configure-$preset" cmake -S "$root" --preset "$preset" "$@"
}

# build PRESET TARGETS...: builds in build/PRESET; CMake configures it again by itself when it must.
build() {
  local preset=$1
  shift
  quietly "Building $preset" "build-$preset" cmake --build "$root/build/$preset" --target "$@"
}
