// hl replay: runs a recorded session again and says whether everything comes out as it did; and its steps as CSV.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <span>

#include "base/error.h"
#include "commands.h"
#include "io/output_file.h"
#include "record/replay.h"

namespace hl {

namespace {

constexpr int kDiffers = 1, kBadInput = 2;  // exit codes
constexpr std::array<const char*, 5> kStates{"off", "arming", "on", "fault", "waiting"};

class CsvFile {
 public:
  CsvFile(const std::string& path, const std::string& recording) : file_(path, {recording}) {
    file_.write(
        "t,finger_x,finger_y,finger_z,proxy_x,proxy_y,proxy_z,touching,stiffness,force_x,force_y,force_z,"
        "speed,state,fault,work_ns,stylus_qw,stylus_qx,stylus_qy,stylus_qz,spin_x,spin_y,spin_z,gripper_rad\n");
  }

  void add(double time_s, const ServoRecord& step) {
    const Vec3 &finger = step.sample.position, &proxy = step.target.proxy_D, &force = step.out.force_N;
    file_.print(
        "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.9g},{},"
        "\"{}\",{}",
        time_s, finger.x(), finger.y(), finger.z(), proxy.x(), proxy.y(), proxy.z(), step.target.valid ? 1 : 0,
        step.target.stiffness, force.x(), force.y(), force.z(), speed(time_s, finger),
        kStates[static_cast<std::size_t>(step.out.safety) % kStates.size()], faultText(step.out.fault), step.work_ns);
    add(step.sample.stylus);
  }
  void close() { file_.close(); }

 private:
  void add(const Stylus& stylus) {
    const Eigen::Quaterniond& q = stylus.turned;
    const Vec3& spin = stylus.spin_rad_s;
    file_.print(",{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", q.w(), q.x(), q.y(), q.z(),
                spin.x(), spin.y(), spin.z(), stylus.gripper_rad);
  }
  // Of the finger since the step before, m/s.
  double speed(double time_s, const Vec3& finger) {
    const double elapsed_s = time_s - last_s_;
    const double speed_m_s = last_s_ >= 0 && elapsed_s > 0 ? (finger - last_finger_).norm() / elapsed_s : 0;
    last_s_ = time_s;
    last_finger_ = finger;
    return speed_m_s;
  }

  OutputFile file_;
  double last_s_ = -1;
  Vec3 last_finger_ = Vec3::Zero();
};

bool hasNothing(const ReplayReport& report) { return report.steps + report.ticks == 0; }

void print(const std::string& file, const ReplayReport& report) {
  fmt::print("{}: {} of {:.3f} s, {}, HL {}\n", file, report.black_box ? "black box" : "session",
             report.last_s - report.first_s, report.label.empty() ? report.device : report.label + ", " + report.device,
             report.version);
  if (!report.fault.empty()) fmt::print("fault:      {}\n", report.fault);
  fmt::print("it has:     {} servo steps, {} ticks, {} scenes\n", report.steps, report.ticks, report.scenes);
  if (report.world_hashes > 0) fmt::print("bodies:     compared after {} ticks\n", report.world_hashes);
  if (report.lost_steps + report.lost_ticks > 0)
    fmt::print(
        "missing:    {} servo steps and {} ticks that the recorder could not keep; {} ticks after them are not "
        "checked\n",
        report.lost_steps, report.lost_ticks, report.unchecked_ticks);
  if (report.ticks_among_hands > 0)
    fmt::print(
        "unchecked:  {} ticks, as hands of other devices are at the bodies too: give the recordings of all of them, "
        "from the begin of the session on\n",
        report.ticks_among_hands);
  if (!report.damage.empty()) fmt::print("cut:        {}\n", report.damage);
  fmt::print("ended:      {}\n", report.end.empty() ? "the program was killed, or its file is cut" : report.end);
  if (report.difference) {
    fmt::print("differs:    at {} {}, {:.6f} s: {}\n", report.difference->what, report.difference->number,
               report.difference->time_s, report.difference->text);
  } else {
    fmt::print("reproduced: {}\n", hasNothing(report) ? "nothing, as it has no whole step" : "bit for bit");
  }
}

void printAndFlush(const std::string& file, const ReplayReport& report) {
  print(file, report);
  std::fflush(stdout);
}

void demandSame(std::span<const ReplayReport> reports) {
  const auto differs = [](const ReplayReport& report) { return report.difference.has_value(); };
  if (std::any_of(reports.begin(), reports.end(), differs)) throw CLI::RuntimeError(kDiffers);
  if (std::any_of(reports.begin(), reports.end(), hasNothing)) throw CLI::RuntimeError(kBadInput);
}

// Of several devices, whose hands may be at the same bodies.
void runTogether(const std::vector<std::string>& files) {
  const std::vector<ReplayReport> reports = replayTogether(files);
  for (std::size_t i = 0; i < files.size(); ++i) printAndFlush(files[i], reports[i]);
  demandSame(reports);
}

void run(const std::string& file, const std::string& csv_path) {
  if (!csv_path.empty()) requireNotRead(csv_path, {file});
  std::unique_ptr<CsvFile> csv;  // made with the first step: a file that is no recording overwrites nothing
  const ReplayReport report = replay(file, [&](double time_s, const ServoRecord& step) {
    if (!csv && !csv_path.empty()) csv = std::make_unique<CsvFile>(csv_path, file);
    if (csv) csv->add(time_s, step);
  });
  if (csv) csv->close();
  printAndFlush(file, report);
  demandSame({&report, 1});
}

}  // namespace

void addReplayCommand(CLI::App& app) {
  auto* command = app.add_subcommand("replay", "run a recording or a black box again, and compare it bit for bit");
  auto files = std::make_shared<std::vector<std::string>>();
  auto csv = std::make_shared<std::string>();
  command
      ->add_option("files", *files,
                   "of hl record, or a black box; of several devices those of all, where all are at the "
                   "same bodies")
      ->required()
      ->option_text("FILE...");
  command->add_option("--csv", *csv, "write its servo steps there; of one file")->option_text("FILE");
  command->callback([files, csv] {
    if (files->size() == 1) return run(files->front(), *csv);
    if (!csv->empty()) throw Error("--csv is of one recording, and there are " + std::to_string(files->size()));
    runTogether(*files);
  });
}

}  // namespace hl
