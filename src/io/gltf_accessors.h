// The accessors of a glTF 2.0 file: where their numbers are, checked against the buffers (glTF 2.0, 3.6), as their
// reader takes offsets that wrap around and sparse indices as they come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_file.h"
#include "io/gltf_item.h"
#include "io/point_records.h"

namespace hl {

/// Numbers at equal distances in a buffer.
struct GltfRun {
  std::size_t buffer = 0, begin = 0, stride = 0;
};

struct GltfAccessor {
  std::string type;  ///< "VEC3"
  ScalarKind kind = ScalarKind::kFloat;
  bool normalized = false;
  std::size_t count = 0, parts = 0;  ///< elements, and numbers of each
  std::optional<GltfRun> run{};      ///< nothing: all are 0
  struct Sparse {
    std::size_t count = 0;
    ScalarKind kind = ScalarKind::kUint16;
    GltfRun indices, values;
  };
  std::optional<Sparse> sparse{};

  bool isFloats(std::string_view of_type) const { return type == of_type && kind == ScalarKind::kFloat; }
};

class GltfAccessors {
 public:
  /// Throws hl::Error, with the element, for buffers that are cut, and views and accessors that are not within them.
  /// `file` outlives it.
  explicit GltfAccessors(GltfFile& file);

  std::size_t size() const { return accessors_.size(); }
  const GltfAccessor& operator[](std::size_t number) const { return accessors_[number]; }

  /// The numbers of all elements, one behind the other; normalised integers are 0 to 1 or -1 to 1. Nothing where the
  /// bytes are in a file that is not there.
  std::optional<std::vector<float>> floatsOf(std::size_t accessor) const;
  /// The place of the first of the whole numbers that is `limit` or more; nothing where all are less.
  std::optional<std::size_t> firstFrom(std::size_t accessor, std::size_t limit) const;
  std::uint32_t wholeAt(std::size_t accessor, std::size_t place) const;

 private:
  struct View {
    std::size_t buffer, begin, length, stride;
  };

  void addView(const GltfItem& item, std::size_t buffers);
  void addAccessor(const GltfItem& item);
  void addSparse(const GltfItem& item, GltfAccessor& accessor) const;
  GltfRun runOf(const GltfItem& item, std::size_t view, std::size_t count, std::size_t size, bool strided) const;
  std::optional<const char*> bytesAt(const GltfRun& run) const;
  void substitute(const GltfAccessor& accessor, std::vector<float>& floats) const;

  GltfFile& file_;
  std::vector<View> views_;
  std::vector<GltfAccessor> accessors_;
};

}  // namespace hl
