// The two forms of an HL message: protobuf in binary WebSocket messages, its JSON form in text ones. The same schema,
// the same meaning; JSON is for browsers, scripts and people, binary for everything large.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace hl {

enum class MessageForm : std::uint8_t { kBinary, kJson };

/// Decodes `bytes` into `message`; why it cannot, in one line, or empty. Any thread.
std::string decodeMessage(MessageForm form, std::string_view bytes, proto::ClientMessage& message);
/// Field names in JSON are the schema's own; fields that are zero are written too. Any thread.
std::string encodeReply(MessageForm form, const proto::ServerReply& reply);

}  // namespace hl
