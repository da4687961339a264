// A draft as messages of proto/hl.proto: large meshes go ahead in parts (Upload), so that no message is long and a
// server can take other clients' messages between them.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "client/draft.h"

namespace hl::client {

struct FrameMessages {
  std::vector<proto::ClientMessage> uploads;  ///< to be sent before the frame
  proto::ClientMessage frame;
};

/// What a frame is made with besides its contents.
struct FrameTerms {
  std::uint64_t number = 1;
  std::optional<double> interval_s;
  proto::Limits limits;        ///< 0: no limit
  std::uint64_t& next_upload;  ///< number of the next upload; counted up
};

/// Throws Fault HL_OUT_OF_MEMORY when it is more than the limits let through.
FrameMessages buildMessages(Draft draft, const FrameTerms& terms);

}  // namespace hl::client
