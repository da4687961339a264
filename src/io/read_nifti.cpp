// NIfTI-1 (Cox et al. 2004, nifti1.h) and NIfTI-2 (nifti2.h), in one file, plain or gzip.
#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "io/byte_file.h"
#include "io/read_volumes.h"
#include "io/volume_frame.h"
#include "io/volume_numbers.h"

namespace hl {

namespace {

// Where the fields of a header lie. The second kind has numbers of 64 and 32 bits where the first has 32 and 16.
struct NiftiLayout {
  bool wide;
  std::size_t bytes, magic, type, dim, pixdim, data, slope, offset, units, qform, sform, quaternion, rows;
};
constexpr NiftiLayout kNifti1{false, 348, 344, 70, 40, 76, 108, 112, 116, 123, 252, 254, 256, 280};
constexpr NiftiLayout kNifti2{true, 540, 4, 12, 16, 104, 168, 176, 184, 500, 344, 348, 352, 400};

class NiftiHeader {
 public:
  /// Reads it from the beginning of the file.
  explicit NiftiHeader(ByteFile& in) {
    in.read(bytes_.data(), sizeof(std::int32_t));
    const auto length = number<std::int32_t>(0), other = swapped(length);
    for (const NiftiLayout* layout : {&kNifti1, &kNifti2}) {
      const auto own = static_cast<std::int32_t>(layout->bytes);
      if (length == own || other == own) layout_ = layout;
    }
    if (layout_ == nullptr) throw Error("is not a NIfTI file");
    swap_ = length != static_cast<std::int32_t>(layout_->bytes);
    in.read(&bytes_[sizeof length], layout_->bytes - sizeof length);
    const char* const magic = reinterpret_cast<const char*>(&bytes_[layout_->magic]);
    if (std::strncmp(magic, "ni", 2) == 0) throw Error("has its samples in another file: save both as one .nii file");
    if (std::string_view(magic, 4) != std::string_view(layout_->wide ? "n+2" : "n+1", 4))
      throw Error("is not a NIfTI file");
  }

  const NiftiLayout& at() const { return *layout_; }
  bool swap() const { return swap_; }
  double real(std::size_t place, std::size_t index = 0) const {
    return layout_->wide ? number<double>(place + 8 * index) : double{number<float>(place + 4 * index)};
  }
  /// Sample counts.
  double dim(std::size_t index) const {
    return layout_->wide ? static_cast<double>(number<std::int64_t>(layout_->dim + 8 * index))
                         : number<std::int16_t>(layout_->dim + 2 * index);
  }
  int code(std::size_t place) const {
    return layout_->wide ? number<std::int32_t>(place) : number<std::int16_t>(place);
  }
  int type() const { return number<std::int16_t>(layout_->type); }
  int units() const {
    return layout_->wide ? number<std::int32_t>(layout_->units) : number<std::int8_t>(layout_->units);
  }
  /// Where the samples begin.
  double data() const {
    return layout_->wide ? static_cast<double>(number<std::int64_t>(layout_->data)) : number<float>(layout_->data);
  }

 private:
  template <typename Value>
  Value number(std::size_t place) const {
    Value value;
    std::memcpy(&value, &bytes_[place], sizeof value);
    return swap_ ? swapped(value) : value;
  }

  std::array<std::byte, 540> bytes_{};
  const NiftiLayout* layout_ = nullptr;
  bool swap_ = false;
};

NumberType niftiTypeOf(const NiftiHeader& header) {
  constexpr std::array<std::pair<int, NumberType>, 8> kTypes{{{2, NumberType::kUint8},
                                                              {4, NumberType::kInt16},
                                                              {8, NumberType::kInt32},
                                                              {16, NumberType::kFloat32},
                                                              {64, NumberType::kFloat64},
                                                              {256, NumberType::kInt8},
                                                              {512, NumberType::kUint16},
                                                              {768, NumberType::kUint32}}};
  for (const auto& [code, type] : kTypes) {
    if (code == header.type()) return type;
  }
  throw Error(fmt::format("has numbers of type {}: a volume has integers of 8, 16 or 32 bits, float32 or float64",
                          header.type()));
}

std::array<std::uint32_t, 3> niftiSidesOf(const NiftiHeader& header, VolumeSink& sink) {
  const double axes = header.dim(0);
  if (!(axes >= 1 && axes <= 7)) throw Error(fmt::format("is not a sound NIfTI file: it has {:g} axes", axes));
  const auto side = [&](std::size_t axis) { return static_cast<double>(axis) <= axes ? header.dim(axis) : 1; };
  double volumes = 1;
  for (std::size_t axis = 4; axis <= 7; ++axis) volumes *= std::max(side(axis), 1.0);
  if (volumes > 1) sink.warn(fmt::format("has {:g} volumes: the first is read", volumes));
  return volumeSides({side(1), side(2), side(3)});
}

double niftiUnitOf(const NiftiHeader& header, VolumeSink& sink) {
  switch (header.units() & 7) {
    case 1:
      return 1;
    case 2:
      return 1e-3;
    case 3:
      return 1e-6;
    default:
      sink.warn("says nothing of its unit of length: mm");
      return 1e-3;
  }
}

// Method 3 of nifti1.h.
Mat3 sformOf(const NiftiHeader& header) {
  Mat3 axes;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column)
      axes(row, column) = header.real(header.at().rows, static_cast<std::size_t>(4 * row + column));
  }
  return axes;
}

Vec3 pixdimOf(const NiftiHeader& header) {
  const std::size_t at = header.at().pixdim;
  return Vec3(header.real(at, 1), header.real(at, 2), header.real(at, 3)).cwiseAbs();
}

// Method 2: a quaternion without its first number, and a sign for the third axis.
Mat3 qformOf(const NiftiHeader& header) {
  const std::size_t at = header.at().quaternion;
  const double b = header.real(at), c = header.real(at, 1), d = header.real(at, 2), rest = 1 - b * b - c * c - d * d;
  Mat3 axes = Eigen::Quaterniond(std::sqrt(std::max(rest, 0.0)), b, c, d).normalized().toRotationMatrix() *
              pixdimOf(header).asDiagonal();
  if (header.real(header.at().pixdim) < 0) axes.col(2) = -axes.col(2);
  return axes;
}

// In metres, of a patient. What is no frame is passed over, as programs leave some empty with a code that promises one.
Mat3 niftiAxesOf(const NiftiHeader& header, VolumeSink& sink) {
  const double unit = niftiUnitOf(header, sink);
  const auto sound = [&](std::size_t code, const Mat3& axes, const char* name) {
    if (header.code(code) <= 0) return false;
    if (spansSpace(unit * axes)) return true;
    sink.warn(fmt::format("has a {} that is no frame: it is passed over", name));
    return false;
  };
  if (sound(header.at().sform, sformOf(header), "sform")) return unit * sformOf(header);
  if (sound(header.at().qform, qformOf(header), "qform")) return unit * qformOf(header);
  return unit * Mat3(pixdimOf(header).asDiagonal());
}

// A slope of 0 means none, whatever the intercept, and so does NaN, which nibabel writes.
ValueScale niftiScaleOf(const NiftiHeader& header) {
  const double scale = header.real(header.at().slope), offset = header.real(header.at().offset);
  if (scale == 0 || std::isnan(scale)) return {};
  if (!std::isfinite(scale) || !std::isfinite(offset))
    throw Error(
        fmt::format("has values that are no numbers: scl_slope is {:g} and scl_inter {:g}; a scl_slope of 0 means none",
                    scale, offset));
  return {scale, offset};
}

}  // namespace

void readNifti(const ModelFile& file, VolumeSink& sink) {
  ByteFile in(file.path, beginsAsGzip(file.path) ? ByteFile::Form::kGzip : ByteFile::Form::kPlain);
  const NiftiHeader header(in);
  const NumberForm form{niftiTypeOf(header), header.swap()};
  const auto side = niftiSidesOf(header, sink);
  const double place = header.data(), least = static_cast<double>(header.at().bytes);
  constexpr double kFurthest = 1e15;
  if (place != 0 && !(place >= least && place <= kFurthest))
    throw Error(fmt::format("is not a sound NIfTI file: its samples begin at byte {:g}", place));
  const GridFrame frame = centredFrame(side, fromPatient(niftiAxesOf(header, sink)));
  constexpr std::uint64_t kExtension = 4;  // bytes after the header that say whether there is more of it
  in.skip(place == 0 ? kExtension : static_cast<std::uint64_t>(place - least));
  const std::uint64_t count = samplesIn(side);
  in.expect(count * sizeOf(form.type));
  sink.header({side, keptAs(form.type), {}, niftiScaleOf(header), frame});
  copyNumbers(in, form, count, sink);
}

}  // namespace hl
