#include "sim/sensor/read_capture.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/image_file.h"
#include "sim/effects/effects_json.h"
#include "sim/sensor/capture_files.h"

namespace fathom {
namespace {

Image<float> read_image(const std::filesystem::path& path, int width, int height) {
  Image<float> image = read_exr_channel(path, "Y");
  if (image.width() != width || image.height() != height)
    throw Error(path.string(),
                fmt::format("is {} × {} pixels, expected {} × {}", image.width(), image.height(), width, height));
  return image;
}

}  // namespace

RecordedCapture read_capture(const std::filesystem::path& folder) {
  const std::filesystem::path record = folder / "run.json";
  if (!std::filesystem::is_regular_file(record))
    throw Error(folder.string(), "holds no complete capture: there is no run.json");
  const Json value = read_json(record);
  const JsonReader json(value, record.string());
  const JsonReader scene = json.at("resolved_scene");
  RecordedCapture capture{with_effects(setup_from_json(scene.value(), scene.file(), scene.pointer())),
                          json.text("mode") == "photometric",
                          {}};
  const int frames = json.at("frames").integer(1, kMostFrames);
  for (int i = 0; i < frames; ++i) capture.frames.push_back(frame_folder(folder, i, frames));
  return capture;
}

void check_frames(const RecordedCapture& capture) {
  const SensorModel& sensor = capture.sensor();
  for (const std::filesystem::path& folder : capture.frames) {
    if (capture.infrared) check_exr(folder / "ir.exr", sensor.ir_width, sensor.ir_height);
    check_exr(folder / "disparity.exr", sensor.width, sensor.height);
  }
}

Frame read_frame(const RecordedCapture& capture, std::size_t index, bool infrared) {
  const SensorModel& sensor = capture.sensor();
  const std::filesystem::path& folder = capture.frames.at(index);
  Frame frame;
  if (infrared && capture.infrared) frame.ir = read_image(folder / "ir.exr", sensor.ir_width, sensor.ir_height);
  frame.disparity_px = read_image(folder / "disparity.exr", sensor.width, sensor.height);
  return frame;
}

}  // namespace fathom
