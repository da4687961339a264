#include "server/message_forms.h"

#include <google/protobuf/util/json_util.h>

#include <climits>

namespace hl {

namespace json = google::protobuf::util;

namespace {

std::string oneLine(std::string text) {
  constexpr std::size_t kMost = 300;  // the parser quotes what it does not like
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

}  // namespace

std::string decodeMessage(MessageForm form, std::string_view bytes, proto::ClientMessage& message) {
  if (bytes.size() > INT_MAX) return "the message is too large";
  if (form == MessageForm::kBinary) {
    const bool good = message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
    if (!good) return "the binary message is not an hl.proto.ClientMessage";
  } else {
    const auto status = json::JsonStringToMessage({bytes.data(), bytes.size()}, &message);
    if (!status.ok()) return oneLine("the text message is not a ClientMessage in JSON: " + status.ToString());
  }
  if (message.body_case() == proto::ClientMessage::BODY_NOT_SET) return "the message is empty or of an unknown kind";
  return {};
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
