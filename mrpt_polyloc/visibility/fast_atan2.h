#pragma once

#include <algorithm>
#include <cmath>

/// For functions that vector code is made of.
#define POLYLOC_INLINE inline __attribute__((always_inline))

namespace mrpt_polyloc {

constexpr float kPiF = 3.14159265F;

/// atan2 without branches, for vector code. Error below 4e-7: the polynomial interpolates
/// atan(a) / a in a^2 at the nine Chebyshev nodes of [0, 1] (error 1e-8), the rest is rounding.
POLYLOC_INLINE float atan2Polynomial(float y, float x) {
  const float abs_x = std::fabs(x), abs_y = std::fabs(y);
  const float greater = std::max(abs_x, abs_y), smaller = std::min(abs_x, abs_y);
  const float a = smaller / std::max(greater, 1e-30F);
  const float s = a * a;
  float p = 0.00276628350F;
  p = p * s - 0.0157312491F;
  p = p * s + 0.0421376236F;
  p = p * s - 0.0745685483F;
  p = p * s + 0.106183706F;
  p = p * s - 0.141977978F;
  p = p * s + 0.199918719F;
  p = p * s - 0.333330367F;
  p = p * s + 0.999999982F;
  p *= a;
  p = abs_y > abs_x ? 0.5F * kPiF - p : p;
  p = x < 0.0F ? kPiF - p : p;
  return y < 0.0F ? -p : p;
}

}  // namespace mrpt_polyloc
