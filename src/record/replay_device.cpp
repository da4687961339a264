#include "record/replay_device.h"

#include "base/error.h"
#include "device/open_device.h"
#include "io/value_messages.h"
#include "record/recorded_servo.h"
#include "record/recorded_stylus.h"
#include "record/recording_file.h"

namespace hl {

namespace {

constexpr const char* kReplayPrefix = "replay:";

// As the device was that was recorded.
DeviceInfo infoOf(const proto::RecordingStart& start) {
  DeviceInfo info;
  readValues(start.device(), "the device", info, laterOfDevice());
  checkRecorded(info);
  info.name = "replay of " + start.device_name();
  info.friction_N = 0;  // no hand feels it: it takes up nothing
  return info;
}

// The samples that were good, by rising time, the first at 0.
std::vector<DeviceSample> samplesOf(RecordingReader& reader) {
  std::vector<DeviceSample> samples;
  proto::RecordingBlock block;
  while (reader.next(block)) {
    if (!block.has_steps()) continue;
    for (const ServoRecord& step : fromProto(block.steps())) {
      const bool good = step.sample.status == DeviceStatus::kOk && step.sample.position.allFinite();
      if (good) checkTime(step.sample.time_ns, "a step");
      if (good && (samples.empty() || step.sample.time_ns > samples.back().time_ns)) samples.push_back(step.sample);
    }
  }
  if (samples.size() < 2) throw Error("has no movement to be replayed");
  const std::int64_t first_ns = samples.front().time_ns;
  for (DeviceSample& sample : samples) sample.time_ns -= first_ns;
  checkTime(samples.back().time_ns, "the end of the movement");
  return samples;
}

}  // namespace

void ReplayDevice::open() {
  RecordingReader reader(file_);
  try {
    info_ = infoOf(startOf(reader));
    samples_ = samplesOf(reader);
  } catch (const Error& error) {
    throw Error(file_ + ": " + error.what());
  }
}

// The moment goes up and down through the recording; the sample before it is never far from the last one asked for.
DeviceSample ReplayDevice::read(std::int64_t now_ns) {
  if (!begun_) begin_ns_ = now_ns;
  begun_ = true;
  const std::int64_t length_ns = samples_.back().time_ns;
  const std::int64_t lap_ns = (now_ns - begin_ns_) % (2 * length_ns);
  const std::int64_t moment_ns = lap_ns <= length_ns ? lap_ns : 2 * length_ns - lap_ns;
  while (at_ + 2 < samples_.size() && samples_[at_ + 1].time_ns <= moment_ns) ++at_;
  while (at_ > 0 && samples_[at_].time_ns > moment_ns) --at_;
  const DeviceSample &a = samples_[at_], &b = samples_[at_ + 1];
  const double part = static_cast<double>(moment_ns - a.time_ns) / static_cast<double>(b.time_ns - a.time_ns);
  DeviceSample sample = part < 1 ? a : b;
  if (part > 0 && part < 1) sample.position = a.position + part * (b.position - a.position);
  sample.time_ns = now_ns;
  sample.weight_N = Vec3::Zero();
  sample.age_ns = 0;
  return sample;
}

std::string replayedFile(const std::string& spec) {
  return spec.starts_with(kReplayPrefix) ? spec.substr(std::string(kReplayPrefix).size()) : "";
}

std::unique_ptr<Device> makeAnyDevice(const std::string& spec) {
  if (!spec.starts_with(kReplayPrefix)) return makeDevice(spec);
  const std::string file = replayedFile(spec);
  if (file.empty()) throw Error("replay: which file? Write replay:FILE, of hl record");
  return std::make_unique<ReplayDevice>(file);
}

std::unique_ptr<Device> openAnyDevice(const std::string& spec) {
  std::unique_ptr<Device> device = makeAnyDevice(spec);
  device->open();
  return device;
}

std::string anyDeviceSpecs() { return deviceSpecs() + "|" + kReplayPrefix + "FILE"; }

}  // namespace hl
