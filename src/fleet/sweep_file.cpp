#include "fleet/sweep_file.h"

#include <fmt/core.h>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/plain_file.h"
#include "base/text.h"
#include "fleet/nearest_name.h"

namespace hl {

namespace {

const std::vector<std::string> kFileKeys{"scenes", "paths", "seeds", "rows", "options"};
const std::vector<std::string> kSeedKeys{"first", "count"};

/// One value of an option, and where it is said.
struct SaidValue {
  std::string text;
  std::size_t line = 0;
};

struct SaidOption {
  std::string name;
  std::vector<SaidValue> values;
};

std::size_t lineOf(const toml::node& node) { return node.source().begin.line; }

class SweepReader {
 public:
  SweepReader(const std::string& path, const SweepRules& rules) : path_(path), rules_(rules) {}

  SweepFile read() {
    const toml::table file = parse();
    checkKeys(file, kFileKeys, "");
    SweepFile sweep;
    sweep.scenes = texts(file, "scenes");
    sweep.paths = texts(file, "paths");
    if (const toml::node* rows = file.get("rows")) {
      if (!rows->is_boolean()) fail(*rows, "rows must be true or false");
      sweep.rows = **rows->as_boolean();
    }
    readOptions(file, sweep);
    if (const toml::node* seeds = file.get("seeds")) readSeeds(*seeds, sweep);
    checkCount(sweep);
    return sweep;
  }

 private:
  [[noreturn]] void failAt(std::size_t line, std::string message) const {
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return c < ' '; }, ' ');
    throw Error(fmt::format("{}:{}: {}", path_, line, message));
  }
  [[noreturn]] void fail(const toml::node& node, const std::string& message) const { failAt(lineOf(node), message); }

  toml::table parse() const {
    checkPlainFile(path_);
    try {
      return toml::parse_file(path_);
    } catch (const toml::parse_error& error) {
      const std::string what(error.description());
      failAt(error.source().begin.line, "this is not TOML: " + what);
    }
  }
  // `of`: " of options" in errors.
  void checkKeys(const toml::table& table, const std::vector<std::string>& names, const std::string& of) const {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      const std::size_t line = key.source().begin.line;
      if (name == "seed") failAt(line, "seeds are a list of their own, beside options: seeds = [1, 2, 3]");
      const std::string nearest = nearestName(name, names);
      if (!nearest.empty()) failAt(line, fmt::format("there is no '{}'{}: is '{}' meant?", name, of, nearest));
      std::string all;
      for (const std::string& one : names) all += (all.empty() ? "" : ", ") + one;
      failAt(line, fmt::format("there is no '{}'{}; there are {}", name, of, all));
    }
  }
  // A text, or a list of texts; each once.
  std::vector<std::string> texts(const toml::table& file, const std::string& key) const {
    const toml::node* node = file.get(key);
    if (node == nullptr) failAt(1, fmt::format("there are no {}: say {} = [\"...\"]", key, key));
    std::vector<std::string> texts;
    eachOf(*node, [&](const toml::node& item) {
      if (!item.is_string() || item.as_string()->get().empty()) fail(item, key + " must be texts in quotes");
      const std::string& text = item.as_string()->get();
      if (std::find(texts.begin(), texts.end(), text) != texts.end())
        fail(item, fmt::format("'{}' is there twice", text));
      texts.push_back(text);
    });
    if (texts.empty()) fail(*node, "there are no " + key + " in the list");
    return texts;
  }
  template <typename Use>
  static void eachOf(const toml::node& node, Use use) {
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& item : *list) use(item);
    } else {
      use(node);
    }
  }
  std::string textOf(const toml::node& value, const std::string& name) const {
    if (const auto* text = value.as_string()) return text->get();
    if (const auto* whole = value.as_integer()) return fmt::format("{}", whole->get());
    if (const auto* number = value.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* yes = value.as_boolean()) return yes->get() ? "true" : "false";
    fail(value, name + " must be a number, a text, true or false, or a list of these");
  }
  SaidOption saidOption(const std::string& name, const toml::node& node) const {
    SaidOption option{name, {}};
    eachOf(node, [&](const toml::node& value) {
      const std::string text = textOf(value, name);
      const auto same = [&](const SaidValue& said) { return said.text == text; };
      if (std::any_of(option.values.begin(), option.values.end(), same))
        fail(value, fmt::format("{} has the value {} twice", name, text));
      option.values.push_back({text, lineOf(value)});
    });
    if (option.values.empty()) fail(node, name + " has no value in its list");
    return option;
  }
  void readOptions(const toml::table& file, SweepFile& sweep) const {
    const toml::node* node = file.get("options");
    if (node == nullptr) {
      sweep.options.emplace_back();
      return;
    }
    eachOf(*node, [&](const toml::node& item) {
      const toml::table* table = item.as_table();
      if (table == nullptr) fail(item, "options must be a table, [options], or several, [[options]]");
      addGrid(*table, sweep);
    });
    if (sweep.options.empty()) fail(*node, "there are no options in the list");
  }
  // Every value of each option with every value of the others.
  void addGrid(const toml::table& table, SweepFile& sweep) const {
    checkKeys(table, rules_.names, " in options");
    std::vector<SaidOption> said;
    for (const auto& [key, node] : table) said.push_back(saidOption(std::string(key.str()), node));
    std::sort(said.begin(), said.end(), [](const SaidOption& a, const SaidOption& b) { return a.name < b.name; });
    checkValues(said, lineOf(table));
    std::size_t count = 1;
    for (const SaidOption& option : said) {
      count *= option.values.size();
      if (count > kMaxTasks) failAt(lineOf(table), tooMany());
    }
    std::vector<SweepOptions> grid(1);
    for (const SaidOption& option : said) {
      std::vector<SweepOptions> wider;
      for (const SweepOptions& options : grid) {
        for (const SaidValue& value : option.values) {
          wider.push_back(options);
          wider.back().push_back({option.name, value.text});
        }
      }
      grid = std::move(wider);
    }
    sweep.options.insert(sweep.options.end(), grid.begin(), grid.end());
  }
  // Each value once, with the first of all others.
  void checkValues(const std::vector<SaidOption>& said, std::size_t line) const {
    SweepOptions first;
    for (const SaidOption& option : said) first.push_back({option.name, option.values[0].text});
    for (std::size_t i = 0; i < said.size(); ++i) {
      for (const SaidValue& value : said[i].values) {
        SweepOptions options = first;
        options[i].value = value.text;
        const std::string fault = rules_.fault(options);
        if (!fault.empty()) failAt(lineOfFault(fault, said, i, value.line, line), fault);
      }
    }
  }
  static std::size_t lineOfFault(const std::string& fault, const std::vector<SaidOption>& said, std::size_t varied,
                                 std::size_t line_of_value, std::size_t line_of_table) {
    const auto names = [&](const SaidOption& option) {
      const std::size_t at = fault.find("--" + option.name);
      const std::size_t end = at + 2 + option.name.size();
      return at != std::string::npos && (end == fault.size() || (!isLetterOrDigit(fault[end]) && fault[end] != '-'));
    };
    if (names(said[varied])) return line_of_value;
    const auto named = std::find_if(said.begin(), said.end(), names);
    return named == said.end() ? line_of_table : named->values[0].line;
  }
  void readSeeds(const toml::node& node, SweepFile& sweep) const {
    std::set<std::int64_t> seen;
    const auto add = [&](std::int64_t seed, const toml::node& where) {
      if (seed < 0 || seed > rules_.most_seed) fail(where, fmt::format("a seed is from 0 to {}", rules_.most_seed));
      if (!seen.insert(seed).second) fail(where, fmt::format("the seed {} is there twice", seed));
      sweep.seeds.push_back(seed);
    };
    if (const toml::table* range = node.as_table()) {
      checkKeys(*range, kSeedKeys, " in seeds");
      const std::int64_t first = wholeIn(*range, "first"), count = wholeIn(*range, "count");
      if (count < 1 || count > static_cast<std::int64_t>(kMaxTasks))
        fail(node, fmt::format("the count of seeds is from 1 to {}", kMaxTasks));
      for (std::int64_t i = 0; i < count; ++i) add(first + i, node);
    } else {
      eachOf(node, [&](const toml::node& item) {
        if (!item.is_integer()) fail(item, "seeds are whole numbers, [1, 2, 3], or {first = 1, count = 3}");
        add(item.as_integer()->get(), item);
      });
      if (sweep.seeds.empty()) fail(node, "there are no seeds in the list");
    }
    const auto trembles = [](const SweepOption& option) { return option.name == "tremor"; };
    for (const SweepOptions& options : sweep.options) {
      if (std::none_of(options.begin(), options.end(), trembles))
        fail(node, "without tremor in options every seed gives the same: set tremor, or leave seeds out");
    }
  }
  std::int64_t wholeIn(const toml::table& table, const std::string& key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr || !node->is_integer())
      fail(node == nullptr ? static_cast<const toml::node&>(table) : *node, "seeds need " + key + ", a whole number");
    return node->as_integer()->get();
  }
  static std::string tooMany() { return fmt::format("more than {} tasks are asked for", kMaxTasks); }
  void checkCount(const SweepFile& sweep) const {
    std::size_t count = 1;
    for (const std::size_t factor : {sweep.scenes.size(), sweep.paths.size(), sweep.options.size(),
                                     std::max<std::size_t>(1, sweep.seeds.size())}) {
      count *= factor;
      if (count > kMaxTasks) failAt(1, tooMany());
    }
  }

  const std::string path_;
  const SweepRules& rules_;
};

}  // namespace

SweepFile readSweepFile(const std::string& path, const SweepRules& rules) { return SweepReader(path, rules).read(); }

}  // namespace hl
