// Speckle on pixels: the moments and correlation that the lens's grain gives it, and what a frame renews.
#include "sim/sensor/speckle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fathom {
namespace {

SensorModel coherent_sensor(double f_number) {
  SensorModel sensor;
  sensor.optics.f_number = f_number;
  sensor.noise.pixel_speckle = 1.0;
  return sensor;
}

struct Statistics {
  double mean = 0.0, variance = 0.0, neighbours = 0.0;  ///< covariance of pixels beside each other, over the variance
};

Statistics statistics_of(const Image<float>& field) {
  Statistics s;
  for (const float gain : field.pixels()) s.mean += gain;
  s.mean /= static_cast<double>(field.size());
  double covariance = 0.0;
  for (int y = 0; y < field.height(); ++y)
    for (int x = 0; x < field.width(); ++x) {
      s.variance += std::pow(field(x, y) - s.mean, 2.0);
      if (x > 0) covariance += (field(x, y) - s.mean) * (field(x - 1, y) - s.mean);
    }
  s.neighbours = covariance / s.variance;
  s.variance /= static_cast<double>(field.size());
  return s;
}

TEST(Speckle, HasAsMuchContrastAsGrainsPerPixelLeave) {
  for (const double f_number : {2.4, 4.0, 8.0}) {
    const SensorModel sensor = coherent_sensor(f_number);
    const Statistics s = statistics_of(speckle_field(sensor, 1.0, 600, 400, 1));
    EXPECT_NEAR(s.mean, 1.0, 0.01) << f_number;  // 240000 pixels, deviation up to 0.8, correlated over 1 or 2
    // The same, and the bits' kurtosis of −1/16 takes up to 1 %.
    EXPECT_NEAR(s.variance * speckle_grains(sensor), 1.0, 0.03) << f_number;
  }
  // Landau 2016: 47 % from dot to dot, by detectors of 5.2 µm; grains of F/3.2 at 830 nm give that.
  EXPECT_NEAR(std::sqrt(1.0 / speckle_grains(coherent_sensor(3.2))), 0.47, 0.03);
}

TEST(Speckle, CoarserGrainsReachOverMorePixels) {
  const auto neighbours = [](double f_number) {
    return statistics_of(speckle_field(coherent_sensor(f_number), 1.0, 600, 400, 1)).neighbours;
  };
  EXPECT_LT(neighbours(2.4), 0.1);
  EXPECT_GT(neighbours(10.0), 0.4);
}

TEST(Speckle, OfAFrameIsStaticButForItsRenewedShare) {
  SensorModel sensor = coherent_sensor(2.4);
  const Image<float> field = speckle_field(sensor, 1.0, 600, 400, 1);
  EXPECT_EQ(renewed_speckle(sensor, field, 1, 0)(5, 5), field(5, 5));
  sensor.noise.speckle_renewed = 0.05;
  const Image<float> frame = renewed_speckle(sensor, field, 1, 3);
  const Statistics before = statistics_of(field), after = statistics_of(frame);
  EXPECT_NEAR(after.mean, 1.0, 0.01);
  EXPECT_NEAR(after.variance / before.variance, 1.0, 0.03);  // it stays the Gamma it is
  double covariance = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i)
    covariance += (field.pixels()[i] - before.mean) * (frame.pixels()[i] - after.mean);
  covariance /= static_cast<double>(field.size());
  EXPECT_NEAR(covariance / std::sqrt(before.variance * after.variance), 0.95, 0.01);
  EXPECT_NE(frame(5, 5), renewed_speckle(sensor, field, 1, 4)(5, 5));
}

}  // namespace
}  // namespace fathom
