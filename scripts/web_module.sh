# Makes build/web-module/hl_web.{mjs,wasm}: the engine and the simulated device for a browser, with Debian's emscripten.
# Sourced by scripts/build.

# Sources that include themselves, once for each instruction set (Highway's foreach_target).
vector_sources() {
  (cd "$root/src" && grep -rl --include='*.cpp' 'hwy/foreach_target.h' . | sed 's|^\./||' | LC_ALL=C sort)
}

# One source for each folder: headers are most of the compiling. Without the faces of hulls: emscripten has no qhull.
web_sources() {
  local out="$1" folder file vectors
  rm -f "$out"/*.cpp "$out"/*.o
  vectors="$(vector_sources)"
  for folder in geometry surfaces scene bodies proxy control; do
    for file in $(find "$root/src/$folder" -name "*.cpp" | LC_ALL=C sort); do
      if [[ "$file" == */hull_faces.cpp ]] || grep -qxF "${file#"$root/src/"}" <<<"$vectors"; then continue; fi
      echo "#include \"$file\""
    done >"$out/$folder.cpp"
  done
  for file in $vectors; do echo "#include \"$root/src/$file\"" >"$out/vectors_$(basename "$file")"; done
  for file in src/base/{ledger,plain_math,quantities}.cpp src/device/{device_models,hand,mass_arm,phantom}.cpp \
    src/device/{phantom_arm,simulated_device,wrist}.cpp src/touch/{body_acts,body_events,body_hand,body_loop,body_world,exploration,felt_contact,hand_account}.cpp \
    src/touch/{held_contacts,joint_views,lost_bodies,proxy_loop,touch_events,touch_step}.cpp src/tools/trace.cpp; do
    echo "#include \"$root/$file\""
  done >"$out/rest.cpp"
  for file in "$root"/scenes/*.cpp; do echo "#include \"$file\""; done >"$out/scenes.cpp"
  for file in "$root"/web/*.cpp; do echo "#include \"$file\""; done >"$out/web.cpp"
}

# Debian's system libraries, read only, in a cache folder that the user may write its lock to.
web_cache() {
  mkdir -p "$1"
  ln -sfn /usr/share/emscripten/cache/sysroot "$1/sysroot"
  ln -sfn /usr/share/emscripten/cache/sysroot_install.stamp "$1/sysroot_install.stamp"
  ln -sfn /usr/share/emscripten/cache/build "$1/build"
}

build_web_module() {
  local out="$root/build/web-module" source
  # Eigen adds up three numbers in another order without SSE2, so the last bits would differ from a native build: emscripten
  # has these instructions over WebAssembly's own. With the version of this GCC, Eigen uses no assembler for them.
  local sse2='-msimd128 -msse2 -fgnuc-version=5.99 -DEIGEN_OPTIMIZATION_BARRIER(X)='
  local -a flags=(-std=c++20 -O2 -DNDEBUG -ffp-contract=off -fexceptions)
  mkdir -p "$out/include"
  web_sources "$out"
  web_cache "$out/cache"
  ln -sfn /usr/include/eigen3/Eigen "$out/include/Eigen"
  ln -sfn /usr/include/hwy "$out/include/hwy"
  ln -sfn /usr/include/boost "$out/include/boost"
  export EM_CACHE="$out/cache" NODE_PATH=/usr/share/nodejs
  flags+=(-I "$root/web/serial_tbb" -I "$root/include" -I "$root/src" -I "$root" -I "$root/scenes" -I "$root/web")
  flags+=(-isystem "$out/include" -include "$root/web/missing_std.h")
  # Eigen asks for MMX's header, and uses nothing of it.
  : >"$out/include/mmintrin.h"
  (cd "$out" && ls vectors_*.cpp) | sed 's/\.cpp$//' |
    xargs -P 2 -I {} em++ "${flags[@]}" -c "$out/{}.cpp" -o "$out/{}.o" || die "the web module does not compile"
  for source in geometry surfaces scene bodies proxy control rest scenes web; do echo "$source"; done |
    xargs -P 2 -I {} em++ "${flags[@]}" $sse2 -c "$out/{}.cpp" -o "$out/{}.o" || die "the web module does not compile"
  em++ -O2 -fexceptions "$out"/*.o -o "$out/hl_web.mjs" \
    -s MODULARIZE=1 -s EXPORT_ES6=1 -s ENVIRONMENT=worker -s ALLOW_MEMORY_GROWTH=1 -s FILESYSTEM=0 \
    -s DYNAMIC_EXECUTION=0 -s EXPORTED_RUNTIME_METHODS='["UTF8ToString","stringToUTF8"]' \
    -s EXPORTED_FUNCTIONS="$(web_exports)" || die "the web module does not link"
}

# Everything that web/hl_web.h declares.
web_exports() {
  grep -o 'hlWeb[A-Za-z]*(' "$root/web/hl_web.h" | sort -u | sed 's/^/"_/; s/($/"/' | paste -sd, |
    sed 's/^/["_malloc","_free",/; s/$/]/'
}
