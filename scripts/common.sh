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

# Builds the given targets (default: all) in directory $1; one progress line on a terminal, errors only elsewhere.
build_dir() {
  local dir="$1"
  shift
  local quiet=()
  if [[ ! -t 1 ]]; then quiet=(--quiet); fi
  # A dry run tells whether there is anything to do, so that nothing to do says nothing.
  if ninja -C "$dir" -n "$@" 2>/dev/null | grep -q 'no work to do'; then return; fi
  NINJA_STATUS="[%f/%t, %es] " ninja -C "$dir" -j "$(build_jobs)" "${quiet[@]}" "$@"
}
