// What values of options may be: checks for CLI11, each of which refuses a value with words that say what is wrong.
// CLI11's own checks let NaN pass, and take the numbers of an enumeration for its words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace hl {

// What numbers on the command line may be, so that no product of them, lengths and speeds leaves the range of doubles.
inline constexpr double kMinNumber = 1e-9, kMaxNumber = 1e9, kMinRadius_m = 1e-12;

/// A number from `least` to `most`. NaN is none.
CLI::Validator within(double least, double most);
/// A whole number from `least` to `most`.
CLI::Validator whole(std::uint64_t least, std::uint64_t most);
/// Any finite number.
CLI::Validator finite();
/// A finite number above zero.
CLI::Validator positive();
/// What this throws hl::Error for is refused, with its words.
CLI::Validator passing(std::function<void(const std::string& text)> check);
/// A plain file that may be read.
CLI::Validator plainFile();

/// What is wrong with a text that is none of these words.
std::string noneOf(const std::string& text, const std::string& words);
/// For CLI::Option::transform(): one of these words, for its value.
template <typename Value>
CLI::Validator oneOf(const std::map<std::string, Value>& values) {
  return {[values](std::string& text) {
            const auto found = values.find(text);
            if (found == values.end())
              return noneOf(text, CLI::detail::join(
                                      values, [](const auto& v) { return v.first; }, ", "));
            text = CLI::detail::value_string(found->second);
            return std::string();
          },
          ""};
}

}  // namespace hl
