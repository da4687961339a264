#include "wire/json_words.h"
#include "base/text.h"

#include <google/protobuf/descriptor.h>
#include <hl.pb.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace hl {

namespace {

constexpr std::string_view kUrl = "type.googleapis.com/";

std::string namesIn(const google::protobuf::EnumDescriptor& kinds) {
  std::string names;
  for (int i = 0; i < kinds.value_count(); ++i) names += (i > 0 ? ", " : "") + kinds.value(i)->name();
  return names;
}

std::string membersOf(const google::protobuf::Descriptor& message) {
  std::string members;
  for (int i = 0; i < message.field_count(); ++i)
    members += (i > 0 ? ", \"" : "\"") + message.field(i)->json_name() + "\": ..";
  return members;
}

std::string needOf(const std::string& type) {
  constexpr std::array<std::pair<std::string_view, const char*>, 6> kNeeds{
      {{"TYPE_DOUBLE", "is not a number"},
       {"TYPE_FLOAT", "is not a number"},
       {"TYPE_UINT32", "is not a whole number from 0"},
       {"TYPE_INT32", "is not a whole number"},
       {"TYPE_BOOL", "is not true or false"},
       {"TYPE_BYTES", "is not a text in base64"}}};
  for (const auto& [name, need] : kNeeds) {
    if (type == name) return need;
  }
  if (!type.starts_with(kUrl)) return "cannot be here";
  const auto* const pool = google::protobuf::DescriptorPool::generated_pool();
  const std::string name = type.substr(kUrl.size());
  if (const auto* const kinds = pool->FindEnumTypeByName(name)) return "is none of " + namesIn(*kinds);
  const auto* const message = pool->FindMessageTypeByName(name);
  return message == nullptr ? "cannot be here" : "must be an object: {" + membersOf(*message) + "}";
}

// The choice of this name, in a message or one within it, that has the member; null: there is none.
const google::protobuf::OneofDescriptor* choiceIn(const google::protobuf::Descriptor& message, const std::string& name,
                                                  const std::string& member) {
  const auto* const choice = message.FindOneofByName(name);
  for (int i = 0; choice != nullptr && i < choice->field_count(); ++i) {
    if (choice->field(i)->name() == member || choice->field(i)->json_name() == member) return choice;
  }
  for (int i = 0; i < message.nested_type_count(); ++i) {
    if (const auto* const found = choiceIn(*message.nested_type(i), name, member)) return found;
  }
  return nullptr;
}

// Of "oneof field 'source' is already set. Cannot set 'file'".
std::string wordsOfSecond(const std::string& said) {
  const auto quoted = [&](std::string_view before) {
    const std::size_t at = said.find(before);
    const std::size_t begin = at == said.npos ? said.size() : at + before.size();
    return said.substr(begin, said.find('\'', begin) - begin);
  };
  const std::string name = quoted("oneof field '"), member = quoted("Cannot set '");
  const auto& file = *proto::Scene::descriptor()->file();
  const google::protobuf::OneofDescriptor* choice = nullptr;
  for (int i = 0; choice == nullptr && i < file.message_type_count(); ++i)
    choice = choiceIn(*file.message_type(i), name, member);
  std::string members;
  for (int i = 0; choice != nullptr && i < choice->field_count(); ++i)
    members += (i > 0 ? ", " : "") + choice->field(i)->json_name();
  return "\"" + member + "\" is a second one of values that exclude each other: " + members;
}

// Of the part of its message behind the place: `invalid value "X" for type type.googleapis.com/hl.proto.Shade` is
// `"X" is none of SMOOTH, FLAT`. What is not known stays as it is.
std::string plainJsonWords(const std::string& said) {
  constexpr std::string_view kInvalid = "invalid value ", kFor = " for type ";
  if (said.starts_with("Cannot find field")) return "there is no such name";
  if (said.find("cannot start list") != said.npos) return "it must not be a list";
  if (said.find("Starting an object on a scalar field") != said.npos) return "one of its values must not be an object";
  if (said.find("oneof field") != said.npos) return wordsOfSecond(said);
  const std::size_t type = said.rfind(kFor);
  if (!said.starts_with(kInvalid) || type == said.npos) return said;
  return said.substr(kInvalid.size(), type - kInvalid.size()) + " " + needOf(said.substr(type + kFor.size()));
}

// A place with its names as documents have them: "objects[0].body.velocity_m_s" is "objects[0].body.velocityMS".
std::string jsonPlace(const std::string& place) {
  std::string names;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const bool joins = place[i] == '_' && i + 1 < place.size() && isLetterOrDigit(place[i + 1]);
    names += joins ? raised(place[++i]) : place[i];
  }
  return names;
}

}  // namespace

std::string JsonFault::line() const { return where.empty() ? words : jsonPlace(where) + ": " + words; }

// They read "(objects[0].material) stifness: Cannot find field." or "(objects[0].file): invalid value 3", and "unit:
// Cannot find field." of the outermost object.
JsonFault faultOfJson(std::string message) {
  message = message.substr(0, message.find('\n'));
  const std::size_t close = message.find(')');
  const bool placed = message.starts_with('(') && close != message.npos;
  std::string where = placed ? message.substr(1, close - 1) : std::string();
  const std::string rest = placed ? message.substr(close + 1) : " " + message;
  const std::size_t colon = rest.find(placed ? ":" : ": ");
  if (colon == rest.npos) return {where, placed ? rest : message};
  if (rest.starts_with(' ')) where += (where.empty() ? "" : ".") + rest.substr(1, colon - 1);
  const std::string said = rest.substr(colon + 1);
  return {where, plainJsonWords(said.substr(std::min(said.size(), said.find_first_not_of(' '))))};
}

}  // namespace hl
