#include "io/tiff_file.h"

#include <fmt/core.h>

#include <cstdarg>

#include "base/error.h"
#include "io/text_words.h"

namespace hl {

namespace {

thread_local std::string tiff_failure;

void keepFailure(const char*, const char* format, va_list values) {
  char text[300];
  std::vsnprintf(text, sizeof text, format, values);
  tiff_failure = text;
}

}  // namespace

TiffFile::TiffFile(const std::string& path) {
  TIFFSetWarningHandler(nullptr);
  TIFFSetErrorHandler(keepFailure);
  tiff_failure.clear();
  file_.reset(TIFFOpen(path.c_str(), "rm"));  // m: not mapped, as it may be larger than memory
  if (!file_) fail();
}

void TiffFile::fail() {
  // Of a row that lacks libtiff gives a number that is none.
  if (tiff_failure.starts_with("Read error")) throw Error("is cut or corrupt: it ends before its last samples");
  throw Error("is not a sound TIFF file" + (tiff_failure.empty() ? "" : ": " + shown(tiff_failure)));
}

// A tag that it does not know libtiff makes known where it meets it, and goes on without its values where it cannot
// read them.
const void* TiffFile::valuesOf(ttag_t tag, TIFFDataType type, std::uint32_t& count) const {
  const TIFFField* const field = TIFFFindField(get(), tag, TIFF_ANY);
  if (field == nullptr) return nullptr;
  const void* values = nullptr;
  const bool sound = TIFFFieldReadCount(field) == TIFF_VARIABLE2 && TIFFFieldDataType(field) == type &&
                     TIFFGetField(get(), tag, &count, &values) == 1 && values != nullptr;
  if (!sound)
    throw Error(
        fmt::format("is cut or corrupt: the values of its tag {} lie beyond its end, or are of another type", tag));
  return values;
}

}  // namespace hl
