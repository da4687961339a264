// Scene files, *.hl.json: read, then touched. What they name lies in a folder of the fuzzer's own, where nothing else
// is.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"
#include "io/load_scene_file.h"
#include "temp_folder.h"
#include "touch.h"

namespace {

// Built-in scenes of any size are sound, and take minutes with the sanitizers in: only those of 1 to 99 elements pass.
bool namesLargeScene(std::string_view text) {
  for (const std::string_view name :
       std::array<std::string_view, 6>{"teapot", "walker", "terrain", "sphere", "plane", "pipe"}) {
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
      const std::string_view rest = text.substr(at + name.size());
      const std::size_t end = rest.find('"');
      if (!rest.starts_with(':') || end > 3) return true;
    }
  }
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (namesLargeScene(text)) return 0;
  hl::LoadOptions options;
  options.most_primitives = 20'000;
  options.most_texels = 1U << 16;
  hl::SceneModel model;
  try {
    model = hl::loadSceneFile(hl::test::fileWith("scene.hl.json", text), options);
  } catch (const hl::Error& error) {
    hl::fuzz::require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    return 0;
  }
  hl::fuzz::touch(*hl::makeSnapshot(std::move(model)));
  return 0;
}
