// Contexts, errors and the URL: how a conversation begins and ends, and GL's sticky error.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "client/fake_server.h"

namespace hl::client::test_context {
namespace {

TEST_F(CallsTest, FirstErrorSticks) {
  hlBegin(99);
  hlPopMatrix();
  EXPECT_STREQ(hlGetString(HL_ERROR_STRING), "hlBegin: the mode must be HL_POINTS .. HL_POLYGON");
  EXPECT_EQ(hlGetError(), HL_INVALID_ENUM);
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
}

TEST_F(CallsTest, ErrorCallbackHearsEveryError) {
  std::vector<HLenum> heard;
  hlErrorFunc([](HLenum error, const char*, void* user) { static_cast<std::vector<HLenum>*>(user)->push_back(error); },
              &heard);
  hlBegin(99);
  hlPopMatrix();
  EXPECT_EQ(heard, (std::vector<HLenum>{HL_INVALID_ENUM, HL_STACK_UNDERFLOW}));
  EXPECT_EQ(hlGetError(), HL_INVALID_ENUM);
  hlErrorFunc(nullptr, nullptr);
  hlPopMatrix();
  EXPECT_EQ(heard.size(), 2U);
  EXPECT_EQ(hlGetError(), HL_STACK_UNDERFLOW);
}

TEST_F(CallsTest, GetErrorBetweenBeginAndEndIsInvalidOperation) {
  hlBegin(HL_POINTS);
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
  hlEnd();
  EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
}

TEST_F(CallsTest, CallsWithoutContextDoNothingButKeepAnErrorOfTheThread) {
  std::thread([] {
    EXPECT_EQ(hlGetError(), HL_NO_ERROR);
    hlBegin(HL_POINTS);
    hlVertex3f(0, 0, 0);
    hlEnd();
    hlFlush();
    hlFinish();
    HLdouble value = 5;
    hlGetDoublev(HL_PROXY_RADIUS, &value);
    EXPECT_EQ(value, 5);
    EXPECT_EQ(hlGetString(HL_VERSION), nullptr);
    EXPECT_EQ(hlPoll(), 0);
    EXPECT_EQ(hlIsObject(1), HL_FALSE);
    EXPECT_EQ(hlGetError(), HL_NO_CONTEXT);
    EXPECT_EQ(hlGetError(), HL_NO_ERROR);
  }).join();
}

TEST_F(CallsTest, ContextIsCurrentOnOneThreadAtATime) {
  EXPECT_EQ(hlGetCurrentContext(), context);
  std::thread([this] {
    EXPECT_EQ(hlMakeCurrent(context), HL_FALSE);
    EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
    EXPECT_EQ(hlGetCurrentContext(), nullptr);
    hlDestroyContext(context);
    EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
  }).join();
  EXPECT_EQ(hlMakeCurrent(nullptr), HL_TRUE);
  // A thread that ends lets go of its context.
  std::thread([this] { EXPECT_EQ(hlMakeCurrent(context), HL_TRUE); }).join();
  EXPECT_EQ(hlMakeCurrent(context), HL_TRUE);
}

TEST_F(CallsTest, MakeCurrentBetweenBeginAndEndIsInvalidOperation) {
  hlBegin(HL_POINTS);
  EXPECT_EQ(hlMakeCurrent(nullptr), HL_FALSE);
  hlEnd();
  EXPECT_EQ(hlGetCurrentContext(), context);
  EXPECT_EQ(hlGetError(), HL_INVALID_OPERATION);
}

TEST_F(CallsTest, ContextsDoNotKnowOfEachOther) {
  HLcontext* other = hlCreateContext("fake:");
  ASSERT_NE(other, nullptr);
  hlLoadName(5);
  hlMakeCurrent(other);
  EXPECT_EQ(integer(HL_CURRENT_NAME), 0);
  hlPopName();
  hlMakeCurrent(context);
  EXPECT_EQ(integer(HL_CURRENT_NAME), 5);
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
  hlDestroyContext(other);
  hlDestroyContext(nullptr);
}

TEST_F(CallsTest, StringsDescribeLibraryServerAndDevice) {
  EXPECT_STREQ(hlGetString(HL_VENDOR), "HL");
  EXPECT_STREQ(hlGetString(HL_VERSION), "0.1.0");
  EXPECT_STREQ(hlGetString(HL_SERVER_VERSION), "fake");
  EXPECT_STREQ(hlGetString(HL_DEVICE_NAME), "fake hand");
  EXPECT_STREQ(hlGetString(HL_DEVICE_LABEL), "left");
  EXPECT_EQ(integer(HL_DEVICE_COUNT), 2);
  EXPECT_EQ(integer(HL_DEVICE), 0);
  EXPECT_STREQ(hlGetStringi(HL_DEVICE_LABEL, 1), "right");
  EXPECT_STREQ(hlGetStringi(HL_DEVICE_NAME, 0), "fake hand");
  EXPECT_EQ(hlGetError(), HL_NO_ERROR);
  EXPECT_EQ(hlGetStringi(HL_DEVICE_LABEL, 2), nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_VALUE);
  EXPECT_EQ(hlGetStringi(HL_VENDOR, 0), nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_ENUM);
  EXPECT_STREQ(hlGetString(HL_FAULT), "");
  EXPECT_STREQ(hlGetString(HL_FRAME_WARNINGS), "");
  EXPECT_EQ(hlGetString(HL_FORCE), nullptr);
  EXPECT_EQ(hlGetError(), HL_INVALID_ENUM);
}

TEST_F(CallsTest, ADeviceIsChosenByItsLabel) {
  server->welcome.set_device(1);
  HLcontext* right = hlCreateContext("fake:?device=right");
  ASSERT_NE(right, nullptr) << hlGetConnectError();
  EXPECT_EQ(server->open.device_label(), "right");
  HLcontext* const before = hlGetCurrentContext();
  hlMakeCurrent(right);
  EXPECT_STREQ(hlGetString(HL_DEVICE_LABEL), "right");
  EXPECT_EQ(integer(HL_DEVICE), 1);
  hlMakeCurrent(before);
  hlDestroyContext(right);
  server->welcome.set_device(0);  // as of a server that knows no labels
  EXPECT_EQ(hlCreateContext("fake:?device=right"), nullptr);
  EXPECT_NE(std::string(hlGetConnectError()).find("by its number"), std::string::npos) << hlGetConnectError();
}

TEST_F(CallsTest, OpenSaysWhatTheUrlSays) {
  HLcontext* other = hlCreateContext("fake:?name=a%20b&token=t%26&device=3&master=0&keep=1&state_rate=12.5&timeout=1");
  ASSERT_NE(other, nullptr) << hlGetConnectError();
  EXPECT_EQ(server->open.client_name(), "a b");
  EXPECT_EQ(server->open.token(), "t&");
  EXPECT_EQ(server->open.device(), 3U);
  EXPECT_FALSE(server->open.master());
  EXPECT_TRUE(server->open.keep_objects());
  EXPECT_EQ(server->open.state_rate_hz(), 12.5);
  EXPECT_EQ(server->open.protocol_version(), 1U);
  hlDestroyContext(other);
}

TEST_F(CallsTest, FailedConnectionsSayWhy) {
  const auto failure = [](const char* url) {
    EXPECT_EQ(hlCreateContext(url), nullptr);
    return std::string(hlGetConnectError());
  };
  EXPECT_NE(failure("gopher://host").find("no way to a server at 'gopher:'"), std::string::npos);
  EXPECT_NE(failure("fake:?colour=red").find("'colour' is not an option"), std::string::npos);
  EXPECT_NE(failure("fake:?device=0&device=1").find("the option device is there twice"), std::string::npos);
  EXPECT_NE(failure("hl://localhost:1997/hl").find("leave '/hl' out"), std::string::npos);
  EXPECT_NE(failure("ws://localhost:1997/hl").find("no way to a server at 'ws:'"), std::string::npos);
  EXPECT_NE(failure(nullptr).find("null"), std::string::npos);
  server->answers_open = false;
  EXPECT_EQ(failure("fake:?timeout=0"), "the server has not answered in time");
  server->ended = "no route to host";
  EXPECT_EQ(failure("fake:"), "no route to host");
  server->ended.clear();
  server->refuse(0, "wrong token");
  EXPECT_EQ(failure("fake:"), "wrong token");
  server->answers_open = true;
  server->welcome.set_protocol_version(2);
  EXPECT_NE(failure("fake:").find("version 2"), std::string::npos);
}

TEST(ServerUrl, HostsAndPorts) {
  EXPECT_EQ(parseServerUrl("hl://host").host, "host");
  EXPECT_EQ(parseServerUrl("hl://host").port, 1997);
  EXPECT_EQ(parseServerUrl("hls://host:8/?keep=1").port, 8);
  EXPECT_EQ(parseServerUrl("hls://[::1]:8").host, "::1");
  EXPECT_EQ(parseServerUrl("hls://[::1]").port, 1997);
  EXPECT_EQ(parseServerUrl("hls://h?ca=/etc/a.pem").ca_file, "/etc/a.pem");
  EXPECT_EQ(parseServerUrl("inproc:").scheme, "inproc");
}

TEST(ServerUrl, NonsenseIsRefused) {
  for (const char* url : {"",
                          "host",
                          ":x",
                          "hl:host",
                          "hl://",
                          "hl://:5",
                          "hl://h:",
                          "hl://h:0",
                          "hl://h:70000",
                          "hl://h:5x",
                          "hl://[::1",
                          "hl://[::1]5",
                          "hl://h?name",
                          "hl://h?name=%4",
                          "hl://h?name=%zz",
                          "hl://h?device=-1",
                          "hl://h?master=2",
                          "hl://h?state_rate=nan",
                          "hl://h?timeout=1s",
                          "hl://a\nb"}) {
    EXPECT_ANY_THROW(parseServerUrl(url)) << url;
  }
}

TEST_F(CallsTest, LostConnectionIsReportedOnceAndEverythingStaysHarmless) {
  server->ended = "the server went away";
  hlPoll();
  EXPECT_STREQ(hlGetString(HL_ERROR_STRING), "the conversation has ended: the server went away");
  EXPECT_EQ(hlGetError(), HL_CONNECTION_LOST);
  EXPECT_EQ(integer(HL_CONNECTED), HL_FALSE);
  triangle();
  hlFlush();
  hlFinish();
  hlProxyd(HL_PROXY_RADIUS, 1e-3);
  hlPoll();
  EXPECT_TRUE(server->received.empty());
}

}  // namespace
}  // namespace hl::client::test_context
