#include "cad/check_iges.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>

#include "base/error.h"
#include "base/text.h"

namespace hl {

namespace {

constexpr std::size_t kLetterAt = 72;           // a line has 80 columns: 72 of content, a letter, and its number
constexpr std::string_view kSections = "SGDP";  // of which T tells

using LinesOfSection = std::array<std::size_t, kSections.size()>;

void compareWith(const LinesOfSection& lines, std::string_view last) {
  constexpr std::size_t kWidth = 8;  // "P", and seven digits
  for (std::size_t i = 0; i < kSections.size(); ++i) {
    const std::string_view told = trimmed(last.substr(kWidth * i, kWidth));
    if (told.empty() || told[0] != kSections[i]) return;  // not as it is written down
    const std::string_view digits = trimmed(told.substr(1));
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    if (error != std::errc() || end != digits.data() + digits.size()) return;
    // A letter of several bytes shifts a line of S or G.
    const bool counts = kSections[i] == 'D' || kSections[i] == 'P';
    if (counts && lines[i] < count)
      throw Error(fmt::format("is cut or corrupt: its last line tells of {} lines {}, and there are {}", count,
                              kSections[i], lines[i]));
  }
}

}  // namespace

void checkIges(std::string_view bytes) {
  if (bytes.find('\n') == std::string_view::npos) return;
  LinesOfSection lines{};
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string_view line = bytes.substr(at, end - at);
    at = end + 1;
    if (line.size() <= kLetterAt) continue;
    if (line[kLetterAt] == 'T') return compareWith(lines, line);
    const std::size_t section = kSections.find(line[kLetterAt]);
    if (section != std::string_view::npos) ++lines[section];
  }
  throw Error("is cut: its last line, T, is missing");
}

}  // namespace hl
