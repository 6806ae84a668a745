#include "core/simd.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fathom {
namespace {

TEST(Simd, ExponentialsAreExactToAFewRoundings) {
  for (float x = -87.0f; x <= 87.0f; x += 0.00390625f) {
    const Float8 lanes = Float8{} + x;
    Float8 result;
    exp8(lanes, result);
    EXPECT_NEAR(static_cast<double>(result[3]) / std::exp(static_cast<double>(x)), 1.0, 4e-7) << x;
  }
}

}  // namespace
}  // namespace fathom
