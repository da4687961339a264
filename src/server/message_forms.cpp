#include "server/message_forms.h"

#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver_util.h>

#include <climits>
#include <memory>
#include <utility>

#include "base/error.h"
#include "server/message_size.h"

namespace hl {

namespace json = google::protobuf::util;

std::string oneLine(std::string text) {
  constexpr std::size_t kMost = 300;
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  if (text.size() > kMost) {
    // Never in the middle of a UTF-8 character.
    std::size_t end = kMost;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    text.resize(end);
    text += "...";
  }
  return text;
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

}  // namespace

Decoding decodeMessage(MessageForm form, std::string_view bytes, proto::ClientMessage& message, MemoryShare& memory) {
  if (bytes.size() > INT_MAX) return {.fault = "the message is too large", .no_room = ""};
  std::string binary;
  try {
    if (form == MessageForm::kJson) {
      memory.take(kOfText * bytes.size());
      if (std::string fault = toBinary(bytes, binary); !fault.empty()) return {std::move(fault), ""};
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
