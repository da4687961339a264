// Events of the server for people and programs that watch it: one line each, as key=value or as JSON, through spdlog.
// Without an event log, as in `hl touch` and in the tests, nothing is written.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace hl {

enum class LogFormat : std::uint8_t { kKeyValue, kJson };
enum class LogLevel : std::uint8_t { kDebug, kInfo, kWarning, kError };

/// From now on events of `level` and above go to stderr. Setup only, once.
void openEventLog(LogFormat format, LogLevel level);

using LogFields = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// `event` and the keys are [a-z_]+; the values may be anything. Any thread but the real-time ones.
void logEvent(LogLevel level, std::string_view event, LogFields fields = {});

/// The event's own part of a line, without time and level.
std::string formatEvent(LogFormat format, std::string_view event, LogFields fields);

/// `text` as a JSON string, with its quotes.
std::string jsonString(std::string_view text);

}  // namespace hl
