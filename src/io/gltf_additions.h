// GltfAdditions: accessors that a glTF document gets beside its own, with a buffer of their own.
#pragma once

#include <boost/json.hpp>
#include <cstddef>
#include <span>
#include <string>

namespace hl {

class GltfAdditions {
 public:
  /// `root` outlives it, and its lists have been checked. Those that it lacks are added, empty.
  explicit GltfAdditions(boost::json::object& root);

  /// The number of a new accessor of floats; `type`: "VEC3", of `parts` numbers.
  std::size_t add(std::span<const float> floats, const std::string& type, std::size_t parts);
  /// Adds the buffer. Called once, after all else.
  void finish();

 private:
  boost::json::object& root_;
  std::string bytes_;
};

}  // namespace hl
