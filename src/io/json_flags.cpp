#include "io/json_flags.h"
#include "base/text.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <array>
#include <boost/json.hpp>

namespace hl {

namespace {

namespace json = boost::json;
using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

// Of any size of letters.
constexpr std::array<std::string_view, 10> kFlagWords{"t", "true", "y", "yes", "1", "f", "false", "n", "no", "0"};

bool isFlagWord(std::string_view text) {
  const auto same = [](char a, char b) { return lowered(a) == b; };
  return std::any_of(kFlagWords.begin(), kFlagWords.end(), [&](std::string_view word) {
    return std::equal(text.begin(), text.end(), word.begin(), word.end(), same);
  });
}

// Large scenes have none, and are not read a second time.
bool hasFlagWord(std::string_view text) {
  constexpr std::size_t kLongest = 5;
  for (std::size_t at = text.find('"'); at != std::string_view::npos; at = text.find('"', at + 1)) {
    const std::string_view rest = text.substr(at + 1, kLongest + 1);
    const std::size_t end = rest.find('"');
    if (end != std::string_view::npos && isFlagWord(rest.substr(0, end))) return true;
  }
  return false;
}

std::string flagTextIn(const json::value& value, const Descriptor& message, const std::string& place);

std::string flagTextOf(const json::value& value, const FieldDescriptor& field, const std::string& place) {
  if (const json::array* list = value.if_array()) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string found = flagTextOf((*list)[i], field, place + "[" + std::to_string(i) + "]");
      if (!found.empty()) return found;
    }
    return "";
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) return value.is_string() ? place : "";
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE ? flagTextIn(value, *field.message_type(), place) : "";
}

std::string flagTextIn(const json::value& value, const Descriptor& message, const std::string& place) {
  const json::object* object = value.if_object();
  for (int i = 0; object != nullptr && i < message.field_count(); ++i) {
    const FieldDescriptor& field = *message.field(i);
    for (const std::string& name : {field.json_name(), field.name()}) {
      const json::value* one = object->if_contains(name);
      if (one == nullptr) continue;
      const std::string found = flagTextOf(*one, field, place.empty() ? name : place + "." + name);
      if (!found.empty()) return found;
    }
  }
  return "";
}

}  // namespace

std::string textForFlag(std::string_view json, const Descriptor& message) {
  if (!hasFlagWord(json)) return "";
  json::error_code failed;
  return flagTextIn(json::parse(json::string_view(json.data(), json.size()), failed), message, "");
}

}  // namespace hl
