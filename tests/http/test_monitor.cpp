// /healthz and /metrics, the text they are made of, and the lines of the event log.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "fake_pages.h"
#include "http/http_server.h"
#include "monitor/event_log.h"
#include "monitor/ros_metrics.h"
#include "monitor/share_metrics.h"
#include "monitor/touch_monitor.h"
#include "page/viewer_feed.h"
#include "plain_client.h"
#include "scene/snapshot.h"

namespace hl::test_monitor {
namespace {

// Every line of `text` is a comment of a family or a sample of the family before.
void expectPrometheus(const std::string& text) {
  const std::regex comment(R"(# (HELP [a-z_]+ .+|TYPE [a-z_]+ (gauge|counter)))");
  const std::regex sample(R"rx(([a-z_]+)(\{[a-z_]+="[^"]*"(,[a-z_]+="[^"]*")*\})? (NaN|[+-]?Inf|[-+.0-9e]+))rx");
  std::istringstream lines(text);
  std::set<std::string> series;
  for (std::string line, family; std::getline(lines, line);) {
    std::smatch match;
    if (line.starts_with('#')) {
      EXPECT_TRUE(std::regex_match(line, comment)) << line;
      family = line.substr(7, line.find(' ', 7) - 7);
      continue;
    }
    EXPECT_TRUE(std::regex_match(line, match, sample)) << line;
    EXPECT_EQ(match[1], family) << line;
    EXPECT_TRUE(series.insert(match[1].str() + match[2].str()).second) << "twice: " << line;
  }
  EXPECT_TRUE(text.ends_with('\n'));
}

std::shared_ptr<const Snapshot> oneTriangle() {
  Model model;
  model.positions = {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0, 0.1)};
  model.triangles = {{0, 1, 2}};
  return makeSnapshot(std::move(model), HierarchyKind::kNone);
}

TEST(MetricsText, EscapesAndWritesEveryNumber) {
  MetricsText out;
  out.single("hl_a_total", MetricType::kCounter, "A", 3);
  out.family("hl_b", MetricType::kGauge, "B");
  out.sample(0.1, {{"x", "a\"b\\c\nd"}, {"y", "2"}});
  out.sample(std::numeric_limits<double>::infinity());
  EXPECT_EQ(out.text(),
            "# HELP hl_a_total A\n# TYPE hl_a_total counter\nhl_a_total 3\n"
            "# HELP hl_b B\n# TYPE hl_b gauge\nhl_b{x=\"a\\\"b\\\\c\\nd\",y=\"2\"} 0.1\nhl_b +Inf\n");
}

TEST(RosMetrics, HaveEveryCount) {
  RosCounts counts;
  counts.running = true;
  counts.states = 1;
  counts.states_lost = 2;
  counts.received = {3, 4};
  counts.verdicts = {99, 5, 6, 7, 8};
  counts.ends = 9;
  counts.starts = 10;
  MetricsText out;
  writeRosMetrics(out, counts);
  expectPrometheus(out.text());
  for (const char* line :
       {"hl_ros_running 1", "hl_ros_states_total 1", "hl_ros_states_lost_total 2",
        "hl_ros_commands_total{topic=\"servo_cf\"} 3", "hl_ros_commands_total{topic=\"servo_cp\"} 4",
        "hl_ros_refused_total{reason=\"malformed\"} 5", "hl_ros_refused_total{reason=\"not_a_number\"} 6",
        "hl_ros_refused_total{reason=\"other_frame\"} 7", "hl_ros_refused_total{reason=\"stale\"} 8",
        "hl_ros_ends_total 9", "hl_ros_starts_total 10"})
    EXPECT_NE(out.text().find(std::string("\n") + line + "\n"), std::string::npos) << line;
}

TEST(ShareMetrics, DescribeTheWorldAndItsServers) {
  ShareView view{"lab", "anna", {}};
  view.starts = 3;
  view.counts.items = 12;
  view.counts.own_items = 5;
  view.counts.adopted = 2;
  view.counts.pushes_sent = 7;
  view.peers = {{"bert", 100.5, 75}};
  MetricsText out;
  writeShareMetrics(out, view);
  expectPrometheus(out.text());
  for (const char* line :
       {"hl_share_running 1", "hl_share_servers 1", "hl_share_objects 12", "hl_share_own_objects 5",
        "hl_share_starts_total 3", "hl_share_adopted_total 2", "hl_share_pushes_total{what=\"sent\"} 7",
        "hl_share_round_trip_seconds{server=\"bert\"} 0.1005", "hl_share_playout_seconds{server=\"bert\"} 0.075"})
    EXPECT_NE(out.text().find(std::string(line) + "\n"), std::string::npos) << line;
  view.ended = "hl-share has ended";
  MetricsText ended;
  writeShareMetrics(ended, view);
  EXPECT_NE(ended.text().find("hl_share_running 0\n"), std::string::npos);
}

TEST(ShareMetrics, HaveOneNumberOfServersThatHaveOneNameForAMoment) {
  ShareView view{"lab", "anna", {}};
  view.peers = {{"bert", 20, 75}, {"bert", 100, 50}};
  MetricsText out;
  writeShareMetrics(out, view);
  expectPrometheus(out.text());
  for (const char* line : {"hl_share_servers 2", "hl_share_round_trip_seconds{server=\"bert\"} 0.1",
                           "hl_share_playout_seconds{server=\"bert\"} 0.075"})
    EXPECT_NE(out.text().find(std::string(line) + "\n"), std::string::npos) << line;
}

TEST(ShareMetrics, HealthSaysWhenSharingHasEnded) {
  ShareView view{"lab", "anna", {}};
  std::string own_fault;
  MonitorCallbacks own;
  own.fault = [&own_fault] { return own_fault; };
  own.metrics = [](MetricsText& out) { out.single("hl_own", MetricType::kGauge, "Own", 42); };
  const MonitorCallbacks monitor = withShareMetrics(own, [&view] { return view; });
  EXPECT_EQ(monitor.fault(), "");
  view.ended = "hl-share has ended";
  EXPECT_EQ(monitor.fault(), "the world 'lab' is not shared: hl-share has ended");
  // What keeps the hand from its force is said first.
  own_fault = "the servo loop stands still";
  EXPECT_EQ(monitor.fault(), "the servo loop stands still");
  MetricsText out;
  monitor.metrics(out);
  EXPECT_NE(out.text().find("hl_own 42\n"), std::string::npos);
  EXPECT_NE(out.text().find("hl_share_running 0\n"), std::string::npos);
}

TEST(ShareMetrics, AServerThatSharesNoWorldHasNone) {
  MonitorCallbacks own;
  own.fault = [] { return std::string(); };
  own.metrics = [](MetricsText& out) { out.single("hl_own", MetricType::kGauge, "Own", 42); };
  const MonitorCallbacks monitor = withShareMetrics(own, {});
  MetricsText out;
  monitor.metrics(out);
  EXPECT_EQ(monitor.fault(), "");
  EXPECT_EQ(out.text().find("hl_share"), std::string::npos);
}

TEST(Monitor, HealthIsOkUntilThereIsAFault) {
  std::atomic<bool> broken{false};
  MonitorCallbacks monitor;
  monitor.fault = [&broken] { return std::string(broken ? "the \"servo\" stands still" : ""); };
  HttpServerSettings settings;
  settings.port = 0;
  settings.token = "correct-horse-battery";
  HttpServer server(settings, test::fakePages(), nullptr, monitor);
  server.start();
  // Whoever watches over the server needs no token for its health.
  auto response = test::request(server.port(), "/healthz");
  EXPECT_EQ(response.result_int(), 200u);
  EXPECT_EQ(response.body(), "{\"status\":\"ok\"}\n");
  EXPECT_EQ(test::request(server.port(), "/healthz", {}, test::http::verb::head).result_int(), 200u);
  broken = true;
  response = test::request(server.port(), "/healthz");
  EXPECT_EQ(response.result_int(), 503u);
  EXPECT_EQ(response.body(), "{\"status\":\"fault\",\"reason\":\"the \\\"servo\\\" stands still\"}\n");
}

TEST(Monitor, MetricsWantTheTokenAndCountWhatHappens) {
  HttpServerSettings settings;
  settings.port = 0;
  settings.token = "correct-horse-battery";
  MonitorCallbacks monitor;
  monitor.metrics = [](MetricsText& out) { out.single("hl_own", MetricType::kGauge, "Own", 42); };
  HttpServer server(settings, test::fakePages(), nullptr, monitor);
  server.start();
  EXPECT_EQ(test::request(server.port(), "/metrics").result_int(), 401u);
  EXPECT_EQ(test::request(server.port(), "/", {{test::http::field::host, "evil.example"}}).result_int(), 403u);
  const auto response =
      test::request(server.port(), "/metrics", {{test::http::field::authorization, "Bearer correct-horse-battery"}});
  EXPECT_EQ(response.result_int(), 200u);
  expectPrometheus(response.body());
  EXPECT_NE(response.body().find("\nhl_own 42\n"), std::string::npos);
  EXPECT_NE(response.body().find("\nhl_connections 1\n"), std::string::npos);
  EXPECT_NE(response.body().find("\nhl_refused_total{reason=\"access\"} 2\n"), std::string::npos) << response.body();
}

TEST(Monitor, ATouchSessionIsHealthyWhileItsLoopsRun) {
  TouchSession session(oneTriangle(), {});
  HttpServerSettings settings;
  settings.port = 0;
  HttpServer server(settings, makeViewerFeed(session, "test"), nullptr, makeTouchMonitor(session));
  session.start();
  server.start();
  const auto response = test::request(server.port(), "/metrics");
  expectPrometheus(response.body());
  for (const char* line :
       {"\nhl_scene_primitives 1\n", "\nhl_loop_steps_total{loop=\"servo\"} ",
        "\nhl_loop_work_seconds{loop=\"proxy\",quantile=\"0.999\"} ", "\nhl_safety_state{state=\"on\"} ",
        "\nhl_ledger_injected_joules_total ", "\nhl_bytes_total{direction=\"in\"} "}) {
    EXPECT_NE(response.body().find(line), std::string::npos) << line;
  }
  // Each ending is there from the start, so that a rate of it can be asked for.
  for (std::size_t i = 0; i < kEndings; ++i) {
    const auto ending = static_cast<Ending>(i);
    const std::string line = std::string("\nhl_ticks_ended_total{ending=\"") + nameOf(ending) + "\"} ";
    EXPECT_EQ(response.body().find(line) != std::string::npos, ending != Ending::kGoesOn) << line;
  }
  EXPECT_EQ(test::request(server.port(), "/healthz").result_int(), 200u);
  // Loops that have ended stand still, and that is noticed without anybody asking in between.
  session.stop();
  while (test::request(server.port(), "/healthz").result_int() != 503u) std::this_thread::yield();
  EXPECT_NE(test::request(server.port(), "/healthz").body().find("stands still"), std::string::npos);
}

TEST(Monitor, NumbersOfClientsAreThereWhereAServerTakesThem) {
  TouchServer clients(makeSnapshot(std::vector<Instance>{}), {});
  HttpServerSettings settings;
  settings.port = 0;
  HttpServer server(settings, test::fakePages(), nullptr, makeTouchMonitor(clients.device(), &clients));
  server.start();
  const auto response = test::request(server.port(), "/metrics");
  expectPrometheus(response.body());
  EXPECT_NE(response.body().find("\nhl_hierarchy_refits_total 0\n"), std::string::npos);
  EXPECT_NE(response.body().find("\nhl_memory_limit_bytes "), std::string::npos);
  EXPECT_NE(response.body().find("\nhl_hierarchy_rebuilds_total 0\n"), std::string::npos);
}

TEST(EventLog, OneLineInEitherForm) {
  const LogFields fields = {{"peer", "[::1]:5000"}, {"reason", "two words"}, {"name", "a\"b\\c\nd\x01"}, {"none", ""}};
  EXPECT_EQ(formatEvent(LogFormat::kKeyValue, "session_end", fields),
            "event=session_end peer=[::1]:5000 reason=\"two words\" name=\"a\\\"b\\\\c\\u000ad\\u0001\" none=\"\"");
  EXPECT_EQ(formatEvent(LogFormat::kJson, "session_end", fields),
            "\"event\":\"session_end\",\"peer\":\"[::1]:5000\",\"reason\":\"two words\","
            "\"name\":\"a\\\"b\\\\c\\u000ad\\u0001\",\"none\":\"\"");
  // A name that would turn the direction of the line.
  const LogFields turned = {{"name", "a\xe2\x80\xaez\xf3\xa0\x81\x81"}};
  EXPECT_EQ(formatEvent(LogFormat::kKeyValue, "upload", turned), "event=upload name=\"a\\u202ez\\udb40\\udc41\"");
  EXPECT_EQ(jsonString("é\xff"), "\"é?\"");
}

}  // namespace
}  // namespace hl::test_monitor
