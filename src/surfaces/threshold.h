// A value that separates the matter of a volume from what is around it.
#pragma once

#include "surfaces/iso_surface.h"

namespace hl {

/// By N. Otsu's method (IEEE Transactions on Systems, Man, and Cybernetics 9, 1979): the threshold for which the values
/// on both sides have the least variance. Of a CT it lies between air and tissue. From some of the samples only, where
/// there are many; the same for the same volume. In the middle of what values there are, if all are equal.
double thresholdOf(const Volume& volume);

}  // namespace hl
