// What follows the header of a PLY file: whether the bytes of a binary one, or a line of one in ASCII, suffice for
// the elements of the header. Elements of constant size are counted, and lists are walked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/point_records.h"

namespace hl {

struct PlyProperty {
  std::optional<ScalarKind> length{};  ///< of a list: the kind of its length
  std::optional<ScalarKind> number{};  ///< nothing: a kind that nobody knows
};

struct PlyKind {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties{};
};

/// By the name of a property's type.
std::optional<ScalarKind> plyKindOf(std::string_view name);

/// Throws hl::Error where `body` ends before the last element. What comes behind an element of unknown size is not
/// checked.
void checkPlyBody(std::string_view body, const std::vector<PlyKind>& kinds, bool big_endian);
/// Whether the line of an element in ASCII has all its numbers.
bool isWholePlyLine(std::string_view line, const PlyKind& kind);

}  // namespace hl
