#include "sim/sensor/capture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "core/parallel.h"
#include "core/units.h"
#include "core/view_page.h"
#include "sim/effects/effects_json.h"
#include "sim/scene/cup.h"
#include "sim/sensor/depth.h"
#include "sim/sensor/preview.h"

namespace fathom {
namespace {

/// Intensities as 8-bit grey; full scale is the detector's, 10 bits where it has none.
Image<std::uint8_t> grey_from_dn(const Image<float>& ir, int bits) {
  const float scale = 255.0f / static_cast<float>((1 << (bits > 0 ? bits : 10)) - 1);
  Image<std::uint8_t> grey(ir.width(), ir.height());
  for (std::size_t i = 0; i < ir.size(); ++i)
    grey.pixels()[i] = static_cast<std::uint8_t>(std::lround(std::clamp(ir.pixels()[i] * scale, 0.0f, 255.0f)));
  return grey;
}

/// One channel of the truth as an image.
template <class Value>
ExrChannel channel(const char* name, const Image<TruePixel>& truth, Value value) {
  ExrChannel result{name, Image<float>(truth.width(), truth.height())};
  for (std::size_t i = 0; i < truth.size(); ++i)
    result.image.pixels()[i] = static_cast<float>(value(truth.pixels()[i]));
  return result;
}

/// frame_0000, frame_0001 …
bool is_frame_folder(const std::string& name) {
  const std::string prefix = "frame_";
  return name.starts_with(prefix) && name.size() >= prefix.size() + 4 &&
         name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
}

std::vector<std::filesystem::path> frame_folders(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> frames;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink() && is_frame_folder(entry.path().filename().string()))
      frames.push_back(entry.path());
  return frames;
}

/// The numbers of objects that occur in the truth: first on the pixels' rays, and finally.
Json numbers_in_sight(const Image<TruePixel>& truth) {
  std::set<int> first, finally;
  for (const TruePixel& pixel : truth.pixels()) {
    if (pixel.first_object > 0) first.insert(pixel.first_object);
    if (pixel.object > 0) finally.insert(pixel.object);
  }
  return {{"first", first}, {"finally", finally}};
}

/// Of what is there, not of what the device believes.
Json camera_matrix(const SensorModel& sensor) {
  return {{sensor.focal_px, 0.0, sensor.principal_px.x()},
          {0.0, sensor.focal_px, sensor.principal_px.y()},
          {0.0, 0.0, 1.0}};
}

/// The sensor after all effects, with the pattern where the record has it.
Json sensor_record(const Rig& rig, const ResolvedScene& resolved) {
  Json sensor = json_from_rig(rig);
  const Json& scene = resolved.scene;
  if (rig.sensor.pattern.image.brightness) sensor["pattern"]["image"] = scene["sensor"]["pattern"]["image"];
  if (rig.sensor.unit.learned.map) sensor["unit"]["learned"] = scene["sensor"]["unit"]["learned"];
  return sensor;
}

Image<float> read_image(const std::filesystem::path& path, int width, int height) {
  Image<float> image = read_exr_channel(path, "Y");
  if (image.width() != width || image.height() != height)
    throw Error(path.string(),
                fmt::format("is {} × {} pixels, expected {} × {}", image.width(), image.height(), width, height));
  return image;
}

}  // namespace

Image<std::uint16_t> whole_dn(const Image<float>& ir) {
  Image<std::uint16_t> counts(ir.width(), ir.height());
  for (std::size_t i = 0; i < ir.size(); ++i)
    counts.pixels()[i] = static_cast<std::uint16_t>(std::lround(std::clamp(ir.pixels()[i], 0.0f, 65535.0f)));
  return counts;
}

std::vector<std::string> frame_files(bool infrared, bool device_outputs) {
  std::vector<std::string> names{"disparity.exr", "depth.exr", "depth.png", "cloud.pcd", "preview.png"};
  if (infrared) names.insert(names.begin(), {"ir.exr", "ir.png"});
  if (device_outputs) names.insert(names.end(), {"depth_100um.png", "shift.png", "depth_registered.png"});
  return names;
}

std::vector<std::string> capture_names(const std::filesystem::path& folder) {
  std::vector<std::string> names = frame_files(true, true);
  names.insert(names.begin(), {"run.json", "truth.exr", kSceneFiles});
  for (const std::filesystem::path& frame : frame_folders(folder)) names.push_back(frame.filename().string());
  return names;
}

void remove_capture(const std::filesystem::path& folder) {
  for (const char* name : {"run.json", "truth.exr"}) std::filesystem::remove(folder / name);
  for (const std::string& name : frame_files(true, true)) std::filesystem::remove(folder / name);
  remove_view_page(folder);
  for (const std::filesystem::path& frame : frame_folders(folder)) {
    remove_leftovers(frame);
    for (const std::string& name : frame_files(true, true)) std::filesystem::remove(frame / name);
    std::error_code not_empty;  // somebody else's files stay
    std::filesystem::remove(frame, not_empty);
  }
  std::filesystem::remove_all(folder / kSceneFiles);
}

std::filesystem::path frame_folder(const std::filesystem::path& folder, int frame, int frames) {
  return frames == 1 ? folder : folder / fmt::format("frame_{:04}", frame);
}

void write_frame(const std::filesystem::path& folder, const Frame& frame, const Image<TruePixel>& truth, int ir_bits) {
  if (!frame.ir.empty()) {
    write_exr(folder / "ir.exr", {{"Y", frame.ir}});
    write_png(folder / "ir.png", grey_from_dn(frame.ir, ir_bits));
  }
  write_exr(folder / "disparity.exr", {{"Y", frame.disparity_px}});
  write_exr(folder / "depth.exr", {{"Z", frame.depth}});
  write_png(folder / "depth.png", depth_in_units(frame.depth, kMetresPerMm));
  write_pcd(folder / "cloud.pcd", frame.cloud);
  write_png(folder / "preview.png", preview(frame, truth));
}

void write_device_outputs(const std::filesystem::path& folder, const SensorModel& sensor, const Frame& frame) {
  constexpr double kTenth = 0.1 * kMetresPerMm;
  write_png(folder / "depth_100um.png",
            depth_in_units(depth_image(sensor, frame.disparity_px, cut_of(sensor, kTenth)), kTenth));
  write_png(folder / "shift.png", shift_image(sensor, frame.disparity_px));
  write_png(folder / "depth_registered.png",
            depth_in_units(registered_to_colour(depth_image(sensor, frame.disparity_px, sensor.law.cut),
                                                sensor.focal_px, sensor.focal_px),
                           kMetresPerMm));
}

std::vector<ExrChannel> truth_channels(const Image<TruePixel>& truth) {
  return {channel("position.X", truth, [](const TruePixel& p) { return p.position.x(); }),
          channel("position.Y", truth, [](const TruePixel& p) { return p.position.y(); }),
          channel("position.Z", truth, [](const TruePixel& p) { return p.position.z(); }),
          channel("apparent.Z", truth, [](const TruePixel& p) { return p.apparent_depth.value_or(0.0); }),
          channel("first.object", truth, [](const TruePixel& p) { return p.first_object; }),
          channel("first.Z", truth, [](const TruePixel& p) { return p.first_depth; }),
          channel("object", truth, [](const TruePixel& p) { return p.object; }),
          channel("path", truth, [](const TruePixel& p) { return static_cast<int>(p.path); })};
}

void write_truth(const std::filesystem::path& folder, const Image<TruePixel>& truth) {
  write_exr(folder / "truth.exr", truth_channels(truth));
}

void write_scene_files(const std::filesystem::path& folder, const ResolvedScene& resolved) {
  for (const NamedFile& file : resolved.files) {
    make_directory((folder / file.name).parent_path());
    write_text(folder / file.name, file.content);
  }
}

Json run_record(const Camera& camera, const ResolvedScene& resolved) {
  const Setup& setup = camera.setup();
  const Geometry& geometry = camera.geometry();
  const double wavelength_nm = setup.rig.sensor.wavelength_nm;
  Json media = Json::object(), cups = Json::object();
  for (std::size_t i = 0; i < setup.scene.cups.size(); ++i) {
    const Cup& cup = setup.scene.cups[i];
    const CupObjects& numbers = geometry.cups[i];
    if (!cup.filling) continue;
    const Medium& medium = cup.filling->medium;
    cups["cup " + std::to_string(i) + " " + cup_name(cup)] = {
        {"object", numbers.cup},
        {"liquid", *numbers.liquid},
        {"cavity_depth_mm", mm_from_metres(cup_depth(cup))},
        {"cavity_ml", ml_from_cubic_metres(cup_capacity(cup))},
        {"fill_mm", mm_from_metres(cup.filling->depth)},
        {"fill_ml", ml_from_cubic_metres(cup_volume(cup, cup.filling->depth))}};
    media["cup " + std::to_string(i) + " " + medium.name] = {
        {"index", medium.n(wavelength_nm)},
        {"absorption_per_mm", per_mm_from_per_metre(medium.absorption)},
        {"scattering_per_mm", per_mm_from_per_metre(medium.scattering)},
        {"anisotropy", medium.anisotropy},
        {"source", medium.source}};
  }
  Json objects = Json::object(), poses = Json::object();
  for (std::size_t i = 0; i < geometry.objects.size(); ++i) {
    objects[std::to_string(i + 1)] = geometry.objects[i];
    poses[std::to_string(i + 1)] = json_from_pose(geometry.world_from_object[i]);
  }
  const CaptureStatistics& s = camera.statistics();
  return {{"scene", setup.source},
          {"resolved_scene", resolved.scene},
          {"sensor", sensor_record(setup.rig, resolved)},
          {"camera_matrix", camera_matrix(setup.rig.sensor)},
          {"world_from_camera", json_from_pose(setup.rig.world_from_camera)},
          {"processing", json_from_processing(setup.processing)},
          {"indirect_light", json_from_light(setup.light)},
          {"cups", cups},
          {"media", media},
          {"objects", objects},
          {"world_from_object", poses},
          {"in_sight", numbers_in_sight(camera.truth())},
          {"approximations", geometry.approximations},
          {"timing",
           {{"build_s", s.build_s},
            {"truth_s", s.truth_s},
            {"reference_s", s.reference_s},
            {"render_s", s.render_s},
            {"match_s", s.match_s},
            {"depth_s", s.depth_s}}},
          {"rays", s.camera_rays},
          {"threads", thread_count()}};
}

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
