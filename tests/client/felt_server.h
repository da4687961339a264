// A running server without a network, an empty scene on it, and a program's context there: for tests of what a finger
// feels of frames that go through the calls. The scenes that come out are felt by loops of the test's own.
#pragma once

#include <gtest/gtest.h>
#include <hl/hl.h>

#include <memory>
#include <vector>

#include "client/inproc_link.h"
#include "client/open_link.h"
#include "session/touch_server.h"

namespace hl::test {

inline std::shared_ptr<TouchServer> startEmptyServer() {
  TouchServerSettings settings;
  settings.touch.explore = false;
  settings.touch.world_per_device = 1;
  auto server = std::make_shared<TouchServer>(makeSnapshot(std::vector<Instance>{}), settings);
  server->start();
  return server;
}

/// At its end no call may have failed.
class FeltServer : public testing::Test {
 protected:
  FeltServer() {
    client::setLinkOpener("test", [this](const client::ServerUrl&) { return client::linkTo(server_); });
    context_ = hlCreateContext("test:");
    EXPECT_NE(context_, nullptr) << hlGetConnectError();
    hlMakeCurrent(context_);
  }
  ~FeltServer() override {
    EXPECT_EQ(hlGetError(), static_cast<HLenum>(HL_NO_ERROR)) << hlGetString(HL_ERROR_STRING);
    hlDestroyContext(context_);
    client::setLinkOpener("test", {});
  }

  /// What the server shows, once the frame so far is shown.
  std::shared_ptr<const Snapshot> shown() {
    EXPECT_EQ(hlFinishTimeout(60), HL_TRUE);
    return server_->device().snapshot();
  }

 private:
  std::shared_ptr<TouchServer> server_ = startEmptyServer();
  HLcontext* context_ = nullptr;
};

}  // namespace hl::test
