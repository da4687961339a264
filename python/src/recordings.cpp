// Recordings (docs/recording.md) as arrays: what they hold, one row for each step of the servo and each tick.
#include <pybind11/numpy.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bindings.h"
#include "control/servo_target.h"
#include "other_threads_run.h"
#include "record/recorded_servo.h"
#include "record/recorded_ticks.h"
#include "record/recording_file.h"

namespace py = pybind11;

namespace {

using Numbers = double[3];

/// One step of the servo, device frame.
struct StepRow {
  double t;               ///< s since the recording began, of the sample
  Numbers finger, proxy;  ///< m; `proxy`: where the spring pulls to, without the surface's stiffness
  double stiffness;       ///< 0..1, of the target
  Numbers force;          ///< N
  std::int64_t work_ns;   ///< from the sample to the end of the step
  std::uint32_t buttons;
  std::uint8_t touching;  ///< 1: there is a target
  std::uint8_t state, fault;
  double rotation[4];  ///< of the stylus, x y z w
  Numbers spin;        ///< rad/s
  double gripper;      ///< rad
};

/// One tick.
struct TickRow {
  double t;
  Numbers finger, target;  ///< m, device frame
  Numbers proxy;           ///< m, world frame
  std::uint64_t scene;
  std::int64_t work_ns;
  std::uint32_t contacts;
  std::uint8_t touching;
};

void copyTo(Numbers& to, const hl::Vec3& from) { std::copy_n(from.data(), 3, to); }

StepRow rowOf(const hl::ServoRecord& record, std::int64_t begin_ns) {
  StepRow row{};
  row.t = hl::age_s(record.sample.time_ns, begin_ns);
  copyTo(row.finger, record.sample.position);
  copyTo(row.proxy, record.target.proxy_D);
  copyTo(row.force, record.out.force_N);
  row.stiffness = record.target.stiffness;
  row.work_ns = record.work_ns;
  row.buttons = record.sample.buttons;
  row.touching = record.target.valid ? 1 : 0;
  row.state = static_cast<std::uint8_t>(record.out.safety);
  row.fault = static_cast<std::uint8_t>(record.out.fault);
  std::copy_n(record.sample.stylus.turned.coeffs().data(), 4, row.rotation);
  copyTo(row.spin, record.sample.stylus.spin_rad_s);
  row.gripper = record.sample.stylus.gripper_rad;
  return row;
}

TickRow rowOf(const hl::TickRecord& record, std::int64_t begin_ns) {
  TickRow row{};
  row.t = hl::age_s(record.in.time_ns, begin_ns);
  copyTo(row.finger, record.in.finger_D);
  copyTo(row.target, record.target.proxy_D);
  copyTo(row.proxy, record.proxy);
  row.scene = record.scene;
  row.work_ns = record.work_ns;
  row.contacts = static_cast<std::uint32_t>(record.contacts);
  row.touching = record.target.valid ? 1 : 0;
  return row;
}

struct Recording {
  std::string version, device, label, fault, end, damage;
  bool black_box = false;
  double servo_rate_Hz = 0, proxy_rate_Hz = 0;
  std::vector<StepRow> steps;
  std::vector<TickRow> ticks;
};

Recording readRecording(const std::string& path) {
  const OtherThreadsRun other_threads_run;
  hl::RecordingReader reader(path);
  const hl::proto::RecordingStart start = hl::startOf(reader);
  Recording all{start.version(),
                start.device_name(),
                start.device_label(),
                start.fault(),
                "",
                "",
                start.black_box(),
                start.servo_rate_hz(),
                start.proxy_rate_hz(),
                {},
                {}};
  hl::proto::RecordingBlock block;
  while (reader.next(block)) {
    if (block.has_steps())
      for (const hl::ServoRecord& record : hl::fromProto(block.steps()))
        all.steps.push_back(rowOf(record, start.begin_ns()));
    if (block.has_ticks())
      for (const hl::TickRecord& record : hl::fromProto(block.ticks()))
        all.ticks.push_back(rowOf(record, start.begin_ns()));
    if (block.has_end()) all.end = block.end().reason();
  }
  all.damage = reader.damage();
  return all;
}

}  // namespace

void bindRecordings(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(StepRow, t, finger, proxy, stiffness, force, work_ns, buttons, touching, state, fault, rotation,
                       spin, gripper);
  PYBIND11_NUMPY_DTYPE(TickRow, t, finger, target, proxy, scene, work_ns, contacts, touching);
  py::class_<Recording>(module, "Recording")
      .def(py::init(&readRecording), py::arg("path"))
      .def_readonly("version", &Recording::version)
      .def_readonly("device", &Recording::device)
      .def_readonly("label", &Recording::label)
      .def_readonly("black_box", &Recording::black_box)
      .def_readonly("fault", &Recording::fault)
      .def_readonly("end", &Recording::end)
      .def_readonly("damage", &Recording::damage)
      .def_readonly("servo_rate", &Recording::servo_rate_Hz)
      .def_readonly("proxy_rate", &Recording::proxy_rate_Hz)
      .def_property_readonly("steps",
                             [](const Recording& all) {
                               return py::array_t<StepRow>(static_cast<py::ssize_t>(all.steps.size()),
                                                           all.steps.data());
                             })
      .def_property_readonly("ticks", [](const Recording& all) {
        return py::array_t<TickRow>(static_cast<py::ssize_t>(all.ticks.size()), all.ticks.data());
      });
}
