// What hl-share hears from others that do not keep to its type: it is left out and counted, and what comes after is
// heard.
#include <gtest/gtest.h>
#include <other_packet.h>
#include <share.h>
#include <unistd.h>

#include "dds/dds_node.h"
#include "share/share_process.h"
#include "wait_for.h"

namespace hl::test_share_wire {
namespace {

constexpr std::uint32_t kDomain = 42;
constexpr ServerId kHere = 1, kOther = 2;

class ShareWire : public testing::Test {
 protected:
  dds_entity_t writer(const dds_topic_descriptor_t& type) {
    const std::string topic = shareTopic(world_, Lane::kStream);
    const Qos qos = emptyQos();
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, 0);
    return made(
        dds_create_writer(node_.participant(),
                          made(dds_create_topic(node_.participant(), &type, topic.c_str(), nullptr, nullptr), "topic"),
                          qos.get(), nullptr),
        "writer");
  }
  // The next packet, of what is written until one comes.
  template <typename Write>
  SharePacket heardOf(const Write& write) {
    std::optional<SharePacket> packet;
    test::waitFor([&] {
      write();
      packet = process_.receive();
      return packet.has_value();
    });
    return *packet;
  }
  SharePacket heardOfBytes(dds_entity_t writer, std::string bytes) {
    hl_share_Packet packet{};
    packet.server = kOther;
    packet.key = 7;
    packet.bytes._length = packet.bytes._maximum = static_cast<std::uint32_t>(bytes.size());
    packet.bytes._buffer = reinterpret_cast<std::uint8_t*>(bytes.data());
    return heardOf([&] { dds_write(writer, &packet); });
  }

  const std::string world_ = "wire_" + std::to_string(getpid());
  ShareProcess process_{ShareTask{HL_VERSION, kDomain, world_, kHere, {}}};
  DdsNode node_{{"test", kDomain, {}}, [] {}};
};

TEST_F(ShareWire, WhatIsNoPacketIsCountedAsAnEmptyOne) {
  dds_topic_descriptor_t type = hl_test_OtherPacket_desc;
  type.m_typename = hl_share_Packet_desc.m_typename;
  const dds_entity_t others = writer(type);
  const hl_test_OtherPacket other{kOther, 7};
  const SharePacket heard = heardOf([&] { dds_write(others, &other); });
  EXPECT_EQ(heard.lane, Lane::kStream);
  EXPECT_TRUE(heard.bytes.empty());
}

TEST_F(ShareWire, WhatIsTooLongIsCountedAsAnEmptyOneAndTheLongestIsHeard) {
  const dds_entity_t packets = writer(hl_share_Packet_desc);
  EXPECT_TRUE(heardOfBytes(packets, std::string(kMaxPacket_bytes + 1, 'x')).bytes.empty());
  const std::string longest(kMaxPacket_bytes, 'y');
  test::waitFor([&] {
    const SharePacket heard = heardOfBytes(packets, longest);
    return heard.key == 7 && heard.bytes == longest;
  });
}

}  // namespace
}  // namespace hl::test_share_wire
