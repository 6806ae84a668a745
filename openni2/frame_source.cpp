#include "openni2/frame_source.h"

#include <filesystem>

#include "sim/sensor/read_capture.h"

namespace fathom {
namespace {

/// A scene in direct light, as `fathom capture` shoots it: rendered once, with new noise, matching and depth each time.
class LiveScene : public FrameSource {
 public:
  explicit LiveScene(const std::filesystem::path& path) : setup_(read_setup(path)) {}

  const SensorModel& sensor() const override { return setup_.rig.sensor; }
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

class PlayedFolder : public FrameSource {
 public:
  explicit PlayedFolder(const std::filesystem::path& folder) : capture_(read_capture(folder)) {}

  const SensorModel& sensor() const override { return capture_.sensor; }
  bool has_infrared() const override { return capture_.infrared; }
  std::optional<int> frames() const override { return static_cast<int>(capture_.frames.size()); }
  Frame shoot(int frame, bool infrared) override {
    return read_frame(capture_, static_cast<std::size_t>(frame), infrared);
  }

 private:
  RecordedCapture capture_;
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
