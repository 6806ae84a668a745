// How the error of an infrared image with all its light falls with the time that it takes. The reference is an image of
// the same kind: this is about chance and sampling, not about what all such images have in common.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bench/bench_scene.h"
#include "bench/benchmark_groups.h"
#include "bench/measure.h"
#include "core/files.h"
#include "sim/sensor/ir_camera.h"

namespace fathom {
namespace {

/// The strip of the image that is rendered: the middle of the cup with all of its height, an eighth of its width.
constexpr int kColumns = 16, kRows = 192;
constexpr int kMostSamplesAcross = 4;
/// Images of other seeds whose mean is the reference, and a finer grid than that of any image that is compared with it.
constexpr int kReferenceImages = 6, kReferenceSamplesAcross = 5;

class Strip {
 public:
  explicit Strip(const std::string& file)
      : scene_(crop(read_setup(data_directory() / file), kColumns, kRows)),
        pattern_(scene_.setup.rig.sensor.pattern, scene_.setup.rig.sensor.ir_scale()) {
    pattern_.set_dot_gains(speckle_gains(scene_.setup.rig.sensor.noise, pattern_, 1));
  }

  Image<float> image(int samples_across, std::uint64_t seed) const {
    return render_ir(scene_.projector, scene_.setup.rig, pattern_, samples_across, LightModel::full, seed).projected;
  }

  std::vector<Eigen::Vector2i> pixels() const { return pixels_on_cups(scene_.projector, scene_.setup.rig); }

 private:
  BenchScene scene_;
  Pattern pattern_;
};

/// The converged values of some pixels.
class Reference {
 public:
  explicit Reference(const Strip& strip) : pixels_(strip.pixels()), means_(pixels_.size(), 0.0) {
    std::vector<double> squares(pixels_.size(), 0.0);
    for (int i = 0; i < kReferenceImages; ++i) {
      constexpr int kFirstSeed = 1000;
      const Image<float> image = strip.image(kReferenceSamplesAcross, kFirstSeed + i);
      for (std::size_t k = 0; k < pixels_.size(); ++k) {
        const double value = image(pixels_[k].x(), pixels_[k].y());
        means_[k] += value / kReferenceImages;
        squares[k] += value * value / kReferenceImages;
      }
    }
    for (std::size_t k = 0; k < pixels_.size(); ++k)
      mean_variance_ += (squares[k] - means_[k] * means_[k]) / (kReferenceImages - 1);
    mean_variance_ /= static_cast<double>(pixels_.size());
  }

  /// Root mean square over the pixels [DN].
  double standard_error() const { return std::sqrt(mean_variance_); }

  /// The same of an image's error. What the reference's own chance adds to the mean square is taken off.
  double rmse(const Image<float>& image) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < pixels_.size(); ++k)
      sum += std::pow(image(pixels_[k].x(), pixels_[k].y()) - means_[k], 2);
    return std::sqrt(sum / static_cast<double>(pixels_.size()) - mean_variance_);
  }

 private:
  std::vector<Eigen::Vector2i> pixels_;
  std::vector<double> means_;   ///< of each pixel [DN]
  double mean_variance_ = 0.0;  ///< of these means [DN²]
};

}  // namespace

void register_convergence() {
  for (const char* name : {"paper_water", "meniscus_water", "paper_milk_tea", "glass_water"}) {
    const auto strip = std::make_shared<const Strip>(fmt::format("{}.json", name));
    const Reference reference(*strip);
    for (int across = 1; across <= kMostSamplesAcross; ++across) {
      const int samples = across * across;
      measure(fmt::format("convergence/{}/{}", name, samples),
              {{"samples", samples},
               {"rmse_dn", reference.rmse(strip->image(across, 1))},
               {"reference_dn", reference.standard_error()}},
              [strip, across] { benchmark::DoNotOptimize(strip->image(across, 1)); });
    }
  }
}

}  // namespace fathom
