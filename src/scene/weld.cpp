// An open-addressing hash table of vertex numbers: the first vertex with a key replaces all later ones.
#include "scene/weld.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "base/splitmix64.h"

namespace hl {

namespace {

// The bits of one vertex, for comparison. Zeros of different sign differ, and a NaN equals itself.
class VertexBits {
 public:
  explicit VertexBits(const Model& model) : model_(model) {}

  std::uint64_t hash(std::size_t i) const {
    std::uint64_t key = hashed(0, model_.positions[i]);
    if (!model_.normals.empty()) key = hashed(key, model_.normals[i]);
    if (!model_.texcoords.empty()) key = hashed(key, model_.texcoords[i]);
    return key;
  }
  bool same(std::size_t i, std::size_t j) const {
    return same(model_.positions, i, j) && same(model_.normals, i, j) && same(model_.texcoords, i, j);
  }

 private:
  template <typename Vector>
  static std::uint64_t hashed(std::uint64_t key, const Vector& v) {
    for (const double number : v) key = splitmix64(key ^ std::bit_cast<std::uint64_t>(number));
    return key;
  }
  template <typename Vector>
  static bool same(const std::vector<Vector>& list, std::size_t i, std::size_t j) {
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the bits decide
    return list.empty() || std::memcmp(list[i].data(), list[j].data(), sizeof(Vector)) == 0;
  }

  const Model& model_;
};

// The new number of each vertex, and the number of vertices.
struct Numbering {
  std::vector<std::uint32_t> now;
  std::size_t count = 0;
};

Numbering numberingOf(const Model& model) {
  constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();
  const VertexBits bits(model);
  const std::size_t n = model.positions.size();
  std::vector<std::uint32_t> table(std::bit_ceil(2 * n + 1), kEmpty);
  Numbering numbering{std::vector<std::uint32_t>(n), 0};
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t at = bits.hash(i) & (table.size() - 1);
    while (table[at] != kEmpty && !bits.same(table[at], i)) at = (at + 1) & (table.size() - 1);
    const bool first = table[at] == kEmpty;
    if (first) table[at] = static_cast<std::uint32_t>(i);
    numbering.now[i] = first ? static_cast<std::uint32_t>(numbering.count++) : numbering.now[table[at]];
  }
  return numbering;
}

// Moves the first vertex of each number to its new index, which is never larger than the old one.
template <typename Vector>
void keepFirst(std::vector<Vector>& list, const Numbering& numbering) {
  if (list.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (numbering.now[i] == kept) list[kept++] = list[i];
  }
  list.resize(kept);
  list.shrink_to_fit();
}

}  // namespace

std::size_t weldVertices(Model& model) {
  const std::size_t before = model.positions.size();
  const Numbering numbering = numberingOf(model);
  if (numbering.count == before) return 0;
  const auto renumber = [&](std::uint32_t& index) {
    if (index < before) index = numbering.now[index];
  };
  for (auto& triangle : model.triangles) {
    for (std::uint32_t& index : triangle) renumber(index);
  }
  for (auto& segment : model.segments) {
    for (std::uint32_t& index : segment) renumber(index);
  }
  for (std::uint32_t& index : model.points) renumber(index);
  keepFirst(model.positions, numbering);
  keepFirst(model.normals, numbering);
  keepFirst(model.texcoords, numbering);
  keepFirst(model.appearance.vertex_colours, numbering);
  return before - numbering.count;
}

}  // namespace hl
