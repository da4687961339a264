#include "dds/fast_peer.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <map>
#include <stdexcept>

namespace hl::test {

namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::SerializedPayload_t;

// Of any name; its samples are their own bytes.
class BytesType final : public dds::TopicDataType {
 public:
  explicit BytesType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 4096;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const Payload& bytes = *static_cast<const Payload*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    static_cast<Payload*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<const Payload*>(data)->size()); };
  }
  void* createData() override { return new Payload; }
  void deleteData(void* data) override { delete static_cast<Payload*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

template <typename Qos>
void setReliability(Qos& qos, Reliability reliability) {
  qos.reliability().kind =
      reliability == Reliability::kReliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
}

// As rmw_fastrtps does it for ROS_SECURITY_ENABLE.
void addSecurity(dds::DomainParticipantQos& qos, const std::string& enclave) {
  const auto add = [&](const char* name, const std::string& value) {
    qos.properties().properties().emplace_back(name, value);
  };
  add("dds.sec.auth.plugin", "builtin.PKI-DH");
  add("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
  add("dds.sec.access.plugin", "builtin.Access-Permissions");
  for (const auto& [name, file] : std::map<std::string, std::string>{
           {"identity_ca", "identity_ca.cert.pem"}, {"identity_certificate", "cert.pem"}, {"private_key", "key.pem"}})
    add(("dds.sec.auth.builtin.PKI-DH." + name).c_str(), "file://" + enclave + '/' + file);
  for (const auto& [name, file] : std::map<std::string, std::string>{{"permissions_ca", "permissions_ca.cert.pem"},
                                                                     {"governance", "governance.p7s"},
                                                                     {"permissions", "permissions.p7s"}})
    add(("dds.sec.access.builtin.Access-Permissions." + name).c_str(), "file://" + enclave + '/' + file);
}

dds::DomainParticipantQos participantQos(Reach reach, const std::string& enclave) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  if (!enclave.empty()) addSecurity(qos, enclave);
  if (reach == Reach::kUsual) return qos;
  const auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  if (reach == Reach::kLoopback) transport->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(transport);
  return qos;
}

template <typename Entity>
Entity* there(Entity* entity) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS refuses an entity of the test");
  return entity;
}

}  // namespace

struct FastPeer::Parts {
  Parts(std::uint32_t domain, Reach reach, const std::string& enclave)
      : participant(there(
            dds::DomainParticipantFactory::get_instance()->create_participant(domain, participantQos(reach, enclave)))),
        publisher(there(participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT))),
        subscriber(there(participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT))) {}
  ~Parts() {
    participant->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
  }
  dds::Topic* topic(const std::string& name, const std::string& type) {
    dds::Topic*& topic = topics[name];
    if (topic != nullptr) return topic;
    dds::TypeSupport(new BytesType(type)).register_type(participant);
    return topic = there(participant->create_topic(name, type, dds::TOPIC_QOS_DEFAULT));
  }

  dds::DomainParticipant* participant;
  dds::Publisher* publisher;
  dds::Subscriber* subscriber;
  std::map<std::string, dds::Topic*> topics;
};

namespace {

class OwnedReader final : public FastReader {
 public:
  OwnedReader(dds::Subscriber* subscriber, dds::DataReader* reader) : subscriber_(subscriber), reader_(reader) {}
  ~OwnedReader() override { subscriber_->delete_datareader(reader_); }
  bool matched() const override {
    dds::SubscriptionMatchedStatus status;
    reader_->get_subscription_matched_status(status);
    return status.current_count > 0;
  }
  std::optional<Payload> take() override {
    Payload payload;
    dds::SampleInfo info;
    while (reader_->take_next_sample(&payload, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) return payload;
    }
    return std::nullopt;
  }

 private:
  dds::Subscriber* subscriber_;
  dds::DataReader* reader_;
};

class OwnedWriter final : public FastWriter {
 public:
  OwnedWriter(dds::Publisher* publisher, dds::DataWriter* writer) : publisher_(publisher), writer_(writer) {}
  ~OwnedWriter() override { publisher_->delete_datawriter(writer_); }
  bool matched() const override {
    dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count > 0;
  }
  void write(const Payload& payload, std::int64_t age_ns) override {
    Payload bytes = payload;
    eprosima::fastrtps::Time_t time;
    eprosima::fastrtps::Time_t::now(time);
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    const std::int64_t then_ns = time.to_ns() - age_ns;
    time = {static_cast<std::int32_t>(then_ns / kSecond_ns), static_cast<std::uint32_t>(then_ns % kSecond_ns)};
    writer_->write_w_timestamp(&bytes, dds::HANDLE_NIL, time);
  }

 private:
  dds::Publisher* publisher_;
  dds::DataWriter* writer_;
};

}  // namespace

FastPeer::FastPeer(std::uint32_t domain, Reach reach, const std::string& enclave)
    : parts_(std::make_unique<Parts>(domain, reach, enclave)) {}
FastPeer::~FastPeer() = default;

std::unique_ptr<FastReader> FastPeer::reader(const std::string& topic, const std::string& type,
                                             Reliability reliability) {
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  setReliability(qos, reliability);
  dds::DataReader* const made = there(parts_->subscriber->create_datareader(parts_->topic(topic, type), qos));
  return std::make_unique<OwnedReader>(parts_->subscriber, made);
}

std::unique_ptr<FastWriter> FastPeer::writer(const std::string& topic, const std::string& type,
                                             Reliability reliability) {
  dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
  setReliability(qos, reliability);
  dds::DataWriter* const made = there(parts_->publisher->create_datawriter(parts_->topic(topic, type), qos));
  return std::make_unique<OwnedWriter>(parts_->publisher, made);
}

}  // namespace hl::test
