// A glTF document in parts, for tests: one mesh of one primitive.
#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/base64.h"
#include "scene/model.h"

namespace hl::test {

template <typename Value>
void put(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Its parts are texts of JSON; lists are without their brackets.
struct GltfDocument {
  std::string bytes;
  std::vector<std::string> views, accessors;
  std::string attributes, primitive, mesh, nodes = R"({"mesh":0})", scene_nodes = "0", rest;
  std::size_t buffer_bytes = 0;  // 0: as many as there are

  /// An accessor with a view of its own; returns its number.
  int add(const void* data, std::size_t size, int component, std::size_t count, const std::string& type) {
    while (bytes.size() % 4 != 0) bytes += '\0';
    views.push_back(fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", bytes.size(), size));
    bytes.append(static_cast<const char*>(data), size);
    accessors.push_back(fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"{}"}})",
                                    views.size() - 1, component, count, type));
    return static_cast<int>(accessors.size() - 1);
  }
  int add(const std::vector<float>& floats, std::size_t count, const std::string& type) {
    return add(floats.data(), floats.size() * sizeof(float), 5126, count, type);
  }
  void attribute(const std::string& name, int accessor) {
    attributes += fmt::format(R"({}"{}":{})", attributes.empty() ? "" : ",", name, accessor);
  }

  /// `uri`: of the buffer, with its comma; empty: it is the binary chunk.
  std::string json(const std::string& uri) const {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{{}}}{}}}]{}}}],"accessors":[{}],"bufferViews":[{}],)"
        R"("buffers":[{{"byteLength":{}{}}}]{}}})",
        scene_nodes, nodes, attributes, primitive, mesh, fmt::join(accessors, ","), fmt::join(views, ","),
        buffer_bytes == 0 ? bytes.size() : buffer_bytes, uri, rest);
  }
  std::string gltf() const { return json(R"(,"uri":"data:application/octet-stream;base64,)" + toBase64(bytes) + '"'); }
  std::string glb() const {
    std::string text = json(""), binary = bytes;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    put(file, std::uint32_t{2});
    put(file, static_cast<std::uint32_t>(28 + text.size() + binary.size()));
    put(file, static_cast<std::uint32_t>(text.size()));
    put(file, std::uint32_t{0x4E4F534A});
    file += text;
    put(file, static_cast<std::uint32_t>(binary.size()));
    put(file, std::uint32_t{0x004E4942});
    return file + binary;
  }
};

inline std::vector<Vec3> cornersOf(const Model& model) {
  std::vector<Vec3> corners;
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) corners.push_back(model.positions[index]);
  }
  return corners;
}

}  // namespace hl::test
