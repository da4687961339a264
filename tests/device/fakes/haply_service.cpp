#include "device/fakes/haply_service.h"

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <boost/json/parse.hpp>
#include <boost/json/serialize.hpp>
#include <boost/json/value.hpp>
#include <boost/json/value_to.hpp>

namespace hl::test {

namespace beast = boost::beast;
namespace http = beast::http;
namespace json = boost::json;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;

namespace {

const double kCentre[3] = {0, -0.14, 0.2};  // of D's origin in the service's frame

json::object vectorOf(const Vec3& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

}  // namespace

HaplyService::HaplyService(const std::vector<FakeArm*>& arms, const std::string& version)
    : arms_(arms),
      version_(version),
      vector_(version >= "3.5"),
      acceptor_(context_, {boost::asio::ip::address_v4::loopback(), 0}),
      port_(acceptor_.local_endpoint().port()),
      thread_([this] { run(); }) {}

HaplyService::~HaplyService() {
  ending_ = true;
  boost::system::error_code ignored;
  tcp::socket(context_).connect({boost::asio::ip::address_v4::loopback(), port_}, ignored);  // wakes accept()
  thread_.join();
}

// Of several arms one that is lost is no longer reported; without the only one there is no service.
bool HaplyService::lost() const { return arms_.size() == 1 && arms_[0]->lost; }

void HaplyService::run() {
  std::vector<std::thread> clients;
  while (!ending_) {
    tcp::socket socket(context_);
    boost::system::error_code error;
    acceptor_.accept(socket, error);
    if (error || ending_ || lost()) continue;
    clients.emplace_back([this, of = std::move(socket)]() mutable {
      try {
        serve(std::move(of));
      } catch (const boost::system::system_error&) {
        // The client has left.
      }
    });
  }
  for (std::thread& client : clients) client.join();
}

void HaplyService::serve(tcp::socket socket) {
  beast::flat_buffer buffer;
  http::request<http::empty_body> request;
  http::read(socket, buffer, request);
  if (websocket::is_upgrade(request)) {
    websocket::stream<tcp::socket> stream(std::move(socket));
    stream.accept(request);
    simulate(stream);
    return;
  }
  const bool asked = request.target() == "/version";
  http::response<http::string_body> response(asked ? http::status::ok : http::status::not_found, 11);
  response.body() = asked ? "{\"version\":\"" + version_ + "\"}" : "";
  response.prepare_payload();
  http::write(socket, response);
}

template <typename Socket>
void HaplyService::simulate(Socket& socket) {
  std::set<FakeArm*> moved;
  try {
    socket.text(true);
    socket.write(boost::asio::buffer(state(true)));
    while (!ending_ && !lost()) {
      beast::flat_buffer buffer;
      socket.read(buffer);
      obey(beast::buffers_to_string(buffer.data()), moved);
      if (!silent) socket.write(boost::asio::buffer(state(false)));
    }
  } catch (const boost::system::system_error&) {
    // The client has left.
  }
  for (FakeArm* arm : moved) arm->pull(Vec3::Zero());
}

// The service's frame: x to the right, y forward, z up.
void HaplyService::obey(const std::string& text, std::set<FakeArm*>& moved) {
  const json::value message = json::parse(text);
  if (message.as_object().contains("session")) ++introductions;
  const json::value& device = message.at("inverse3").at(0);
  const std::string id = json::value_to<std::string>(device.at("device_id"));
  std::size_t number = 0;
  while (number < arms_.size() && id != kIds[number]) ++number;
  if (number == arms_.size() || arms_[number]->lost) return;
  const json::object& force = device.at("commands").at("set_cursor_force").as_object();
  const json::value* components = force.if_contains(vector_ ? "vector" : "values");
  if (components == nullptr) return;
  const auto part = [components](const char* name) { return components->at(name).to_number<double>(); };
  arms_[number]->pull({part("x"), part("z"), -part("y")});
  moved.insert(arms_[number]);
}

std::string HaplyService::state(bool inventory) {
  json::array devices, grips;
  for (std::size_t number = 0; has_device && number < arms_.size(); ++number) {
    FakeArm& arm = *arms_[number];
    if (arms_.size() > 1 && arm.lost) continue;
    const Vec3 tip = arm.encoders();
    const Vec3 cursor(tip.x() + kCentre[0], -tip.z() + kCentre[1], tip.y() + kCentre[2]);
    json::object device{{"device_id", kIds[number]}, {"state", json::object{{"cursor_position", vectorOf(cursor)}}}};
    device["status"] = json::object{{"calibrated", !arm.not_ready}};
    devices.push_back(device);
    json::object buttons;
    for (unsigned i = 0; i < 3; ++i) {
      const std::string name = vector_ ? std::string(1, static_cast<char>('a' + i)) : "button_" + std::to_string(i);
      buttons[name] = (arm.buttons >> i & 1U) != 0;
    }
    const Eigen::Quaterniond turned = arm.turned_D();
    json::object orientation = vectorOf({turned.x(), -turned.z(), turned.y()});
    orientation["w"] = turned.w();
    const json::object grip_state{{"buttons", buttons}, {"orientation", orientation}};
    grips.push_back(json::object{{"device_id", "6154" + std::to_string(number)}, {"state", grip_state}});
  }
  json::object message{{"inverse3", devices}, {"wireless_verse_grip", grips}};
  if (inventory) message["session_id"] = 1;
  return json::serialize(message);
}

}  // namespace hl::test
