// Options that take one of a few words, each of which stands for a value. --help shows the words, and which of them
// holds unless another one is given.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace hl {

template <typename Value>
struct Choice {
  const char* word;
  Value value;
};

/// `value` has one of the values of `choices`, and must outlive `app`.
template <typename Value>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Value& value,
                       const std::vector<Choice<std::type_identity_t<Value>>>& choices, const std::string& text) {
  std::vector<std::string> words;
  std::string default_word;
  for (const auto& choice : choices) {
    words.emplace_back(choice.word);
    if (choice.value == value) default_word = choice.word;
  }
  const auto set = [&value, choices](const std::string& word) {
    for (const auto& choice : choices) {
      if (word == choice.word) value = choice.value;
    }
  };
  return app.add_option_function<std::string>(name, set, text)->check(CLI::IsMember(words))->default_str(default_word);
}

/// on|off
inline CLI::Option* addSwitch(CLI::App& app, const std::string& name, bool& on, const std::string& text) {
  return addChoice(app, name, on, {{"on", true}, {"off", false}}, text);
}

/// light|firm: --hand, the grip of a simulated hand.
inline CLI::Option* addGripOption(CLI::App& app, bool& firm) {
  return addChoice(app, "--hand", firm, {{"light", false}, {"firm", true}}, "grip of the simulated hand");
}

}  // namespace hl
