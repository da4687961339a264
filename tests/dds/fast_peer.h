// FastPeer: the other side of the wire, by Fast DDS, another implementation than that of hl-ros. It knows names of
// types alone, and hears and says the bytes of samples as they are on the wire.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hl::test {

/// A sample, with the four bytes of the encapsulation in front.
using Payload = std::vector<std::uint8_t>;

enum class Reliability { kBestEffort, kReliable };

class FastReader {
 public:
  virtual ~FastReader() = default;
  virtual bool matched() const = 0;
  /// The next one that has come, without waiting.
  virtual std::optional<Payload> take() = 0;
};

class FastWriter {
 public:
  virtual ~FastWriter() = default;
  virtual bool matched() const = 0;
  /// As one that was written `age_ns` ago.
  virtual void write(const Payload& payload, std::int64_t age_ns = 0) = 0;
};

/// As a participant of ROS 2 is by default; or with ROS_LOCALHOST_ONLY=1, which keeps it to 127.0.0.1;
/// or by UDP alone, as to another machine.
enum class Reach { kUsual, kLoopback, kUdp };

/// A participant. Its readers and writers end before it.
class FastPeer {
 public:
  /// `enclave`: a folder of SROS2, for DDS Security; empty: without.
  explicit FastPeer(std::uint32_t domain, Reach reach = Reach::kUsual, const std::string& enclave = {});
  ~FastPeer();
  FastPeer(const FastPeer&) = delete;
  FastPeer& operator=(const FastPeer&) = delete;

  std::unique_ptr<FastReader> reader(const std::string& topic, const std::string& type, Reliability reliability);
  std::unique_ptr<FastWriter> writer(const std::string& topic, const std::string& type, Reliability reliability);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hl::test
