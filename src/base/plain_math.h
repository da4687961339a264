// Functions from additions, multiplications, divisions and roots alone, which IEEE 754 rounds in one way: the same bits
// with every C library and processor. Those of the C library differ in the last bit between its variants for processors
// with and without fused multiply-add. For whatever decides where a surface is and what a tick does to the proxy.
#pragma once

#include <cstdint>

namespace hl::plain {

/// Within three units in the last place for |x| up to 1e6 rad; beyond it the reduction loses digits. NaN of what
/// is not finite, or above 1e9. RT-safe.
double sin(double x);
double cos(double x);
/// The angle of (x, y), both >= 0 and not both 0: 0..pi / 2, within five units in the last place. RT-safe.
double angleOf(double x, double y);
/// e^x for x <= 0, within two units in the last place; 0 from -700 down. RT-safe.
double expOfNegative(double x);
/// The cube root of n >= 1, within two units in the last place.
double cubeRoot(double n);

}  // namespace hl::plain
