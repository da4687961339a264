// The two forms of an HL message: protobuf in binary WebSocket messages, its JSON form in text ones. The same schema,
// the same meaning; JSON is for browsers, scripts and people, binary for everything large.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "base/memory_budget.h"

namespace hl {

enum class MessageForm : std::uint8_t { kBinary, kJson };

/// Why a message could not be decoded, each in one line, or empty.
struct Decoding {
  std::string fault;        ///< it is none
  std::string no_room;      ///< there is no memory for it: then the message is its outline
  std::uint64_t frame = 0;  ///< number of the frame that has the fault, where it is known
};

/// Decodes `bytes` into `message`; what both take, and the decoding, is counted in `memory` before. Any thread.
Decoding decodeMessage(MessageForm form, std::string_view bytes, proto::ClientMessage& message, MemoryShare& memory);
/// Of memory that nobody counts; `fault`.
std::string decodeMessage(MessageForm form, std::string_view bytes, proto::ClientMessage& message);
/// What a client is sent: a line, cut where it is long, as it may quote what the client has sent.
std::string oneLine(std::string text);
/// Field names in JSON are the schema's own; fields that are zero are written too. Any thread.
std::string encodeReply(MessageForm form, const proto::ServerReply& reply);

}  // namespace hl
