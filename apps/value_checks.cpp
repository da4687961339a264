#include "value_checks.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/plain_file.h"

namespace hl {

namespace {

template <typename Number>
bool parseNumber(const std::string& text, Number& value) {
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last;
}

}  // namespace

CLI::Validator within(double least, double most) {
  const std::string range = fmt::format("{:g} to {:g}", least, most);
  return {[least, most, range](const std::string& text) {
            double value = 0;
            const bool good = parseNumber(text, value) && value >= least && value <= most;
            return good ? std::string() : "'" + text + "' is not a number from " + range;
          },
          range};
}

CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return {[least, most, range](const std::string& text) {
            std::uint64_t value = 0;
            const bool good = parseNumber(text, value) && value >= least && value <= most;
            return good ? std::string() : "'" + text + "' is not a whole number from " + range;
          },
          most > std::numeric_limits<std::uint16_t>::max() ? fmt::format("from {}", least) : range};
}

CLI::Validator finite() {
  return {[](const std::string& text) {
            double value = 0;
            const bool good = parseNumber(text, value) && std::isfinite(value);
            return good ? std::string() : "'" + text + "' is not a number";
          },
          ""};
}

CLI::Validator positive() {
  return {[](const std::string& text) {
            double value = 0;
            const bool good = parseNumber(text, value) && std::isfinite(value) && value > 0;
            return good ? std::string() : "'" + text + "' is not a number above zero";
          },
          "POSITIVE"};
}

CLI::Validator passing(std::function<void(const std::string& text)> check) {
  return {[check = std::move(check)](const std::string& text) {
            try {
              check(text);
              return std::string();
            } catch (const Error& error) {
              return std::string(error.what());
            }
          },
          ""};
}

CLI::Validator plainFile() { return passing(checkPlainFile); }

std::string noneOf(const std::string& text, const std::string& words) { return "'" + text + "' is none of " + words; }

}  // namespace hl
