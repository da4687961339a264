#include "io/json_lines.h"

#include <boost/json/basic_parser_impl.hpp>
#include <boost/json/src.hpp>  // the whole library, once
#include <cmath>
#include <vector>

#include "base/error.h"

namespace hl {

namespace {

constexpr std::size_t kDeepest = 32;

// Follows the parser through the text and notes the line of each member and each object in a list.
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
    std::size_t next = 0;
  };

  std::unordered_map<std::string, std::size_t>* lines = nullptr;
  std::size_t line = 1;
  std::vector<Level> levels;
  std::string key, part;
  bool out_of_range = false;

  // The path of the value that begins now.
  std::string enter() {
    if (levels.empty()) return {};
    Level& level = levels.back();
    if (level.array) return level.path + "[" + std::to_string(level.next++) + "]";
    return level.path.empty() ? key : level.path + "." + key;
  }
  bool begin(bool array) {
    const std::string path = enter();
    lines->emplace(path, line);
    levels.push_back({path, array, 0});
    return true;
  }
  bool scalar() {
    if (levels.empty()) return true;
    if (levels.back().array) {
      ++levels.back().next;
    } else {
      lines->emplace(enter(), line);
    }
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
  bool on_key(string_view text, std::size_t, error_code&) {
    key = part;
    key.append(text.data(), text.size());
    part.clear();
    return true;
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

JsonLines::JsonLines(const std::string& file, std::string_view text) {
  boost::json::parse_options options;
  options.max_depth = kDeepest;
  boost::json::basic_parser<LineHandler> parser(options);
  LineHandler& handler = parser.handler();
  handler.lines = &lines_;
  boost::json::error_code error;
  for (std::size_t at = 0; at < text.size() && !error; ++handler.line) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    parser.write_some(end < text.size(), text.data() + at, end - at, error);
    if (error) break;
    at = end;
  }
  if (text.empty()) error = boost::json::error::incomplete;
  if (!error) return;
  const std::string where = file + ":" + std::to_string(handler.line) + ": ";
  if (handler.out_of_range) throw Error(where + "a number is out of range");
  if (error == boost::json::error::too_deep)
    throw Error(where + "values are nested deeper than " + std::to_string(kDeepest));
  throw Error(where + "this is not JSON: " + error.message());
}

std::size_t JsonLines::lineOf(std::string path) const {
  while (!path.empty()) {
    if (const auto found = lines_.find(path); found != lines_.end()) return found->second;
    path.resize(path.find_last_of(".[") == std::string::npos ? 0 : path.find_last_of(".["));
  }
  return 1;
}

}  // namespace hl
