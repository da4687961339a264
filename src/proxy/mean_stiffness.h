// MeanStiffness: the stiffness of several surfaces, weighted by their normal forces. Then the target stays between
// finger and proxy, as in the paper's equation (4); a contact fades in with its lambda; s stays in the range of the
// surfaces' values. Softening each surface's own force, sum s_i lambda_i n_i, has none of these properties: in a
// narrow groove of one hard and one soft wall it pushes sideways with 1 / (2 sin(opening / 2)) times the force.
#pragma once

namespace hl {

class MeanStiffness {
 public:
  /// A surface of which `multiplier_m` is the normal force, as in ProxyContact.
  void add(double multiplier_m, double stiffness);
  bool empty() const { return most_ < least_; }
  bool uniform() const { return most_ <= least_; }  ///< all surfaces have the same
  double value() const;                             ///< 1 without surfaces

 private:
  double weights_m_ = 0, weighted_m_ = 0;
  double least_ = 1, most_ = 0;
};

}  // namespace hl
