// MetricsText: numbers in the text form that Prometheus reads (exposition format 0.0.4).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace hl {

enum class MetricType : std::uint8_t { kGauge, kCounter };

class MetricsText {
 public:
  using Labels = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  /// Begins a family; its samples follow. `name` is [a-z_]+ with the unit at the end; `help` is one line.
  void family(std::string_view name, MetricType type, std::string_view help);
  /// One number of the family begun last.
  void sample(double value, Labels labels = {});
  /// A label that all samples have from now on, until it is empty: those of one device of several.
  void setDevice(std::string device) { device_ = std::move(device); }
  /// A family of one number.
  void single(std::string_view name, MetricType type, std::string_view help, double value);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::string name_;
  std::string device_;
};

}  // namespace hl
