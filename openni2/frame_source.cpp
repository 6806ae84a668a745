#include "openni2/frame_source.h"

#include <filesystem>

#include "sim/effects/effects_json.h"
#include "sim/render/overlap.h"
#include "sim/sensor/capture_files.h"

namespace fathom {
namespace {

Setup setup_of(const std::filesystem::path& scene) {
  Setup setup = read_setup(scene);
  require_apart(setup);
  return with_effects(std::move(setup));
}

/// A scene as `fathom capture` shoots it: rendered once, with new noise, matching and depth each time.
class LiveScene : public FrameSource {
 public:
  explicit LiveScene(const std::filesystem::path& path) : setup_(setup_of(path)) {}

  const Setup& setup() const override { return setup_; }
  bool has_infrared() const override { return true; }
  std::optional<int> frames() const override { return std::nullopt; }
  void prepare() override {
    constexpr std::uint64_t kSeed = 1;
    if (!camera_) camera_.emplace(setup_, CaptureMode::photometric, kDefaultSamplesPerPixel, kSeed);
  }
  Frame shoot(int frame, bool /*infrared*/) override { return camera_->shoot(static_cast<std::uint64_t>(frame)); }

 private:
  Setup setup_;
  std::optional<Camera> camera_;
};

/// Reading an infrared image takes longer than the device's frame, so the frames are kept, unless there are many.
class PlayedFolder : public FrameSource {
 public:
  explicit PlayedFolder(const std::filesystem::path& folder) : capture_(read_capture(folder)) {
    check_frames(capture_);
    constexpr std::size_t kMostKept = std::size_t{256} << 20;  // [bytes] 40 frames of the Xtion
    const SensorModel& model = capture_.sensor();
    const std::size_t pixels = std::size_t(model.width) * model.height + std::size_t(model.ir_width) * model.ir_height;
    if (capture_.frames.size() * pixels * sizeof(float) <= kMostKept) kept_.resize(capture_.frames.size());
  }

  const Setup& setup() const override { return capture_.setup; }
  bool has_infrared() const override { return capture_.infrared; }
  std::optional<int> frames() const override { return static_cast<int>(capture_.frames.size()); }
  void prepare() override { shoot(0, capture_.infrared); }
  Frame shoot(int frame, bool infrared) override {
    const auto index = static_cast<std::size_t>(frame);
    if (kept_.empty()) return read_frame(capture_, index, infrared);
    Frame& kept = kept_[index];
    const bool lacks_infrared = infrared && capture_.infrared && kept.ir.empty();
    if (kept.disparity_px.empty() || lacks_infrared) kept = read_frame(capture_, index, infrared);
    return kept;
  }

 private:
  RecordedCapture capture_;
  std::vector<Frame> kept_;  ///< empty images where not read yet; none at all when they would be too many
};

}  // namespace

bool names_source(const std::string& uri) {
  std::error_code unreadable;
  return uri.ends_with(".json") || names_gltf(uri) || std::filesystem::is_directory(uri, unreadable);
}

std::unique_ptr<FrameSource> open_source(const std::string& uri) {
  std::error_code unreadable;
  if (std::filesystem::is_directory(uri, unreadable)) return std::make_unique<PlayedFolder>(uri);
  return std::make_unique<LiveScene>(uri);
}

}  // namespace fathom
