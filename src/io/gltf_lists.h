// The lists of a glTF document that has been checked, for what changes it.
#pragma once

#include <boost/json.hpp>
#include <string_view>

namespace hl {

/// Empty where the document has none of this name; nothing is added to it then.
inline boost::json::array& gltfList(boost::json::object& root, std::string_view name) {
  static boost::json::array none;
  boost::json::value* const list = root.if_contains(name);
  return list == nullptr ? none : list->as_array();
}

/// Calls visit(primitive) for the primitives of all meshes.
template <typename Visit>
void forEachGltfPrimitive(boost::json::object& root, const Visit& visit) {
  for (boost::json::value& mesh : gltfList(root, "meshes")) {
    for (boost::json::value& primitive : gltfList(mesh.as_object(), "primitives")) visit(primitive.as_object());
  }
}

}  // namespace hl
