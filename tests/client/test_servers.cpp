// The calls against real servers: one scene, said in every way HL has and brought over every carrier, feels the same to
// the last bit; and a finger on it is reported to the program.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <hl/hl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "client/inproc_link.h"
#include "client/open_link.h"
#include "fake_pages.h"
#include "http/http_server.h"
#include "session/touch_server.h"
#include "tools/trace.h"

namespace hl::client::test_servers {
namespace {

std::shared_ptr<TouchServer> startServer() {
  TouchServerSettings settings;
  settings.touch.explore = false;
  settings.touch.world_per_device = 1;
  auto server = std::make_shared<TouchServer>(makeSnapshot(std::vector<Instance>{}), settings);
  server->start();
  return server;
}

// ---- A scene: a dome of quads under a hierarchy, smooth, rough and scaled -------------------------------------------

constexpr int kRings = 6, kSides = 12;

struct Vertex {
  std::array<double, 3> position, normal;
};

Vertex domeVertex(int ring, int side) {
  const double polar = 0.5 * M_PI * ring / kRings, azimuth = 2 * M_PI * side / kSides;
  const std::array<double, 3> n{std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                std::sin(polar) * std::sin(azimuth)};
  return {{0.04 * n[0], 0.04 * n[1], 0.04 * n[2]}, n};
}

// Four corners of each quad, in turn.
std::vector<Vertex> domeQuads() {
  std::vector<Vertex> vertices;
  for (int ring = 1; ring < kRings; ++ring) {
    for (int side = 0; side < kSides; ++side) {
      for (const auto& [r, s] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        vertices.push_back(domeVertex(ring + r, side + s));
    }
  }
  return vertices;
}

void immediate() {
  hlBegin(HL_QUADS);
  for (const Vertex& v : domeQuads()) {
    hlNormal3dv(v.normal.data());
    hlVertex3dv(v.position.data());
  }
  hlEnd();
}

void arrays() {
  const std::vector<Vertex> vertices = domeQuads();
  hlEnableClientState(HL_VERTEX_ARRAY);
  hlEnableClientState(HL_NORMAL_ARRAY);
  hlVertexPointer(3, HL_DOUBLE, sizeof(Vertex), vertices[0].position.data());
  hlNormalPointer(HL_DOUBLE, sizeof(Vertex), vertices[0].normal.data());
  hlDrawArrays(HL_QUADS, 0, static_cast<HLsizei>(vertices.size()));
  hlDisableClientState(HL_VERTEX_ARRAY);
  hlDisableClientState(HL_NORMAL_ARRAY);
}

void objectList() {
  hlNewObject(5);
  immediate();
  hlEndObject();
  hlCallObject(5);
}

// Drawn out of shape, shown, and put right by moving its vertices, in two frames.
void movedObject() {
  const std::vector<Vertex> vertices = domeQuads();
  hlNewObject(5);
  hlBegin(HL_QUADS);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double out = 0.001 * static_cast<double>(i % 7);
    hlNormal3d(0, 1, 0.1 * static_cast<double>(i % 3));
    hlVertex3d(vertices[i].position[0] + out, vertices[i].position[1] - out, vertices[i].position[2]);
  }
  hlEnd();
  hlEndObject();
  hlCallObject(5);
  std::vector<double> positions, normals;
  for (const Vertex& v : vertices) {
    positions.insert(positions.end(), v.position.begin(), v.position.end());
    normals.insert(normals.end(), v.normal.begin(), v.normal.end());
  }
  const auto count = static_cast<HLsizei>(vertices.size());
  const HLsizei half = count / 2;
  EXPECT_EQ(hlFinishTimeout(60), HL_TRUE);
  hlUpdateVertices(5, 0, half, positions.data(), normals.data());
  EXPECT_EQ(hlFinishTimeout(60), HL_TRUE);
  hlUpdateVertices(5, half, count - half, &positions[3 * static_cast<std::size_t>(half)],
                   &normals[3 * static_cast<std::size_t>(half)]);
}

void scene(const std::function<void()>& dome) {
  hlMaterialf(HL_DYNAMIC_FRICTION, 0.25f);
  hlMaterialf(HL_STIFFNESS, 0.75f);
  hlPushMatrix();
  hlTranslated(0.01, -0.03, 0.002);
  hlRotated(20, 1, 2, 3);
  hlScaled(1.25, 0.75, 1);
  dome();
  hlPopMatrix();
}

// ---- What a finger feels of it --------------------------------------------------------------------------------------

// The scene as it is when what is on its way has arrived.
std::shared_ptr<const Snapshot> arrived(const Snapshot& snapshot) {
  std::vector<Instance> instances = snapshot.instances;
  for (Instance& instance : instances) instance.mesh_motion.reset();
  return makeSnapshot(std::move(instances), snapshot.name);
}

std::vector<double> feel(const Snapshot& snapshot) {
  std::vector<PathSample> path;
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-3 * i;
    path.push_back({t, {0.03 * std::sin(2 * t), 0.02 - 0.03 * std::min(1.0, t), 0.03 * std::sin(3 * t)}});
  }
  std::vector<double> felt;
  TraceSettings settings;
  settings.proxy.radius = 0.002;
  runTrace(snapshot, settings, path, [&](const TraceRow& row) {
    for (const Vec3& v : {row.proxy, row.target, row.force}) felt.insert(felt.end(), v.data(), v.data() + 3);
  });
  return felt;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// Draws on a server through a link of the scheme "test:", which the test chooses.
std::vector<double> feltThrough(const std::string& url, TouchServer& server, const std::function<void()>& dome) {
  HLcontext* context = hlCreateContext(url.c_str());
  EXPECT_NE(context, nullptr) << hlGetConnectError();
  if (context == nullptr) return {};
  hlMakeCurrent(context);
  scene(dome);
  EXPECT_EQ(hlFinishTimeout(60), HL_TRUE);
  EXPECT_EQ(hlGetError(), static_cast<HLenum>(HL_NO_ERROR)) << hlGetString(HL_ERROR_STRING);
  const std::vector<double> felt = feel(*arrived(*server.device().snapshot()));
  hlDestroyContext(context);
  return felt;
}

std::vector<double> feltInProcess(const std::function<void()>& dome) {
  const auto server = startServer();
  setLinkOpener("test", [&](const ServerUrl&) { return linkTo(server); });
  std::vector<double> felt = feltThrough("test:", *server, dome);
  setLinkOpener("test", {});
  return felt;
}

// A link whose messages go through their JSON form.
class JsonLink final : public Link {
 public:
  explicit JsonLink(std::unique_ptr<Link> inner) : inner_(std::move(inner)) {}
  void send(proto::ClientMessage message) override {
    std::string text;
    ASSERT_TRUE(google::protobuf::util::MessageToJsonString(message, &text).ok());
    proto::ClientMessage read;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(text, &read).ok());
    inner_->send(std::move(read));
  }
  std::size_t queuedBytes() const override { return inner_->queuedBytes(); }
  bool take(proto::ServerReply& reply) override { return inner_->take(reply); }
  bool wait(std::chrono::nanoseconds longest) override { return inner_->wait(longest); }
  std::string ended() const override { return inner_->ended(); }

 private:
  std::unique_ptr<Link> inner_;
};

TEST(Servers, ImmediateCallsArraysAndObjectListsFeelTheSameToTheBit) {
  const std::vector<double> first = feltInProcess(immediate);
  ASSERT_EQ(first.size(), 27'000u);
  double most = 0;
  for (std::size_t i = 6; i < first.size(); i += 9) most = std::max(most, std::abs(first[i + 1]));
  EXPECT_GT(most, 1) << "something is felt";
  EXPECT_TRUE(sameBits(first, feltInProcess(arrays)));
  EXPECT_TRUE(sameBits(first, feltInProcess(objectList)));
  EXPECT_TRUE(sameBits(first, feltInProcess(movedObject)));
}

TEST(Servers, JsonFeelsTheSameToTheBit) {
  const auto server = startServer();
  setLinkOpener("test", [&](const ServerUrl&) { return std::make_unique<JsonLink>(linkTo(server)); });
  const std::vector<double> felt = feltThrough("test:", *server, immediate);
  setLinkOpener("test", {});
  EXPECT_TRUE(sameBits(felt, feltInProcess(immediate)));
}

TEST(Servers, TheNetworkFeelsTheSameToTheBit) {
  const auto server = startServer();
  HttpServerSettings http;
  http.port = 0;
  HttpServer listener(http, test::fakePages(), server.get());
  listener.start();
  const std::string url = "hl://127.0.0.1:" + std::to_string(listener.port());
  EXPECT_TRUE(sameBits(feltThrough(url, *server, immediate), feltInProcess(immediate)));
  EXPECT_TRUE(sameBits(feltThrough(url, *server, movedObject), feltInProcess(immediate)));
  listener.stop();
}

// ---- A program and its own server -----------------------------------------------------------------------------------

bool waitFor(const std::function<bool()>& reached) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!reached()) {
    if (std::chrono::steady_clock::now() > end) return false;
    hlPoll();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

void floorOf(HLuint name, double y) {
  hlLoadName(name);
  hlBegin(HL_QUADS);
  hlVertex3d(-1, y, 1);
  hlVertex3d(1, y, 1);
  hlVertex3d(1, y, -1);
  hlVertex3d(-1, y, -1);
  hlEnd();
}

TEST(Servers, AProgramTouchesItsSceneInItsOwnProcess) {
  HLcontext* context = hlCreateContext("inproc:?state_rate=500");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  hlMakeCurrent(context);
  hlWorkspaced(0, 0, 0, 1);
  floorOf(42, 0);
  ASSERT_EQ(hlFinishTimeout(60), HL_TRUE);
  std::vector<HLuint> touched;
  hlEventFunc(
      HL_EVENT_TOUCH,
      [](const HLevent* event, void* user) { static_cast<std::vector<HLuint>*>(user)->push_back(event->name); },
      &touched);
  hlHandGoal3d(0, -0.01, 0);
  HLdouble force[3] = {0, 0, 0};
  EXPECT_TRUE(waitFor([&] {
    hlGetDoublev(HL_FORCE, force);
    return force[1] > 0.3 && !touched.empty();
  }));
  EXPECT_EQ(touched[0], 42u);
  HLcontact contact;
  ASSERT_EQ(hlGetContacts(1, &contact), 1);
  EXPECT_EQ(contact.name, 42u);
  EXPECT_EQ(hlGetError(), static_cast<HLenum>(HL_NO_ERROR));
  hlDestroyContext(context);
}

// A point beside nothing: the hand goes near it, is drawn to it, and pulls itself off.
TEST(Servers, ASnapHoldsTheHandUntilItIsPulledOff) {
  HLcontext* context = hlCreateContext("inproc:?state_rate=500");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  hlMakeCurrent(context);
  hlWorkspaced(0, 0, 0, 1);
  hlNewObject(5);
  hlSnapPoint3d(9, 9, 9, 0.001, 1);
  hlSnapPoint3d(0, 0, 0, 0.004, 1);
  hlEndObject();
  hlLoadName(42);
  hlCallObject(5);
  ASSERT_EQ(hlFinishTimeout(60), HL_TRUE);
  const auto get = [](HLenum name) {
    HLint value = 0;
    hlGetIntegerv(name, &value);
    return value;
  };
  hlHandGoal3d(0, 0.0005, 0);
  EXPECT_TRUE(waitFor([&] { return get(HL_SNAPPED_OBJECT) == 5; }));
  EXPECT_EQ(get(HL_SNAPPED_NAME), 42);
  EXPECT_EQ(get(HL_SNAP_NUMBER), 1);
  EXPECT_EQ(get(HL_CONTACT_COUNT), 0);
  hlHandGoal3d(0, 0.05, 0);
  EXPECT_TRUE(waitFor([&] { return get(HL_SNAPPED_OBJECT) == 0; }));
  EXPECT_EQ(hlGetError(), static_cast<HLenum>(HL_NO_ERROR));
  hlDestroyContext(context);
}

// Each time by several radii at once.
TEST(Servers, AFloorWhoseVerticesRiseLiftsTheProxy) {
  HLcontext* context = hlCreateContext("inproc:?state_rate=500");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  hlMakeCurrent(context);
  hlWorkspaced(0, 0, 0, 1);
  hlNewObject(1);
  floorOf(42, 0);
  hlEndObject();
  hlCallObject(1);
  ASSERT_EQ(hlFinishTimeout(60), HL_TRUE);
  hlHandGoal3d(0, -0.01, 0);
  HLdouble radius = 0;
  hlGetDoublev(HL_PROXY_RADIUS, &radius);
  const auto rests_on = [&](double height) {
    HLint contacts = 0;
    HLdouble proxy[3] = {0, 0, 0};
    hlGetIntegerv(HL_CONTACT_COUNT, &contacts);
    hlGetDoublev(HL_PROXY_POSITION, proxy);
    return contacts > 0 && std::abs(proxy[1] - height - radius) < 1e-6;
  };
  ASSERT_TRUE(waitFor([&] { return rests_on(0); }));
  for (const double height : {0.012, -0.004, 0.008, 0.016, 0.0}) {
    const std::array<HLdouble, 12> vertices{-1, height, 1, 1, height, 1, 1, height, -1, -1, height, -1};
    hlUpdateVertices(1, 0, 4, vertices.data(), nullptr);
    ASSERT_EQ(hlFinishTimeout(60), HL_TRUE);
    EXPECT_TRUE(waitFor([&] { return rests_on(height); })) << height;
  }
  EXPECT_EQ(hlGetError(), static_cast<HLenum>(HL_NO_ERROR));
  hlDestroyContext(context);
}

TEST(Servers, AServerThatIsNotThereIsReportedInOneLine) {
  EXPECT_EQ(hlCreateContext("hl://127.0.0.1:1"), nullptr);
  const std::string why = hlGetConnectError();
  EXPECT_NE(why.find("127.0.0.1"), std::string::npos) << why;
  EXPECT_EQ(why.find('\n'), std::string::npos);
}

TEST(Inproc, TheFirstContextSaysWhichDeviceIsSimulated) {
  HLcontext* const context = hlCreateContext("inproc:?sim=premium1.5");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  hlMakeCurrent(context);
  EXPECT_NE(std::string(hlGetString(HL_DEVICE_NAME)).find("1.5"), std::string::npos) << hlGetString(HL_DEVICE_NAME);
  HLcontext* const beside = hlCreateContext("inproc:");
  EXPECT_NE(beside, nullptr) << hlGetConnectError();
  EXPECT_EQ(hlCreateContext("inproc:?sim=premium1.0"), nullptr);
  EXPECT_NE(std::string(hlGetConnectError()).find("sim:premium1.5"), std::string::npos) << hlGetConnectError();
  hlDestroyContext(beside);
  hlDestroyContext(context);
  EXPECT_EQ(hlCreateContext("inproc:?sim=hammer"), nullptr);
  EXPECT_NE(std::string(hlGetConnectError()).find("premium1.0"), std::string::npos) << hlGetConnectError();
  EXPECT_EQ(hlCreateContext("hl://127.0.0.1:1?sim=premium1.5"), nullptr);
  EXPECT_NE(std::string(hlGetConnectError()).find("inproc:"), std::string::npos) << hlGetConnectError();
}

TEST(Inproc, TheForceOfAContactFollowsFromItsShareAlsoWhereItYields) {
  HLcontext* const context = hlCreateContext("inproc:?state_rate=500");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  hlMakeCurrent(context);
  constexpr double kScale = 2, kCompliance_m_N = 0.002;
  hlWorkspaced(0, 0, 0, kScale);
  hlMateriald(HL_STIFFNESS, 0.8);
  hlMateriald(HL_COMPLIANCE, kCompliance_m_N);
  floorOf(1, 0);
  ASSERT_EQ(hlFinishTimeout(60), HL_TRUE);
  hlHandGoal3d(0, -0.02, 0);
  HLdouble force[3] = {0, 0, 0}, spring = 0, expected = 0;
  const bool agrees = waitFor([&] {
    HLcontact contact;
    if (hlGetContacts(1, &contact) != 1) return false;
    hlGetDoublev(HL_FORCE, force);
    hlGetDoublev(HL_SPRING_STIFFNESS, &spring);
    expected = contact.share / (kScale / (spring * contact.stiffness) + kCompliance_m_N);
    return force[1] > 0.3 && std::abs(force[1] - expected) < 1e-3 * expected;
  });
  EXPECT_TRUE(agrees) << force[1] << " N, and " << expected << " N by the share";
  hlDestroyContext(context);
}

// 0, or the number of what is not as it is to be.
int leaveInChild(HLcontext* context) {
  hlFlush();
  if (hlGetError() != HL_NO_CONTEXT) return 1;
  if (hlMakeCurrent(context) == HL_TRUE || hlGetError() != HL_INVALID_OPERATION) return 2;
  if (hlCreateContext("inproc:") != nullptr) return 3;
  if (std::string(hlGetConnectError()).find("forked") == std::string::npos) return 4;
  hlDestroyContext(context);
  return hlGetError() == HL_NO_ERROR ? 0 : 5;
}

TEST(Inproc, AForkedChildLeavesTheContextToItsParent) {
  HLcontext* const context = hlCreateContext("inproc:");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  hlMakeCurrent(context);
  const pid_t child = fork();
  if (child == 0) _exit(leaveInChild(context));
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  floorOf(1, 0);
  EXPECT_EQ(hlFinishTimeout(60), HL_TRUE);
  hlDestroyContext(context);
}

TEST(Inproc, SamplesOfTheDeviceComeWithoutAGap) {
  HLcontext* const context = hlCreateContext("inproc:?state_rate=60");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  hlMakeCurrent(context);
  hlKeepSamples(100'000);
  std::vector<HLsample> all;
  EXPECT_TRUE(waitFor([&] {
    HLsample some[64];
    for (HLsizei count = 64; count == 64;) {
      count = hlTakeSamples(64, some);
      all.insert(all.end(), some, some + count);
    }
    return all.size() > 500;
  }));
  for (std::size_t i = 1; i < all.size(); ++i) ASSERT_GT(all[i].time, all[i - 1].time) << i;
  hlDestroyContext(context);
}

// The program may be anybody's: what it allocates later is not locked either.
TEST(Inproc, LeavesTheMemoryOfTheProgramAlone) {
  HLcontext* const context = hlCreateContext("inproc:");
  ASSERT_NE(context, nullptr) << hlGetConnectError();
  std::string locked_kB;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmLck:") status >> locked_kB;
  }
  EXPECT_EQ(locked_kB, "0");
  hlDestroyContext(context);
}

}  // namespace
}  // namespace hl::client::test_servers
