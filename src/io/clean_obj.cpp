#include "io/clean_obj.h"

#include <algorithm>
#include <utility>

namespace hl {

namespace {

constexpr std::string_view kMark = "\xef\xbb\xbf", kBlanks = " \t";

// A comment may stand behind numbers; names may have the sign.
std::string_view withoutComment(std::string_view line) {
  constexpr std::string_view kOfNumbers = "vflp";
  const bool numbers = line.size() > 1 && kOfNumbers.find(line[0]) != std::string_view::npos;
  const std::size_t comment = numbers ? line.find('#') : std::string_view::npos;
  if (comment == std::string_view::npos) return line;
  const std::size_t last = line.substr(0, comment).find_last_not_of(kBlanks);
  return line.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

}  // namespace

std::optional<std::string> cleanedObj(std::string_view text) {
  bool changed = text.starts_with(kMark);
  if (changed) text.remove_prefix(kMark.size());
  std::string clean;
  clean.reserve(text.size());
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    const std::size_t first = line.find_first_not_of(kBlanks);
    const std::string_view kept = first == std::string_view::npos ? line : withoutComment(line.substr(first));
    changed |= kept.size() != line.size();
    clean += kept;
    if (end < text.size()) clean += text[end];
    begin = end + 1;
  }
  return changed ? std::optional(std::move(clean)) : std::nullopt;
}

}  // namespace hl
