#include "line/orders.h"

#include <charconv>
#include <sstream>
#include <string>

#include "base/error.h"

namespace hl::line {

namespace {

constexpr double kMaxDelay_ms = 10'000, kMaxRate_Mbit_s = 1e6;

// "nan" and "inf" are out of range.
double number(const std::string& name, const std::string& text, double least, double most) {
  double value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last || !(value >= least && value <= most)) {
    std::ostringstream message;
    message << name << " wants a number from " << least << " to " << most << ", not '" << text << "'";
    throw Error(message.str());
  }
  return value;
}

int endOf(const std::string& name, const std::string& text, int ends) {
  const double value = number(name, text, 1, ends);
  const int end = static_cast<int>(value);
  if (end != value) throw Error(name + " wants the number of an end, not '" + text + "'");
  return end;
}

bool switchOf(const std::string& name, const std::string& text) {
  if (text != "on" && text != "off") throw Error(name + " wants on or off, not '" + text + "'");
  return text == "on";
}

void addWord(Order& order, const std::string& name, const std::string& value, int ends) {
  if (name == "from") {
    order.from = endOf(name, value, ends);
  } else if (name == "to") {
    order.to = endOf(name, value, ends);
  } else if (name == "delay") {
    order.delay_ms = number(name, value, 0, kMaxDelay_ms);
  } else if (name == "jitter") {
    order.jitter_ms = number(name, value, 0, kMaxDelay_ms);
  } else if (name == "loss") {
    order.loss_percent = number(name, value, 0, 100);
  } else if (name == "rate") {
    order.rate_Mbit_s = number(name, value, 0, kMaxRate_Mbit_s);
  } else if (name == "reorder") {
    order.reorder = switchOf(name, value);
  } else {
    throw Error("'" + name +
                "' is no word of an order: from, to, delay, jitter, loss, rate, reorder, cut, mend, multicast, count");
  }
}

}  // namespace

Order orderOf(std::string_view text, int ends) {
  std::istringstream words{std::string(text)};
  Order order;
  std::string name, value;
  if (!(words >> name)) throw Error("an empty order");
  if (name == "count" || name == "cut" || name == "mend" || name == "multicast") {
    if (name != "count") words >> value;
    if (name == "count") {
      order.kind = OrderKind::kCount;
    } else if (name == "multicast") {
      order.kind = OrderKind::kMulticast;
      order.multicast = switchOf(name, value);
    } else {
      order.kind = name == "cut" ? OrderKind::kCut : OrderKind::kMend;
      order.end = endOf(name, value, ends);
    }
    if (words >> value) throw Error("'" + value + "' is too much for " + name);
    return order;
  }
  do {
    value.clear();
    words >> value;
    addWord(order, name, value, ends);
  } while (words >> name);
  return order;
}

LinkSettings changed(LinkSettings settings, const Order& order) {
  settings.delay_ms = order.delay_ms.value_or(settings.delay_ms);
  settings.jitter_ms = order.jitter_ms.value_or(settings.jitter_ms);
  settings.loss_percent = order.loss_percent.value_or(settings.loss_percent);
  settings.rate_Mbit_s = order.rate_Mbit_s.value_or(settings.rate_Mbit_s);
  settings.reorder = order.reorder.value_or(settings.reorder);
  if (settings.jitter_ms > settings.delay_ms)
    throw Error("jitter above the delay would be a packet before it was sent");
  return settings;
}

}  // namespace hl::line
