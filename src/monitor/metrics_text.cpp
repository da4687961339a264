#include "monitor/metrics_text.h"

#include <fmt/core.h>

#include <cmath>
#include <iterator>

namespace hl {

namespace {

void appendEscaped(std::string& out, std::string_view value) {
  for (const char c : value) {
    if (c == '\\' || c == '"') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
}

std::string numberOf(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  return fmt::format("{}", value);
}

}  // namespace

void MetricsText::family(std::string_view name, MetricType type, std::string_view help) {
  name_ = name;
  fmt::format_to(std::back_inserter(text_), "# HELP {} {}\n# TYPE {} {}\n", name, help, name,
                 type == MetricType::kGauge ? "gauge" : "counter");
}

void MetricsText::sample(double value, Labels labels) {
  text_ += name_;
  char before = '{';
  const auto add = [&](std::string_view label, std::string_view content) {
    text_ += before;
    text_ += label;
    text_ += "=\"";
    appendEscaped(text_, content);
    text_ += '"';
    before = ',';
  };
  if (!device_.empty()) add("device", device_);
  for (const auto& [label, content] : labels) add(label, content);
  if (before == ',') text_ += '}';
  text_ += ' ' + numberOf(value) + '\n';
}

void MetricsText::single(std::string_view name, MetricType type, std::string_view help, double value) {
  family(name, type, help);
  sample(value);
}

}  // namespace hl
