#include "monitor/event_log.h"

#include <fmt/core.h>
#include <google/protobuf/stubs/logging.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "base/guarded_thread.h"
#include "base/utf8.h"

namespace hl {

namespace {

struct EventLog {
  LogFormat format = LogFormat::kKeyValue;
  std::shared_ptr<spdlog::logger> logger;
};

EventLog& eventLog() {
  static EventLog log;
  return log;
}

spdlog::level::level_enum levelOf(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return spdlog::level::debug;
    case LogLevel::kInfo:
      return spdlog::level::info;
    case LogLevel::kWarning:
      return spdlog::level::warn;
    case LogLevel::kError:
      break;
  }
  return spdlog::level::err;
}

// A bare word stays as it is; all else is quoted, so that a line has no two meanings and stays one line.
std::string keyValueText(std::string_view value) {
  const bool bare = !value.empty() && value.find_first_of(" \"=\\") == std::string_view::npos;
  const std::vector<std::uint32_t> points = codePointsOf(value);
  if (std::any_of(points.begin(), points.end(), isHidden)) return jsonString(value);
  return bare ? std::string(value) : jsonString(value);
}

// As JSON has it: beyond 16 bits in two halves.
std::string escaped(std::uint32_t point) {
  constexpr std::uint32_t kBeyond = 0x10000;
  if (point < kBeyond) return fmt::format("\\u{:04x}", point);
  return fmt::format("\\u{:04x}\\u{:04x}", 0xd800 + (point - kBeyond) / 0x400, 0xdc00 + (point - kBeyond) % 0x400);
}

}  // namespace

std::string jsonString(std::string_view text) {
  std::string out = "\"";
  for (const std::uint32_t point : codePointsOf(text)) {
    if (point == '"' || point == '\\') out += '\\';
    out += isHidden(point) ? escaped(point) : utf8Of({point});
  }
  return out + '"';
}

std::string formatEvent(LogFormat format, std::string_view event, LogFields fields) {
  const bool json = format == LogFormat::kJson;
  std::string line = json ? "\"event\":" + jsonString(event) : "event=" + std::string(event);
  for (const auto& [key, value] : fields) {
    if (json) {
      line += ",\"" + std::string(key) + "\":" + jsonString(value);
    } else {
      line += ' ' + std::string(key) + '=' + keyValueText(value);
    }
  }
  return line;
}

void openEventLog(LogFormat format, LogLevel level) {
  EventLog& log = eventLog();
  log.format = format;
  log.logger = std::make_shared<spdlog::logger>("hl", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  log.logger->set_pattern(format == LogFormat::kJson ? R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l",%v})"
                                                     : "time=%Y-%m-%dT%H:%M:%S.%e%z level=%l %v");
  log.logger->set_level(levelOf(level));
  log.logger->flush_on(spdlog::level::debug);
  setReportFailure([](const char* thread, const char* what) {
    logEvent(LogLevel::kError, "work_failed", {{"thread", thread}, {"reason", what}});
  });
  // What protobuf says of a client's garbage is no line of this log's form, and the refusal is logged anyway.
  google::protobuf::SetLogHandler([](google::protobuf::LogLevel, const char*, int, const std::string& text) {
    logEvent(LogLevel::kDebug, "protobuf", {{"text", text}});
  });
}

void logEvent(LogLevel level, std::string_view event, LogFields fields) {
  const EventLog& log = eventLog();
  if (log.logger == nullptr || !log.logger->should_log(levelOf(level))) return;
  log.logger->log(levelOf(level), "{}", formatEvent(log.format, event, fields));
}

}  // namespace hl
