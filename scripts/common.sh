# What the shell scripts share: where the project is, how to speak, how many jobs to run. Sourced, never run.
# shellcheck shell=bash

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
script_name="$(basename "$0")"

say() { printf '%s: %s\n' "$script_name" "$*" >&2; }
die() {
  printf '%s: error: %s\n' "$script_name" "$*" >&2
  exit 1
}

# Prints the comment block at the top of the calling script, the text of --help.
usage() { sed -n '2,/^[^#]/{s/^# \{0,1\}//p}' "$0"; }

# One compiler per core, but never more than one per 2 GiB of memory: Boost.Beast sources need that much.
build_jobs() {
  local cores memory_kB by_memory
  cores="$(nproc)"
  memory_kB="$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo 2>/dev/null || true)"
  by_memory=$(((${memory_kB:-8388608}) / 2097152))
  if ((by_memory < 1)); then by_memory=1; fi
  echo $((cores < by_memory ? cores : by_memory))
}

# What one checkout has compiled, ccache finds again for another in a folder elsewhere.
export CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1
export CCACHE_SLOPPINESS="pch_defines,time_macros,include_file_mtime,include_file_ctime"

# Configures preset $1 into directory $2 when that was never done or the presets changed since.
# CMake itself re-runs when a CMakeLists.txt changes.
configure_preset() {
  local preset="$1" build_dir="$2"
  if [[ ! -f "$build_dir/build.ninja" || "$root/CMakePresets.json" -nt "$build_dir/build.ninja" ]]; then
    if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER="${CMAKE_CXX_COMPILER_LAUNCHER:-ccache}"; fi
    # What CMake says goes to a log; its warnings and errors come on stderr anyway.
    mkdir -p "$build_dir"
    (cd "$root" && cmake --preset "$preset" >"$build_dir/configure.log")
  fi
}

# Reads what ninja prints: reports how far it is, on one line that is written over on a terminal, every ten seconds
# elsewhere; what compilers say passes through.
show_progress() {
  local line shown=$SECONDS counted=no
  while IFS= read -r line; do
    if [[ ! "$line" =~ ^\[([0-9]+)/([0-9]+)\]\  ]]; then
      [[ "$line" == "ninja: "* ]] || printf '%s\n' "$line"
    elif [[ -t 2 ]]; then
      printf '\r%s: %s of %s compiled' "$script_name" "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" >&2
      counted=yes
    elif ((SECONDS - shown >= 10)); then
      say "${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} compiled"
      shown=$SECONDS
    fi
  done
  if [[ $counted == yes ]]; then printf '\n' >&2; fi
}

# Builds the given targets (default: all) in directory $1, and says how far it is.
build_dir() {
  local dir="$1"
  shift
  # A dry run shows whether there is anything to do, so that nothing to do says nothing.
  if ninja -C "$dir" -n "$@" 2>/dev/null | grep -q 'no work to do'; then return; fi
  NINJA_STATUS="[%f/%t] " ninja -C "$dir" -j "$(build_jobs)" "$@" 2>&1 | show_progress
}
