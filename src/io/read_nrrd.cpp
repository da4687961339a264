// NRRD: .nrrd in one file, .nhdr with its samples in another one beside it.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "io/byte_file.h"
#include "io/companion_file.h"
#include "io/nrrd_header.h"
#include "io/read_volumes.h"
#include "io/text_words.h"
#include "io/volume_frame.h"
#include "io/volume_numbers.h"

namespace hl {

namespace {

bool inSpace(const NrrdHeader& header, std::size_t axis) {
  if (!header.directions.empty()) return header.directions[axis].has_value();
  if (header.kinds.empty()) return axis < 3;
  constexpr std::array<std::string_view, 4> kKinds{"domain", "space", "???", "none"};
  return axis < 3 && std::find(kKinds.begin(), kKinds.end(), header.kinds[axis]) != kKinds.end();
}

// An axis of one number, as some programs write for grey, is none.
void dropAxesOfOne(NrrdHeader& header) {
  const auto drop = [](auto& list, std::size_t axis) {
    if (!list.empty()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(axis));
  };
  for (std::size_t axis = header.sizes.size(); axis-- > 0;) {
    if (header.sizes.size() <= 3 || header.sizes[axis] != 1 || inSpace(header, axis)) continue;
    drop(header.sizes, axis);
    drop(header.kinds, axis);
    drop(header.directions, axis);
    drop(header.spacings, axis);
    drop(header.axis_mins, axis);
    drop(header.axis_maxs, axis);
    drop(header.centerings, axis);
  }
}

// The three axes of space come first. Of what more there is, the first volume is read.
std::array<std::uint32_t, 3> nrrdSidesOf(const NrrdHeader& header, VolumeSink& sink) {
  const std::vector<double>& sizes = header.sizes;
  if (sizes.size() < 3) throw Error(fmt::format("has {} axes: a volume has three", sizes.size()));
  if (!inSpace(header, 0) || !inSpace(header, 1) || !inSpace(header, 2))
    throw Error("has more than one number in each place, or a list of them: a volume has one");
  double volumes = 1;
  for (std::size_t axis = 3; axis < sizes.size(); ++axis) volumes *= sizes[axis];
  if (volumes != 1) sink.warn(fmt::format("has {:g} volumes: the first is read", volumes));
  return volumeSides({sizes[0], sizes[1], sizes[2]});
}

double nrrdUnitOf(const NrrdHeader& header, bool patient, VolumeSink& sink) {
  constexpr std::array<std::pair<std::string_view, double>, 11> kUnits{{{"m", 1},
                                                                        {"cm", 1e-2},
                                                                        {"mm", 1e-3},
                                                                        {"millimeter", 1e-3},
                                                                        {"millimeters", 1e-3},
                                                                        {"um", 1e-6},
                                                                        {"\xc2\xb5m", 1e-6},
                                                                        {"\xce\xbcm", 1e-6},
                                                                        {"micron", 1e-6},
                                                                        {"microns", 1e-6},
                                                                        {"nm", 1e-9}}};
  for (const auto& [name, metres] : kUnits) {
    if (header.unit == name) return metres;
  }
  if (!header.unit.empty()) sink.warn(fmt::format("has '{}' as its unit of length: mm", shown(header.unit)));
  if (header.unit.empty() && !patient) sink.warn("says nothing of its unit of length: mm");
  return 1e-3;
}

/// The signs that bring a space to RAS, or none for a space that is not of a patient.
const Vec3* toRas(const std::string& space) {
  static const std::array<std::pair<std::array<std::string_view, 4>, Vec3>, 3> kSpaces{
      {{{"right-anterior-superior", "ras", "right-anterior-superior-time", "rast"}, {1, 1, 1}},
       {{"left-anterior-superior", "las", "left-anterior-superior-time", "last"}, {-1, 1, 1}},
       {{"left-posterior-superior", "lps", "left-posterior-superior-time", "lpst"}, {-1, -1, 1}}}};
  for (const auto& [names, signs] : kSpaces) {
    if (std::find(names.begin(), names.end(), space) != names.end()) return &signs;
  }
  return nullptr;
}

void warnOfSpace(const std::string& space, VolumeSink& sink) {
  constexpr std::array<std::string_view, 6> kAsTheyAre{"scanner-xyz",     "scanner-xyz-time",
                                                       "3d-right-handed", "3d-right-handed-time",
                                                       "3d-left-handed",  "3d-left-handed-time"};
  if (!space.empty() && std::find(kAsTheyAre.begin(), kAsTheyAre.end(), space) == kAsTheyAre.end())
    sink.warn(fmt::format("has a space '{}', which is not known: x, y and z are taken as they are", shown(space)));
}

// Backward along an axis where it is below 0, as a spacing may be, and a min above the max. Nothing: the file does not
// say. Samples are the middles of cells, and min and max the outer sides of these, unless they are said to be nodes.
std::optional<double> nrrdSpacingOf(const NrrdHeader& header, std::size_t axis) {
  const bool sided = !header.axis_mins.empty() && !header.axis_maxs.empty();
  if (!header.spacings.empty() && !(sided && std::isnan(header.spacings[axis]))) return header.spacings[axis];
  if (!sided) return {};
  const double length = header.axis_maxs[axis] - header.axis_mins[axis];
  if (std::isnan(length)) return {};
  const bool nodes = !header.centerings.empty() && header.centerings[axis] == "node";
  return length / (nodes ? header.sizes[axis] - 1 : header.sizes[axis]);
}

// In units of the file, in its space.
Mat3 stepsOf(const NrrdHeader& header, VolumeSink& sink) {
  Mat3 steps = Mat3::Identity();
  bool known = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto column = static_cast<Eigen::Index>(axis);
    if (!header.directions.empty()) {
      steps.col(column) = *header.directions[axis];
    } else if (const std::optional<double> spacing = nrrdSpacingOf(header, axis)) {
      steps(column, column) = *spacing;
    } else {
      known = false;
    }
  }
  if (!known) sink.warn("says nothing of the distance between its samples: 1");
  return steps;
}

Mat3 nrrdAxesOf(const NrrdHeader& header, VolumeSink& sink) {
  const Vec3* const signs = toRas(header.space);
  if (signs == nullptr) warnOfSpace(header.space, sink);
  const Mat3 steps = nrrdUnitOf(header, signs != nullptr, sink) * stepsOf(header, sink);
  return signs == nullptr ? steps : fromPatient(signs->asDiagonal() * steps);
}

std::string nrrdDataPathOf(const ModelFile& file, const NrrdHeader& header) {
  const std::string& name = header.data_file;
  if (name.empty()) return file.path;
  if (file.alone)
    throw Error(fmt::format("has its samples in '{}', and a file comes alone: save both as one .nrrd", shown(name)));
  if (name.starts_with("LIST") || name.find('%') != std::string::npos)
    throw Error("has its samples in several files: save all as one .nrrd");
  return companionPath(file.path, name);
}

// The byte skip of samples that are the last bytes of their file.
constexpr double kNrrdAtTheEnd = -1;

void checkSkips(const NrrdHeader& header) {
  constexpr double kMaxSkipped = 1e15;
  const auto counts = [](double skip) { return skip >= 0 && skip == std::floor(skip); };
  if (header.byte_skip == kNrrdAtTheEnd && header.encoding != "raw")
    throw Error("is not a sound NRRD file: its byte skip is -1, which is for raw samples only");
  if (header.byte_skip != kNrrdAtTheEnd && !(counts(header.byte_skip) && header.byte_skip <= kMaxSkipped))
    throw Error(fmt::format("is not a sound NRRD file: its byte skip is {:g}", header.byte_skip));
  if (!counts(header.line_skip))
    throw Error(fmt::format("is not a sound NRRD file: its line skip is {:g}", header.line_skip));
}

// The file with the samples, at the first of them.
ByteFile nrrdDataOf(const ModelFile& file, const NrrdHeader& header, std::uint64_t place, std::uint64_t bytes) {
  const std::string path = nrrdDataPathOf(file, header);
  const bool packed = header.encoding == "gzip" || header.encoding == "gz";
  const std::uint64_t begin = header.data_file.empty() ? place : 0;
  if (header.data_file.empty() && std::filesystem::file_size(path) <= place)
    throw Error("is a header alone, and names no data file");
  if (header.byte_skip == kNrrdAtTheEnd) {
    const std::uint64_t all = std::filesystem::file_size(path);
    if (all < begin || all - begin < bytes) throw Error(kEndsEarly);
    return ByteFile(path, ByteFile::Form::kPlain, all - bytes);
  }
  ByteFile plain(path, ByteFile::Form::kPlain, begin);
  std::string line;
  for (double i = 0; i < header.line_skip; ++i) {
    if (!plain.line(line)) throw Error(kEndsEarly);
  }
  ByteFile data = packed ? ByteFile(path, ByteFile::Form::kGzip, plain.place()) : std::move(plain);
  data.skip(static_cast<std::uint64_t>(header.byte_skip));
  return data;
}

template <typename Kept>
void copyWords(TextWords& words, NumberType type, std::uint64_t count, VolumeSink& sink) {
  constexpr std::size_t kAtOnce = 1 << 14;
  std::vector<Kept> kept;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double value = words.number("a sample");
    if (!canBe(type, value)) throw Error(fmt::format("has a sample of {:g}, which its type does not have", value));
    kept.push_back(static_cast<Kept>(value));
    if (kept.size() < kAtOnce && i + 1 < count) continue;
    sink.samples(kept.data(), kept.size() * sizeof(Kept));
    kept.clear();
  }
}

void copyKept(TextWords& words, NumberType type, std::uint64_t count, VolumeSink& sink) {
  switch (keptAs(type)) {
    case SampleKind::kInt16:
      return copyWords<std::int16_t>(words, type, count, sink);
    case SampleKind::kUint16:
      return copyWords<std::uint16_t>(words, type, count, sink);
    case SampleKind::kFloat32:
      return copyWords<float>(words, type, count, sink);
  }
}

void copyText(ByteFile in, NumberType type, const std::array<std::uint32_t, 3>& side, VolumeSink& sink) {
  TextWords words(std::move(in), "a NRRD file");
  copyKept(words, type, samplesIn(side), sink);
  words.checkEnd({side[0], side[1], side[2]});
}

bool isNrrdText(const std::string& encoding) { return encoding == "ascii" || encoding == "text" || encoding == "txt"; }

void checkEncoding(const NrrdHeader& header) {
  const std::string& encoding = header.encoding;
  if (encoding != "raw" && encoding != "gzip" && encoding != "gz" && !isNrrdText(encoding))
    throw Error(fmt::format("is packed as '{}': raw, gzip and ascii can be read", shown(encoding)));
  if (!isNrrdText(encoding) && sizeOf(header.type) > 1 && !header.big_endian)
    throw Error("is not a sound NRRD file: it does not say its endian");
}

}  // namespace

void readNrrd(const ModelFile& file, VolumeSink& sink) {
  ByteFile in(file.path);
  NrrdHeader header = readNrrdHeader(in);
  checkEncoding(header);
  checkSkips(header);
  dropAxesOfOne(header);
  const auto side = nrrdSidesOf(header, sink);
  const GridFrame frame = centredFrame(side, nrrdAxesOf(header, sink));
  const std::uint64_t count = samplesIn(side), bytes = count * sizeOf(header.type);
  ByteFile data = nrrdDataOf(file, header, in.place(), bytes);
  const bool text = isNrrdText(header.encoding);
  data.expect(text ? count : bytes);  // a word has a letter at least
  sink.header({side, keptAs(header.type), {}, {}, frame});
  if (text) return copyText(std::move(data), header.type, side, sink);
  const bool big_here = std::endian::native == std::endian::big;
  copyNumbers(data, {header.type, header.big_endian.value_or(big_here) != big_here}, count, sink);
}

}  // namespace hl
