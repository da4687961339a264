// A glTF document in parts, for tests: one mesh of one primitive, its accessors with one view for each.
#pragma once

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <string>
#include <vector>

#include "io/base64.h"

namespace hl::test {

struct GltfDocument {
  std::string bytes;
  std::vector<std::string> views, accessors;
  std::string attributes, primitive, mesh, nodes, scene_nodes = "0", rest;

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
  std::string text() const {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{{}}}{}}}]{}}}],"accessors":[{}],"bufferViews":[{}],)"
        R"("buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}]{}}})",
        scene_nodes, nodes, attributes, primitive, mesh, fmt::join(accessors, ","), fmt::join(views, ","), bytes.size(),
        toBase64(bytes), rest);
  }
};

}  // namespace hl::test
