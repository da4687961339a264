// DicomWriter: DICOM files for tests, explicit and little endian (PS3.5, 7.1.2 and A.2), written without any library.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "io/volume_taker.h"

namespace hl::test {

/// Elements of a data set, in the order of their tags.
class DicomSet {
 public:
  using Tag = std::pair<std::uint16_t, std::uint16_t>;

  DicomSet& text(const Tag& tag, const char* type, std::string value, char filler = ' ') {
    if (value.size() % 2 == 1) value += filler;
    elements_[tag] = {type, std::move(value)};
    return *this;
  }
  DicomSet& number(const Tag& tag, std::uint16_t value) { return text(tag, "US", bytesOf(value, false)); }
  DicomSet& numbers(const Tag& tag, const std::vector<double>& values) {
    std::string list;
    for (const double value : values) list += (list.empty() ? "" : "\\") + fmt::format("{:.9g}", value);
    return text(tag, "DS", list);
  }
  DicomSet& sequence(const Tag& tag, const std::vector<DicomSet>& items) {
    std::string content;
    for (const DicomSet& item : items) {
      const std::string bytes = item.bytes();
      content += tagged({0xfffe, 0xe000}) + bytesOf(static_cast<std::uint32_t>(bytes.size()), false) + bytes;
    }
    return text(tag, "SQ", content);
  }
  void remove(const Tag& tag) { elements_.erase(tag); }

  std::string bytes() const {
    std::string out;
    for (const auto& [tag, element] : elements_) {
      const auto& [type, value] = element;
      const bool large = type == "OW" || type == "SQ" || type == "OB";
      out += tagged(tag) + type;
      out += large ? std::string(2, '\0') + bytesOf(static_cast<std::uint32_t>(value.size()), false)
                   : bytesOf(static_cast<std::uint16_t>(value.size()), false);
      out += value;
    }
    return out;
  }

 private:
  static std::string tagged(const Tag& tag) { return bytesOf(tag.first, false) + bytesOf(tag.second, false); }

  std::map<Tag, std::pair<std::string, std::string>> elements_;
};

/// A whole file.
inline std::string dicomFile(const DicomSet& set) {
  DicomSet meta;
  meta.text({2, 2}, "UI", "1.2.840.10008.5.1.4.1.1.2", '\0').text({2, 3}, "UI", "1.2.3", '\0');
  meta.text({2, 0x10}, "UI", "1.2.840.10008.1.2.1", '\0');
  DicomSet length;
  length.text({2, 0}, "UL", bytesOf(static_cast<std::uint32_t>(meta.bytes().size()), false));
  return std::string(128, '\0') + "DICM" + length.bytes() + meta.bytes() + set.bytes();
}

struct DicomForm {
  std::string series = "1.2.3.4", name = "Test";
  std::uint16_t columns = 5, rows = 4, bits = 16, bytes = 2;
  bool is_signed = true;
  const char* kind = "MONOCHROME2";
  Vec3 along_row{1, 0, 0}, along_column{0, 1, 0};
  double column_step = 1, row_step = 1, slope = 1, offset = 0;
};

/// A slice of a CT without a place.
inline DicomSet dicomSlice(const DicomForm& form, const std::string& samples) {
  DicomSet set;
  set.text({8, 0x16}, "UI", "1.2.840.10008.5.1.4.1.1.2", '\0').text({8, 0x18}, "UI", "1.2.3", '\0');
  set.text({8, 0x60}, "CS", "CT").text({8, 0x103e}, "LO", form.name).text({0x20, 0xe}, "UI", form.series, '\0');
  set.numbers({0x18, 0x50}, {17});  // the thickness of slices, which does not say how far apart they lie
  const Vec3 &row = form.along_row, &column = form.along_column;
  set.numbers({0x20, 0x37}, {row.x(), row.y(), row.z(), column.x(), column.y(), column.z()});
  set.number({0x28, 2}, 1).text({0x28, 4}, "CS", form.kind).number({0x28, 0x10}, form.rows);
  set.number({0x28, 0x11}, form.columns).numbers({0x28, 0x30}, {form.row_step, form.column_step});
  set.number({0x28, 0x100}, static_cast<std::uint16_t>(8 * form.bytes)).number({0x28, 0x101}, form.bits);
  set.number({0x28, 0x102}, static_cast<std::uint16_t>(form.bits - 1)).number({0x28, 0x103}, form.is_signed ? 1 : 0);
  set.numbers({0x28, 0x1052}, {form.offset}).numbers({0x28, 0x1053}, {form.slope});
  set.text({0x7fe0, 0x10}, form.bytes == 1 ? "OB" : "OW", samples, '\0');
  return set;
}
inline DicomSet dicomSlice(const DicomForm& form, const std::string& samples, const Vec3& position) {
  return dicomSlice(form, samples).numbers({0x20, 0x32}, {position.x(), position.y(), position.z()});
}

}  // namespace hl::test
