// The frames of a client, from message to scene: they wait, are built, and are ready until they are reported as shown.
#pragma once

#include <hl.pb.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "scene/editable_scene.h"
#include "session/check_bodies.h"
#include "session/decode_frame.h"

namespace hl {

/// For a builder.
struct WaitingFrame {
  proto::Frame frame;
  Uploads uploads;             ///< those that the frame refers to
  MemoryShare memory;          ///< what both take
  bool answers_force = false;  ///< see SceneEdit
  std::int64_t arrived_ns = 0;
};

/// By a builder; nothing of it is to be seen yet.
struct BuiltFrame {
  std::uint64_t number = 0;
  DecodedFrame decoded;  ///< what is left of it: its edit has become the objects
  EditableScene::Next objects;
  WorldParts bodies;
  std::int64_t move_ns = 0;  ///< that the objects take to get there
};

/// For the scene that is made next.
struct ReadyFrame {
  std::uint64_t number = 0;
  std::vector<std::string> warnings;
};

}  // namespace hl
