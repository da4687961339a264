// TiffFile: a TIFF file by libtiff, and the tags of others in it, which libtiff does not know.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

namespace hl {

/// Every call throws hl::Error, without the file's name, when the file is not what it should be. Of one thread.
class TiffFile {
 public:
  explicit TiffFile(const std::string& path);

  /// Throws what libtiff said last.
  [[noreturn]] static void fail();
  TIFF* get() const { return file_.get(); }
  template <typename Value>
  Value number(ttag_t tag) const {
    Value value{};
    if (TIFFGetFieldDefaulted(get(), tag, &value) != 1) fail();
    return value;
  }
  /// Values of a tag that libtiff does not know: double, std::uint16_t or char. Empty: it is not there. Throws if
  /// they could not be read, or are of another type.
  template <typename Value>
  std::span<const Value> list(ttag_t tag) const {
    constexpr bool kDoubles = std::is_same_v<Value, double>;
    std::uint32_t count = 0;
    const void* const values = valuesOf(tag,
                                        kDoubles                      ? TIFF_DOUBLE
                                        : std::is_same_v<Value, char> ? TIFF_ASCII
                                                                      : TIFF_SHORT,
                                        count);
    return {static_cast<const Value*>(values), count};
  }

 private:
  struct Close {
    void operator()(TIFF* file) const { TIFFClose(file); }
  };

  const void* valuesOf(ttag_t tag, TIFFDataType type, std::uint32_t& count) const;

  std::unique_ptr<TIFF, Close> file_;
};

}  // namespace hl
