#include "scene/polar.h"

#include <Eigen/SVD>
#include <cmath>
#include <cstdint>

#include "base/error.h"

namespace hl {

namespace {

// Rounding error of a stretch from the product of matrices, relative; closer stretches are the same.
constexpr double kSameStretch = 1.0 / (std::int64_t{1} << 36);
constexpr double kRigid = 1e-12;    // error of a product of a hundred rotations is below this
constexpr double kFlattest = 1e-9;  // minimum ratio of the smallest to the largest stretch

}  // namespace

Polar polarOf(const Mat3& linear) {
  if (!linear.allFinite()) throw Error("the product of an object's matrices is not finite");
  const bool rigid = (linear.transpose() * linear - Mat3::Identity()).cwiseAbs().maxCoeff() < kRigid;
  const double handed = linear.determinant() < 0 ? -1 : 1;
  if (rigid) return {handed * linear, handed * Mat3::Identity()};
  const Eigen::JacobiSVD<Mat3> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3& factors = svd.singularValues();
  if (!(factors.z() > kFlattest * factors.x())) throw Error("a matrix flattens an object: it cannot be touched so");
  const Mat3 rotation = handed * svd.matrixU() * svd.matrixV().transpose();
  const Mat3 stretch = handed * svd.matrixV() * factors.asDiagonal() * svd.matrixV().transpose();
  const double unit = kSameStretch * std::exp2(std::round(std::log2(factors.x())));
  return {rotation, (stretch / unit).array().round().matrix() * unit};
}

}  // namespace hl
