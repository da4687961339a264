#include "io/gltf_additions.h"

#include "io/base64.h"

namespace hl {

namespace json = boost::json;

GltfAdditions::GltfAdditions(json::object& root) : root_(root) {
  for (const char* list : {"accessors", "bufferViews", "buffers"}) root_.emplace(list, json::array());
}

std::size_t GltfAdditions::add(std::span<const float> floats, const std::string& type, std::size_t parts) {
  constexpr std::int64_t kFloat = 5126;
  json::array& accessors = root_["accessors"].as_array();
  json::array& views = root_["bufferViews"].as_array();
  views.push_back(json::object{{"buffer", root_["buffers"].as_array().size()},
                               {"byteOffset", bytes_.size()},
                               {"byteLength", floats.size_bytes()}});
  bytes_.append(reinterpret_cast<const char*>(floats.data()), floats.size_bytes());
  accessors.push_back(json::object{
      {"bufferView", views.size() - 1}, {"componentType", kFloat}, {"count", floats.size() / parts}, {"type", type}});
  return accessors.size() - 1;
}

void GltfAdditions::finish() {
  if (bytes_.empty()) return;
  root_["buffers"].as_array().push_back(
      json::object{{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + toBase64(bytes_)}});
}

}  // namespace hl
