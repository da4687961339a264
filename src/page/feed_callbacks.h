// FeedCallbacks: what the pages' WebSockets carry, for the code that moves the bytes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "record/private_file.h"

namespace hl {

/// Gives one page the next message of the scene that it lacks; empty when it has everything.
using SceneSource = std::function<std::shared_ptr<const std::string>()>;

/// Of a page, as long as it is connected; none is given twice.
using PageNumber = std::uint64_t;

/// Called in one thread of the server's, beside the one that moves bytes. The strings are complete WebSocket binary
/// messages.
struct FeedCallbacks {
  std::function<std::string()> hello;
  std::function<SceneSource()> scene;  ///< once for each page; what it gives is asked before each state
  std::function<std::string()> state;
  /// One message of at most Limits::page_message_bytes from a page.
  std::function<void(PageNumber page, const std::string& bytes)> receive;
  /// This page has gone, however that came. In the thread that moves bytes; may be empty.
  std::function<void(PageNumber page)> gone{};
  /// A finished recording of a page, or null. Any thread; may be empty.
  std::function<FilePointer(std::uint32_t owner)> recording{};
};

}  // namespace hl
