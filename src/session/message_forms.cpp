#include "session/message_forms.h"

#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver_util.h>

#include <boost/json/parse.hpp>
#include <boost/json/value.hpp>
#include <charconv>
#include <climits>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/utf8.h"
#include "session/message_size.h"

namespace hl {

namespace json = google::protobuf::util;

std::string oneLine(std::string text) {
  constexpr std::size_t kMax = 300;
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  if (text.size() <= kMax) return text;
  return std::string(beginOf(text, kMax)) + "...";
}

namespace {

// Of text that is made binary: what the parser keeps of each pair of braces.
constexpr std::uint64_t kOfText = 16;

// The binary form of the text; why it has none, or empty.
std::string toBinary(std::string_view text, std::string& binary) {
  static const std::unique_ptr<json::TypeResolver> resolver(json::NewTypeResolverForDescriptorPool(
      "type.googleapis.com", google::protobuf::DescriptorPool::generated_pool()));
  const std::string type = "type.googleapis.com/" + proto::ClientMessage::descriptor()->full_name();
  const auto status = json::JsonToBinaryString(resolver.get(), type, {text.data(), text.size()}, &binary);
  return status.ok() ? "" : oneLine("the text message is not a ClientMessage in JSON: " + status.ToString());
}

// Of a text that is JSON but no message; 0 where it has none. A number of 64 bits may be written as a string.
std::uint64_t frameNumberIn(std::string_view text) {
  boost::json::error_code error;
  const boost::json::value message = boost::json::parse({text.data(), text.size()}, error);
  if (error) return 0;
  const boost::json::value* const number = message.find_pointer("/frame/number", error);
  if (number == nullptr) return 0;
  if (const std::int64_t* const value = number->if_int64()) return *value < 0 ? 0 : static_cast<std::uint64_t>(*value);
  if (const std::uint64_t* const value = number->if_uint64()) return *value;
  std::uint64_t value = 0;
  if (const boost::json::string* const digits = number->if_string())
    std::from_chars(digits->data(), digits->data() + digits->size(), value);
  return value;
}

}  // namespace

Decoding decodeMessage(MessageForm form, std::string_view bytes, proto::ClientMessage& message, MemoryShare& memory) {
  if (bytes.size() > INT_MAX) return {.fault = "the message is too large", .no_room = ""};
  std::string binary;
  try {
    if (form == MessageForm::kJson) {
      memory.take(kOfText * bytes.size());
      if (std::string fault = toBinary(bytes, binary); !fault.empty()) {
        const std::uint64_t frame = frameNumberIn(bytes);
        return {.fault = std::move(fault), .no_room = "", .frame = frame};
      }
      bytes = binary;
    }
    memory.take(bytesToDecode(bytes));
  } catch (const Error& error) {
    message = outlineOf(bytes);
    return {.fault = "", .no_room = error.what()};
  }
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    return {.fault = "the binary message is not an hl.proto.ClientMessage", .no_room = ""};
  if (message.body_case() == proto::ClientMessage::BODY_NOT_SET)
    return {.fault = "the message is empty or of an unknown kind", .no_room = ""};
  return {};
}

std::string decodeMessage(MessageForm form, std::string_view bytes, proto::ClientMessage& message) {
  MemoryShare uncounted;
  return decodeMessage(form, bytes, message, uncounted).fault;
}

std::string encodeReply(MessageForm form, const proto::ServerReply& reply) {
  if (form == MessageForm::kBinary) return reply.SerializeAsString();
  json::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string text;
  const auto status = json::MessageToJsonString(reply, &text, options);
  return status.ok() ? text : R"({"refusal":{"text":"a reply has no JSON form","fatal":false}})";
}

}  // namespace hl
