// What the pages of a test's server are sent.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "http/http_server.h"

namespace hl::test {

/// Greets with "hello", sends "scene" once to each page, and then "state".
inline FeedCallbacks fakePages(std::function<void(const std::string&)> receive = [](const std::string&) {}) {
  const auto sceneOnce = [] {
    return SceneSource([sent = std::make_shared<bool>(false)] {
      return std::exchange(*sent, true) ? nullptr : std::make_shared<const std::string>("scene");
    });
  };
  return {[] { return std::string("hello"); }, sceneOnce, [] { return std::string("state"); },
          [receive = std::move(receive)](PageNumber, const std::string& bytes) { receive(bytes); }};
}

}  // namespace hl::test
