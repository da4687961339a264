#include "io/check_gltf.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/json.hpp>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "base/plain_file.h"
#include "io/text_words.h"

namespace hl {

namespace {

namespace json = boost::json;

// What these change is not felt, or is read.
constexpr std::array<std::string_view, 11> kKnown{"KHR_technique",
                                                  "KHR_materials_",
                                                  "KHR_texture_",
                                                  "KHR_lights_",
                                                  "EXT_lights_",
                                                  "EXT_texture_",
                                                  "KHR_xmp",
                                                  "KHR_node_visibility",
                                                  "KHR_draco_mesh_compression",
                                                  "MPEG_",
                                                  "KHR_physics_rigid_bodies"};

bool isKnown(std::string_view extension) {
  return extension == "KHR_implicit_shapes" || std::any_of(kKnown.begin(), kKnown.end(), [&](std::string_view begin) {
           return extension.starts_with(begin);
         });
}

}  // namespace

// A .glb starts with "glTF", version, length; then the length and type of the JSON chunk, and the chunk.
std::string gltfJson(const std::string& path) {
  std::string text = contentOf(path).value_or("");
  constexpr std::size_t kHeader = 20;
  if (!text.starts_with("glTF") || text.size() < kHeader) return text;
  std::uint32_t length = 0;
  std::memcpy(&length, text.data() + 12, sizeof length);
  return text.substr(kHeader, length);
}

void checkGltf(const std::string& text) {
  if (text.find("extensionsRequired") == std::string::npos) return;
  json::error_code error;
  const json::value file = json::parse(text, error);
  const json::object* const object = error ? nullptr : file.if_object();
  const json::value* const required = object == nullptr ? nullptr : object->if_contains("extensionsRequired");
  const json::array* const names = required == nullptr ? nullptr : required->if_array();
  if (names == nullptr) return;
  for (const json::value& name : *names) {
    if (name.is_string() && !isKnown(std::string_view(name.as_string())))
      throw Error(fmt::format("needs the extension {}, which is not read: save it without",
                              shown(std::string(name.as_string()))));
  }
}

}  // namespace hl
