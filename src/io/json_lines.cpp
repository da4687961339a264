#include "io/json_lines.h"

#include <boost/json/basic_parser_impl.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/text_words.h"

namespace hl {

namespace {

constexpr std::size_t kDeepest = 32;
constexpr const char* kTwice = "\" is there twice in one object";

// Of a path that is looked for: the line of the last value whose own path is a beginning of it, which is the value
// itself or the nearest around it; and the length of that path.
struct FoundLine {
  std::size_t line = 1, length = 0;
};
using FoundLines = std::map<std::string, FoundLine>;

// Follows the parser through the text, and looks for paths if there are any.
struct LineHandler {
  // NOLINTBEGIN(readability-identifier-naming): the names that Boost.JSON asks for
  using error_code = boost::json::error_code;
  using string_view = boost::json::string_view;
  static constexpr std::size_t max_object_size = std::size_t(-1);
  static constexpr std::size_t max_array_size = std::size_t(-1);
  static constexpr std::size_t max_key_size = 1000;
  static constexpr std::size_t max_string_size = std::size_t(-1);
  // NOLINTEND(readability-identifier-naming)

  struct Level {
    std::string path;  // of the object or array
    bool array = false;
    bool off = false;  // not on the way to a wanted path
    std::size_t next = 0;
    std::set<std::string> names{};  // of an object, until one is there twice
  };

  FoundLines wanted;
  std::size_t line = 1;
  std::vector<Level> levels;
  std::string key, part;
  bool out_of_range = false;
  std::optional<std::string> twice;  // a name in one object

  // The path of the value that begins now; left empty off the way to all wanted ones.
  std::string enter() {
    if (levels.empty()) return {};
    Level& level = levels.back();
    const std::size_t index = level.next++;
    if (wanted.empty() || level.off) return {};
    if (level.array) return level.path + "[" + std::to_string(index) + "]";
    return level.path.empty() ? key : level.path + "." + key;
  }
  // Whether `path` is that of a value on the way to a wanted one.
  bool note(const std::string& path) {
    if (!levels.empty() && levels.back().off) return false;
    bool leads = false;
    for (auto one = wanted.lower_bound(path); one != wanted.end() && one->first.starts_with(path); ++one) {
      const std::string& whole = one->first;
      const bool ends = path.empty() || whole.size() == path.size();
      if (!ends && whole[path.size()] != '.' && whole[path.size()] != '[') continue;
      leads = true;
      if (path.size() >= one->second.length) one->second = {line, path.size()};
    }
    return leads;
  }
  bool begin(bool array) {
    const std::string path = enter();
    const bool on_way = note(path);
    levels.push_back({on_way ? path : std::string(), array, !on_way});
    return true;
  }
  bool scalar() {
    note(enter());
    return true;
  }

  bool on_document_begin(error_code&) { return true; }
  bool on_document_end(error_code&) { return true; }
  bool on_object_begin(error_code&) { return begin(false); }
  bool on_object_end(std::size_t, error_code&) {
    levels.pop_back();
    return true;
  }
  bool on_array_begin(error_code&) { return begin(true); }
  bool on_array_end(std::size_t, error_code&) {
    levels.pop_back();
    return true;
  }
  bool on_key_part(string_view text, std::size_t, error_code&) {
    part.append(text.data(), text.size());
    return true;
  }
  bool on_key(string_view text, std::size_t, error_code& error) {
    key = part;
    key.append(text.data(), text.size());
    part.clear();
    if (!wanted.empty() || levels.back().names.insert(key).second) return true;
    twice = key;
    error = boost::json::error::syntax;
    return false;
  }
  bool on_string_part(string_view, std::size_t, error_code&) { return true; }
  bool on_string(string_view, std::size_t, error_code&) { return scalar(); }
  bool on_number_part(string_view, error_code&) { return true; }
  bool on_int64(std::int64_t, string_view, error_code&) { return scalar(); }
  bool on_uint64(std::uint64_t, string_view, error_code&) { return scalar(); }
  bool on_double(double value, string_view, error_code& error) {
    if (!std::isfinite(value)) {
      out_of_range = true;
      error = boost::json::error::exponent_overflow;
      return false;
    }
    return scalar();
  }
  bool on_bool(bool, error_code&) { return scalar(); }
  bool on_null(error_code&) { return scalar(); }
  bool on_comment_part(string_view, error_code&) { return true; }
  bool on_comment(string_view, error_code&) { return true; }
};

}  // namespace

namespace {

// Feeds the text line by line, so that the handler knows where it is. Returns the parser's complaint.
boost::json::error_code follow(std::string_view text, boost::json::basic_parser<LineHandler>& parser) {
  boost::json::error_code error;
  if (text.empty()) error = boost::json::error::incomplete;
  for (std::size_t at = 0; at < text.size() && !error; ++parser.handler().line) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    parser.write_some(end < text.size(), text.data() + at, end - at, error);
    if (error) break;
    at = end;
  }
  return error;
}

boost::json::parse_options deepest() {
  boost::json::parse_options options;
  options.max_depth = kDeepest;
  return options;
}

struct FollowedText {
  LineHandler handler;
  boost::json::error_code error;
};

FollowedText followed(std::string_view text, FoundLines wanted) {
  boost::json::basic_parser<LineHandler> parser(deepest());
  parser.handler().wanted = std::move(wanted);
  const boost::json::error_code error = follow(text, parser);
  return {std::move(parser.handler()), error};
}

FoundLines findLines(std::string_view text, const std::vector<std::string>& paths) {
  FoundLines wanted;
  for (const std::string& path : paths) wanted.try_emplace(path);
  return wanted.empty() ? wanted : followed(text, std::move(wanted)).handler.wanted;
}

}  // namespace

JsonLines::JsonLines(const std::string& before_line, std::string_view text) : text_(text) {
  const auto [handler, error] = followed(text, {});
  if (!error) return;
  const std::string where = before_line + std::to_string(handler.line) + ": ";
  if (handler.out_of_range) throw Error(where + "a number is out of range");
  if (handler.twice) throw Error(where + "the name \"" + shown(*handler.twice) + kTwice);
  if (error == boost::json::error::too_deep)
    throw Error(where + "values are nested deeper than " + std::to_string(kDeepest));
  throw Error(where + "this is not JSON: " + error.message());
}

std::vector<std::size_t> JsonLines::linesOf(const std::vector<std::string>& paths) const {
  std::vector<std::size_t> lines;
  lines.reserve(paths.size());
  const FoundLines found = findLines(text_, paths);
  for (const std::string& path : paths) lines.push_back(found.at(path).line);
  return lines;
}

std::vector<bool> JsonLines::have(const std::vector<std::string>& paths) const {
  std::vector<bool> there;
  there.reserve(paths.size());
  const FoundLines found = findLines(text_, paths);
  for (const std::string& path : paths) there.push_back(found.at(path).length == path.size());
  return there;
}

}  // namespace hl
