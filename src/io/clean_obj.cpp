#include "io/clean_obj.h"

#include <algorithm>

#include "base/text.h"

namespace hl {

namespace {

// A comment may stand behind numbers; names may have the sign.
std::string_view withoutComment(std::string_view line) {
  constexpr std::string_view kOfNumbers = "vflp";
  const bool numbers = line.size() > 1 && kOfNumbers.find(line[0]) != std::string_view::npos;
  const std::size_t comment = numbers ? line.find('#') : std::string_view::npos;
  if (comment == std::string_view::npos) return line;
  const std::size_t last = line.substr(0, comment).find_last_not_of(" \t");
  return line.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

std::string_view cleanedLine(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos ? line : withoutComment(line.substr(first));
}

// Calls visit(line, end) for each line and what ends it: one letter, or nothing at the end of the text.
template <typename Visit>
void forEachLine(std::string_view text, const Visit& visit) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    visit(text.substr(begin, end - begin), text.substr(end, 1));
    begin = end + 1;
  }
}

}  // namespace

// Most files are clean, and some are large: they are not copied.
std::optional<std::string> cleanedObj(std::string_view text) {
  const std::string_view unmarked = withoutByteOrderMark(text);
  bool clean = unmarked.size() == text.size();
  forEachLine(unmarked, [&](std::string_view line, std::string_view) {
    clean = clean && cleanedLine(line).size() == line.size();
  });
  if (clean) return std::nullopt;
  std::string cleaned;
  cleaned.reserve(unmarked.size());
  forEachLine(unmarked, [&](std::string_view line, std::string_view end) {
    cleaned += cleanedLine(line);
    cleaned += end;
  });
  return cleaned;
}

}  // namespace hl
