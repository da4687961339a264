#include "io/ply_body.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <utility>

#include "base/error.h"
#include "io/text_words.h"

namespace hl {

namespace {

// Lengths of lists, of which most programs write one byte each.
class PlyWalk {
 public:
  PlyWalk(std::string_view body, bool big_endian)
      : body_(body), swap_(big_endian == (std::endian::native == std::endian::little)) {}

  /// False: the size is not known, and nothing more can be said.
  bool pass(const PlyKind& kind) {
    const auto is_known = [](const PlyProperty& property) { return property.number.has_value(); };
    if (!std::all_of(kind.properties.begin(), kind.properties.end(), is_known)) return kind.count == 0;
    const bool lists = std::any_of(kind.properties.begin(), kind.properties.end(),
                                   [](const PlyProperty& property) { return property.length.has_value(); });
    if (lists) {
      for (std::uint64_t i = 0; i < kind.count; ++i) passElement(kind, i);
    } else {
      passSame(kind);
    }
    return true;
  }

 private:
  [[noreturn]] static void refuse(const PlyKind& kind, std::uint64_t had) {
    throw Error(fmt::format("it is cut: its header tells of {} elements of the kind '{}', and it has {}", kind.count,
                            shown(kind.name), had));
  }

  void passSame(const PlyKind& kind) {
    std::size_t size = 0;
    for (const PlyProperty& property : kind.properties) size += sizeOf(*property.number);
    if (size == 0) return;
    const std::uint64_t room = (body_.size() - at_) / size;
    if (room < kind.count) refuse(kind, room);
    at_ += kind.count * size;
  }

  void passElement(const PlyKind& kind, std::uint64_t number) {
    for (const PlyProperty& property : kind.properties) {
      std::uint64_t count = 1;
      if (property.length) {
        const std::size_t bytes = sizeOf(*property.length);
        if (body_.size() - at_ < bytes) refuse(kind, number);
        const double length = numberAt(body_.data() + at_, {0, *property.length}, swap_);
        constexpr double kMost = 4294967295.0;
        if (!(length >= 0 && length <= kMost))
          throw Error(
              fmt::format("element {} of the kind '{}' has a list of {:g} numbers", number, shown(kind.name), length));
        count = static_cast<std::uint64_t>(length);
        at_ += bytes;
      }
      const std::uint64_t bytes = count * sizeOf(*property.number);
      if (body_.size() - at_ < bytes) refuse(kind, number);
      at_ += bytes;
    }
  }

  const std::string_view body_;
  const bool swap_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<ScalarKind> plyKindOf(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, ScalarKind>, 16> kForms{{{"char", ScalarKind::kInt8},
                                                                            {"int8", ScalarKind::kInt8},
                                                                            {"uchar", ScalarKind::kUint8},
                                                                            {"uint8", ScalarKind::kUint8},
                                                                            {"short", ScalarKind::kInt16},
                                                                            {"int16", ScalarKind::kInt16},
                                                                            {"ushort", ScalarKind::kUint16},
                                                                            {"uint16", ScalarKind::kUint16},
                                                                            {"int", ScalarKind::kInt32},
                                                                            {"int32", ScalarKind::kInt32},
                                                                            {"uint", ScalarKind::kUint32},
                                                                            {"uint32", ScalarKind::kUint32},
                                                                            {"float", ScalarKind::kFloat},
                                                                            {"float32", ScalarKind::kFloat},
                                                                            {"double", ScalarKind::kDouble},
                                                                            {"float64", ScalarKind::kDouble}}};
  for (const auto& [of, form] : kForms) {
    if (of == name) return form;
  }
  return {};
}

void checkPlyBody(std::string_view body, const std::vector<PlyKind>& kinds, bool big_endian) {
  PlyWalk walk(body, big_endian);
  for (const PlyKind& kind : kinds) {
    if (!walk.pass(kind)) return;
  }
}

bool isWholePlyLine(std::string_view line, const PlyKind& kind) {
  for (const PlyProperty& property : kind.properties) {
    const std::string_view word = takeWord(line);
    std::uint64_t count = 0;
    if (property.length) std::from_chars(word.data(), word.data() + word.size(), count);
    bool there = !word.empty();
    for (std::uint64_t i = 0; i < count && there; ++i) there = !takeWord(line).empty();
    if (!there) return false;
  }
  return true;
}

}  // namespace hl
