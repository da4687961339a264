#include "io/dicom_stack.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"

namespace hl {

namespace {

// Files round positions to 0.1 or 0.001 mm.
constexpr double kRounding_mm = 0.05, kUneven = 0.02;

bool near(double a, double b) { return std::abs(a - b) <= 1e-3 * std::abs(a); }
bool sameDirection(const Vec3& a, const Vec3& b) { return (a - b).norm() <= 1e-3; }

void checkSlice(const DicomSlice& slice) {
  constexpr double kSquare = 1e-2;
  const Vec3 &row = slice.along_row, &column = slice.along_column;
  const bool unit = std::abs(row.norm() - 1) <= kSquare && std::abs(column.norm() - 1) <= kSquare;
  if (!unit || !(std::abs(row.dot(column)) <= kSquare)) throw Error("says no direction of its slices that could be");
  if (!(slice.column_step > 0 && slice.row_step > 0) || !std::isfinite(slice.column_step * slice.row_step))
    throw Error("says no distance between its samples that could be");
  if (!slice.position.allFinite()) throw Error("says no place of its slices that could be");
}

void checkParallel(const std::vector<DicomSlice>& slices) {
  const DicomSlice& first = slices.front();
  for (const DicomSlice& slice : slices) {
    if (!sameDirection(slice.along_row, first.along_row) || !sameDirection(slice.along_column, first.along_column))
      throw Error("has slices that are not parallel to each other: export one stack of them");
    if (!near(slice.column_step, first.column_step) || !near(slice.row_step, first.row_step))
      throw Error("has slices of unequal scale: export one stack of them");
  }
}

// `gaps` between slices, along their normal.
void checkGaps(const std::vector<double>& gaps) {
  std::vector<double> sorted = gaps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double usual = sorted[sorted.size() / 2], most = std::min(kRounding_mm + kUneven * usual, 0.4 * usual);
  constexpr double kSamePlace_mm = 1e-3;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] < kSamePlace_mm)
      throw Error(fmt::format("has two slices in one place, {} and {} of {}: export one moment or kind of image alone",
                              i + 1, i + 2, gaps.size() + 1));
    if (std::abs(gaps[i] - usual) <= most) continue;
    throw Error(fmt::format("{}: {} and {} of {} lie {:.6g} mm apart, others {:.6g} mm",
                            gaps[i] > 1.5 * usual ? "misses slices" : "has slices that lie unequally", i + 1, i + 2,
                            gaps.size() + 1, gaps[i], usual));
  }
}

}  // namespace

Mat3 stackSlices(std::vector<DicomSlice>& slices) {
  if (slices.size() < 2) throw Error("has one slice: a volume has at least two");
  for (const DicomSlice& slice : slices) checkSlice(slice);
  checkParallel(slices);
  const DicomSlice first = slices.front();
  const Vec3 normal = first.along_row.cross(first.along_column).normalized();
  const auto before = [&](const DicomSlice& a, const DicomSlice& b) {
    return std::forward_as_tuple(a.position.dot(normal), a.path, a.frame) <
           std::forward_as_tuple(b.position.dot(normal), b.path, b.frame);
  };
  std::sort(slices.begin(), slices.end(), before);
  std::vector<double> gaps;
  for (std::size_t i = 1; i < slices.size(); ++i)
    gaps.push_back((slices[i].position - slices[i - 1].position).dot(normal));
  checkGaps(gaps);
  const Vec3 step = (slices.back().position - slices.front().position) / static_cast<double>(gaps.size());
  const double most = 2 * kRounding_mm + kUneven * step.norm();
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const Vec3 expected = slices.front().position + static_cast<double>(i) * step;
    if ((slices[i].position - expected).norm() > most) throw Error("has slices that do not lie along a line");
  }
  Mat3 axes;
  axes << first.column_step * first.along_row.normalized(), first.row_step * first.along_column.normalized(), step;
  return axes;
}

}  // namespace hl
