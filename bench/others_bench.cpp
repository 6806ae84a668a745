// Dots on the bottom under water: error and time beside other renderers that can show them.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/measure.h"
#include "bench/other_renderers.h"
#include "tests/sensor/sparse_dots.h"

namespace fathom {
namespace {

/// What the pixels around a dot must be. Across a dot refraction is linear: a Gaussian becomes one of another shape.
class ExactPixels {
 public:
  ExactPixels(const Rig& rig, double sigma, const SparseDot& dot, const Ground& ground) : exact_(dot.exact) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = sigma * Eigen::Vector2d::Unit(axis);
      ir_px_from_sigmas_.col(axis) = 0.5 * (exact_dot(rig, dot.direction + step, ground).centre_ir_px -
                                            exact_dot(rig, dot.direction - step, ground).centre_ir_px);
    }
    sigmas_from_ir_px_ = ir_px_from_sigmas_.inverse();
  }

  /// Mean over a pixel.
  double operator()(int x, int y) const {
    constexpr int kAcross = 4;
    double sum = 0.0;
    for (int j = 0; j < kAcross; ++j)
      for (int i = 0; i < kAcross; ++i)
        sum += at({x + (i + 0.5) / kAcross, y + (j + 0.5) / kAcross}) / (kAcross * kAcross);
    return sum;
  }

 private:
  double at(const Eigen::Vector2d& ir_px) const {
    return exact_.sum_dn / (2.0 * std::numbers::pi * std::fabs(ir_px_from_sigmas_.determinant())) *
           std::exp(-0.5 * (sigmas_from_ir_px_ * (ir_px - exact_.centre_ir_px)).squaredNorm());
  }

  DotImage exact_;
  Eigen::Matrix2d ir_px_from_sigmas_, sigmas_from_ir_px_;
};

/// Light of some dots over what is exact.
double brightness(const std::vector<SparseDot>& dots, const Image<float>& image) {
  double measured = 0.0, exact = 0.0;
  for (const SparseDot& dot : dots) {
    measured += measured_dot(image, dot.exact.centre_ir_px).sum_dn;
    exact += dot.exact.sum_dn;
  }
  return measured / exact;
}

/// How good an image of a few dots is, on a desk and on the bottom under water, whoever made it.
struct DotError {
  int dots = 0;            ///< on the bottom
  double place_ir_px = 0;  ///< root mean square distance from the exact centre, of the dots on the bottom
  double brightness = 0;   ///< of the bottom's dots beside the desk's, 1 = exact
  double rmse = 0;         ///< over the pixels of the bottom's dots, relative to their root mean square, at best scale
};

/// `image` has the size of the dots' infrared image and any unit. A scale of its own is taken off `rmse`, so that it
/// tells of noise and blur, and `brightness` alone of too much or too little light.
DotError dot_error(const SparseDots& dots, const Image<float>& image) {
  const std::vector<SparseDot> on_bottom = dots.on(dots.bottom());
  double squared_distances = 0.0, exact_squares = 0.0, image_squares = 0.0, products = 0.0;
  for (const SparseDot& dot : on_bottom) {
    const Eigen::Vector2d& centre = dot.exact.centre_ir_px;
    squared_distances += (measured_dot(image, centre).centre_ir_px - centre).squaredNorm();
    const ExactPixels exact_pixels(dots.view().rig, dots.dot_sigma(), dot, dots.bottom());
    const int x = static_cast<int>(centre.x()), y = static_cast<int>(centre.y());
    for (int j = y - kDotReachIrPx; j <= y + kDotReachIrPx; ++j)
      for (int i = x - kDotReachIrPx; i <= x + kDotReachIrPx; ++i) {
        const double exact = exact_pixels(i, j), value = image(i, j);
        exact_squares += exact * exact;
        image_squares += value * value;
        products += exact * value;
      }
  }
  // min over s of Σ (s value − exact)² = Σ exact² − (Σ exact value)² / Σ value².
  return {static_cast<int>(on_bottom.size()), std::sqrt(squared_distances / static_cast<double>(on_bottom.size())),
          brightness(on_bottom, image) / brightness(dots.on(dots.desk()), image),
          std::sqrt(1.0 - products * products / (image_squares * exact_squares))};
}

struct Case {
  SparseDots dots{200.0, 0.0};  // Cycles' shadow caustics know no absorption
  EmbreeLoop embree{dots.view().geometry};
};

std::map<std::string, double> counters_of(const DotError& error, double effort) {
  return {{"effort", effort},
          {"dots", error.dots},
          {"place_ir_px", error.place_ir_px},
          {"brightness", error.brightness},
          {"rmse", error.rmse}};
}

/// Runs another program once. Its times are not those of this process, and become counters.
void measure_other(const std::string& name, const std::shared_ptr<const Case>& measured, int effort,
                   Rendering (*render)(const SparseDots&, int)) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    for (auto _ : state) {
      const Rendering rendering = render(measured->dots, effort);
      for (const auto& [key, value] : counters_of(dot_error(measured->dots, rendering.image), effort))
        state.counters[key] = value;
      state.counters["cpu_s"] = rendering.cpu_s;
      state.counters["wall_s"] = rendering.wall_s;
    }
  })->Iterations(1);
}

bool is_there(const std::string& program) {
  const bool there = is_installed(program);
  if (!there) fmt::print(stderr, "{} is not installed and is left out\n", program);
  return there;
}

}  // namespace

void register_others() {
  const auto measured = std::make_shared<const Case>();
  for (const int across : {1, 2, 3, 4})
    measure(fmt::format("others/fathom/{}", across * across),
            counters_of(dot_error(measured->dots, measured->dots.image(across)), across * across),
            [measured, across] { benchmark::DoNotOptimize(measured->dots.image(across)); });
  measure_embree("others/embree", {measured, &measured->embree},
                 record_camera_rays(measured->dots.view().world, measured->dots.view().rig, kSamplesAcross));
  if (is_there("povray"))
    for (const int photons : {30'000, 100'000, 300'000, 1'000'000, 3'000'000})
      measure_other(fmt::format("others/povray/{}", photons), measured, photons, render_with_povray);
  if (is_there("blender"))
    for (const int samples : {16, 64, 256})
      measure_other(fmt::format("others/cycles/{}", samples), measured, samples, render_with_cycles);
}

}  // namespace fathom
