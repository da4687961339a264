// HaplyService: a stand-in for Haply's Inverse Service on a free port, with one or two simulated arms behind
// it, and a grip for each. It answers one state for each message, takes forces in one dialect only, serves several
// clients at once, and lets go of the arms that a client has moved when it leaves.
#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "device/fakes/fake_arm.h"

namespace hl::test {

class HaplyService {
 public:
  /// `version` as given at /version. From 3.5 on forces are "vector" and buttons a, b, c; before "values", button_0...
  HaplyService(FakeArm& arm, const std::string& version) : HaplyService(std::vector<FakeArm*>{&arm}, version) {}
  HaplyService(const std::vector<FakeArm*>& arms, const std::string& version);
  ~HaplyService();
  static constexpr const char* kIds[] = {"049D", "04A1"};
  std::string url() const { return "ws://127.0.0.1:" + std::to_string(port_); }

  std::atomic<bool> silent{false};     ///< takes messages and answers nothing
  std::atomic<bool> has_device{true};  ///< an Inverse3 is plugged in
  std::atomic<int> introductions{0};   ///< first messages that said who the client is

 private:
  void run();
  void serve(boost::asio::ip::tcp::socket socket);
  template <typename Socket>
  void simulate(Socket& socket);
  void obey(const std::string& message, std::set<FakeArm*>& moved);
  std::string state(bool inventory);
  bool lost() const;

  const std::vector<FakeArm*> arms_;
  const std::string version_;
  const bool vector_;
  boost::asio::io_context context_;
  boost::asio::ip::tcp::acceptor acceptor_;
  std::uint16_t port_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace hl::test
