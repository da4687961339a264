// The context behind HLcontext: all the state of the calls. The C entry points (hl_calls_*.cpp) work on it through
// call.h; one thread at a time.
#pragma once

#include <hl/hl_types.h>
#include <unistd.h>

#include <atomic>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "client/arrays.h"
#include "client/attributes.h"
#include "client/conversation.h"
#include "client/draft.h"
#include "client/error_state.h"
#include "client/event_queue.h"
#include "client/item_list.h"
#include "client/matrix_stack.h"
#include "client/object_table.h"
#include "client/recorder.h"
#include "client/texture_table.h"

namespace hl::client {

/// What a definition begins afresh.
struct DrawState {
  MatrixStack modelview{MatrixStack::Kind::kModelview};
  MatrixStack texture{MatrixStack::Kind::kTexture};
  AttributeStack attributes;

  MatrixStack& matrices() { return attributes.now.matrix_mode == HL_TEXTURE ? texture : modelview; }
};

/// The definition that is open.
struct Definition {
  HLuint object;
  ItemList items;
  DrawState outside;  ///< what hlEndObject goes back to
};

}  // namespace hl::client

/// Opaque to applications.
struct HLcontext {
  explicit HLcontext(hl::client::Conversation with);

  /// In a process that is forked from the one that made it: it has memory of its own there, but no threads.
  bool isOfAnotherProcess() const { return made_in != getpid(); }

  const pid_t made_in = getpid();
  hl::client::ErrorState errors;
  hl::client::Conversation conversation;
  hl::client::EventQueue events;

  hl::client::DrawState draw;
  hl::client::Recorder recorder;
  hl::client::Arrays arrays;
  std::optional<hl::client::Definition> definition;
  hl::client::ObjectTable objects;
  hl::client::TextureTable textures;

  hl::proto::Volume matter;           ///< of what hlVolume draws next: its `matter` alone
  bool solid_below = false;           ///< of the surfaces of volumes that are drawn next
  hl::proto::Joint joint;             ///< that hlJoin makes next
  hl::client::Draft frame;            ///< since the last flush; its textures are added when it is closed
  std::set<HLuint> world_textures;    ///< that the world uses which was drawn last and not refused
  std::string text;                   ///< what hlGetString returned last
  std::atomic<bool> current = false;  ///< on some thread

  /// Where drawing goes to: the open definition, else the frame's world.
  hl::client::ItemList& target();
  /// What has been recorded since the last flush, complete; a new frame begins.
  hl::client::Draft closeFrame();
  /// The tables are as if a frame had not been that the server has refused.
  void takeBack(hl::client::FrameChanges&& refused);
  /// Textures that are no more are bound no more.
  void unbindMissing();
  /// Drawing goes on as it was before the open definition, which ends.
  void leaveDefinition();
  /// Nothing of it has been; an open definition ends.
  void cancelFrame();

 private:
  std::set<HLuint> usedTextures() const;
};
