#include "fleet/fleet_texts.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/utf8.h"

namespace hl {

namespace {

// "3.5 h", "40 min", "100 s".
std::string timeInWords(double seconds) {
  constexpr double kMinute_s = 60, kHour_s = 3600;
  if (seconds < 2 * kMinute_s) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * kHour_s) return fmt::format("{:.0f} min", seconds / kMinute_s);
  return fmt::format("{:.1f} h", seconds / kHour_s);
}

}  // namespace

std::string fleetProgressText(std::size_t done, std::size_t all, double seconds) {
  const std::string count = fmt::format("{} of {} tasks", done, all);
  if (done == 0 || !(seconds > 0)) return count;
  const double rate = static_cast<double>(done) / seconds;
  const std::string rate_text = rate >= 10 ? fmt::format("{:.0f}", rate) : fmt::format("{:.2g}", rate);
  return fmt::format("{}, {} a second, {} left", count, rate_text, timeInWords(static_cast<double>(all - done) / rate));
}

std::string oneLineOf(std::string_view text) {
  constexpr std::size_t kLongest = 500;
  std::vector<std::uint32_t> points = codePointsOf(text);
  points.resize(std::min(points.size(), kLongest));
  std::replace_if(
      points.begin(), points.end(), [](std::uint32_t point) { return point < ' '; }, ' ');
  return utf8Of(points);
}

}  // namespace hl
