#include "option_errors.h"

#include <cstddef>
#include <string_view>

namespace hl {

std::string errorText(const CLI::ParseError& error) {
  constexpr std::string_view kTwice = ": At Most 1 required but received ", kNone = ": 1 required ",
                             kExtra = " not expected: ", kNoNumber = "Could not convert: ", kIs = " = ";
  const std::string text = error.what();
  if (const std::size_t at = text.find(kTwice); at != text.npos)
    return text.substr(0, at) + " is given " + text.substr(at + kTwice.size()) + " times: give it once";
  if (const std::size_t at = text.find(kNone); at != text.npos && text.ends_with(" missing"))
    return text.substr(0, at) + " needs a value";
  if (const std::size_t at = text.find(kIs); at != text.npos && text.starts_with(kNoNumber))
    return text.substr(kNoNumber.size(), at - kNoNumber.size()) + ": '" + text.substr(at + kIs.size()) +
           "' is not a number";
  const std::size_t at = text.find(kExtra);
  if (!text.starts_with("The following argument") || at == text.npos) return text;
  const std::string words = " " + text.substr(at + kExtra.size());  // the last one first
  const std::size_t option = words.find(" -");
  if (option == words.npos) return "'" + words.substr(1) + "' is too much here";
  return "there is no option '" + words.substr(option + 1, words.find(' ', option + 1) - option - 1) + "' here";
}

void refuseEmptyWords(CLI::App& app) {
  const auto check = [](const std::string& text) {
    return text.empty() ? std::string("it is empty: say what it is, or leave it out") : std::string();
  };
  for (CLI::Option* option : app.get_options()) option->check(CLI::Validator(check, ""));
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) refuseEmptyWords(*command);
}

}  // namespace hl
