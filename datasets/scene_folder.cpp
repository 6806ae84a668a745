#include "datasets/scene_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/error.h"
#include "core/files.h"
#include "core/folder_owner.h"
#include "core/image_file.h"
#include "core/parallel.h"
#include "core/rng.h"
#include "datasets/labels.h"
#include "report/depth_picture.h"
#include "sim/sensor/capture_files.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

constexpr const char* kComplete = "complete.json";  ///< of a scene, comes last and says how many frames it has
constexpr std::uint64_t kCameraStream = 0x63616d657261ULL;

std::string frame_name(int image) { return fmt::format("{:06}", image); }

/// Errors of a drawn scene name the specification and the frame.
Setup setup_of(const Dataset& dataset, const Json& scene, int number) {
  return setup_from_json(scene, dataset.spec.clutter.file, fmt::format("frame {}", number));
}

/// Writes a frame's files into the scene's folder and keeps their names. They reach the disk with the scene.
class FrameWriter {
 public:
  FrameWriter(fs::path folder, std::string frame) : folder_(std::move(folder)), frame_(std::move(frame)) {}

  template <class Pixel, class... Packed>
  void image(const std::string& kind, const Image<Pixel>& picture, Packed... packing) {
    files_.push_back(fmt::format("{}/{}.png", kind, frame_));
    write_png(folder_ / files_.back(), picture, Flush::later, packing...);
  }

  /// Both masks of the instance number `i`: where nothing hides it they are the same bytes.
  void masks(const InstanceLabel& label, std::size_t i) {
    const std::string whole = png_bytes(label.whole);
    bytes("mask", i, whole);
    bytes("mask_visib", i,
          std::ranges::equal(label.visible.pixels(), label.whole.pixels()) ? whole : png_bytes(label.visible));
  }

  std::string text(const std::string& kind, Json content) {
    content["files"] = files_;
    std::string name = fmt::format("{}/{}.json", kind, frame_);
    write_text(folder_ / name, content.dump() + "\n", Flush::later);
    return name;
  }

  const std::vector<std::string>& files() const { return files_; }

 private:
  void bytes(const char* kind, std::size_t i, std::string_view png) {
    files_.push_back(fmt::format("{}/{}_{:06}.png", kind, frame_, i));
    write_text(folder_ / files_.back(), png, Flush::later);
  }

  fs::path folder_;
  std::string frame_;
  std::vector<std::string> files_;
};

void write_images(const SensorModel& sensor, const Frame& frame, const FramePixels& pixels, FrameWriter& writer) {
  writer.image("depth", pixels.measured);
  writer.image("depth_true", pixels.seen, Packing::repeats);
  writer.image("depth_apparent", pixels.apparent, Packing::repeats);
  writer.image("depth_first", pixels.first, Packing::repeats);
  if (!frame.ir.empty()) writer.image("ir", whole_dn(at_depth_scale(sensor, frame.ir)));
}

Json runs_json(const RunLengths& runs) { return {{"size", {runs.height, runs.width}}, {"counts", runs.counts}}; }

constexpr Rgb kCup{90, 200, 90}, kThing{100, 140, 230}, kSeenThrough{60, 220, 230}, kSurface{250, 160, 50};

/// Colours of what is seen, black where it is the desk or nothing.
Image<Rgb> tints(int width, int height, const std::vector<InstanceLabel>& labels) {
  Image<Rgb> tint(width, height, Rgb{0, 0, 0});
  const auto paint = [&](const Image<std::uint8_t>& mask, const Rgb& colour) {
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (mask.pixels()[i]) tint.pixels()[i] = colour;
  };
  for (const InstanceLabel& label : labels) {
    paint(label.visible, label.model->is_cup ? kCup : kThing);
    if (label.liquid) paint(label.liquid->mask, label.liquid->is_turbid ? kSurface : kSeenThrough);
  }
  return tint;
}

/// A frame as a picture for people, half as large as the depth image: measured depth in grey, near is bright; cups
/// tinted green, other things blue, liquids that are seen through cyan and surfaces of turbid ones orange.
Image<Rgb> frame_picture(const Frame& frame, const std::vector<InstanceLabel>& labels) {
  const Image<Rgb> grey = depth_picture(frame.depth);
  const Image<Rgb> tint = tints(grey.width(), grey.height(), labels);
  Image<Rgb> picture(grey.width() / 2, grey.height() / 2);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb &shade = grey(2 * x, 2 * y), &colour = tint(2 * x, 2 * y);
      const bool is_labelled = colour != Rgb{0, 0, 0};
      for (std::size_t c = 0; c < 3; ++c)
        picture(x, y)[c] = is_labelled ? static_cast<std::uint8_t>(0.45 * shade[c] + 0.55 * colour[c]) : shade[c];
    }
  return picture;
}

/// Shoots a frame, writes its files and returns their names, that of its labels last.
std::vector<std::string> make_frame(const fs::path& folder, const Dataset& dataset, int number) {
  const Json scene = dataset_scene(dataset.spec, dataset.seed, number);
  const Setup setup = setup_of(dataset, scene, number);
  Camera camera(setup, dataset.spec.mode, kDefaultSamplesPerPixel, Rng(dataset.seed, kCameraStream, number).bits(),
                dataset.spec.light);
  const Frame frame = camera.shoot(0);
  const FramePixels pixels(camera, frame);
  const std::vector<InstanceLabel> labels = label_frame(scene, dataset.models, camera, pixels);

  FrameWriter writer(folder, frame_name(number % dataset.frames_of_scene));
  write_images(setup.rig.sensor, frame, pixels, writer);
  Json instances = Json::array();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const InstanceLabel& label = labels[i];
    writer.masks(label, i);
    Json entry = {{"pose", pose_entry(label)}, {"info", info_entry(label)}, {"visible", runs_json(label.visible_runs)}};
    if (label.model->is_cup) {
      entry["cup"] = cup_entry(label, setup.scene.cups[label.index]);
      if (label.liquid) entry["liquid_visible"] = runs_json(label.liquid->runs);
    }
    instances.push_back(std::move(entry));
  }
  if (number < kPreviews) writer.image("preview", frame_picture(frame, labels));
  std::vector<std::string> files = writer.files();
  files.push_back(writer.text("labels", {{"frame", number},
                                         {"scene", scene},
                                         {"camera", camera_entry(setup.rig)},
                                         {"width", setup.rig.sensor.width},
                                         {"height", setup.rig.sensor.height},
                                         {"instances", instances}}));
  return files;
}

/// Whether a frame's labels, and all the files that they name, are as they were written.
bool is_made(const fs::path& folder, const Manifest& manifest, int image) {
  const std::string labels = fmt::format("labels/{}.json", frame_name(image));
  if (!manifest.holds(labels)) return false;
  const Json files = read_json(folder / labels).at("files");
  return std::all_of(files.begin(), files.end(), [&](const Json& file) { return manifest.holds(file); });
}

/// COCO's categories.
enum class Category { cup = 1, thing, liquid_surface, liquid_seen_through };

Json categories() {
  return Json::array({{{"id", 1}, {"name", "cup"}, {"supercategory", "vessel"}},
                      {{"id", 2}, {"name", "thing"}, {"supercategory", "thing"}},
                      {{"id", 3}, {"name", "liquid surface"}, {"supercategory", "liquid"}},
                      {{"id", 4}, {"name", "liquid seen through"}, {"supercategory", "liquid"}}});
}

Json annotation(std::int64_t id, std::int64_t image, Category category, const Json& runs, const Json& box,
                const Json& area) {
  return {{"id", id},     {"image_id", image},    {"category_id", static_cast<int>(category)},
          {"iscrowd", 0}, {"segmentation", runs}, {"bbox", box},
          {"area", area}};
}

/// Reads the labels of a scene's frames while the file system is flushed: both take about as long.
std::vector<Json> read_labels_and_flush(const fs::path& folder, int images) {
  std::vector<Json> labels(static_cast<std::size_t>(images));
  parallel_items(images + 1, [&](int i) {
    if (i == 0)
      flush_file_system(folder);
    else
      labels[static_cast<std::size_t>(i - 1)] = read_json(folder / fmt::format("labels/{}.json", frame_name(i - 1)));
  });
  return labels;
}

/// The labels of a scene's frames, gathered into BOP's and COCO's files.
void gather(const fs::path& folder, const std::string& name, const std::vector<Json>& frames, bool has_infrared,
            Manifest& manifest) {
  constexpr std::int64_t kMostAnnotations = 1000;  // of a frame: numbers are unique in the whole data set
  Json cameras = Json::object(), poses = Json::object(), infos = Json::object(), cups = Json::object();
  Json shown = Json::array(), annotations = Json::array();
  for (std::size_t image = 0; image < frames.size(); ++image) {
    const std::string key = fmt::format("{}", image);
    const Json& labels = frames[image];
    cameras[key] = labels.at("camera");
    poses[key] = infos[key] = cups[key] = Json::array();
    const std::int64_t frame = labels.at("frame");
    auto next_id = [frame, number = 0]() mutable { return frame * kMostAnnotations + ++number; };
    shown.push_back({{"id", frame},
                     {"file_name", fmt::format("{}/{}/{}.png", name, has_infrared ? "ir" : "depth",
                                               frame_name(static_cast<int>(image)))},
                     {"width", labels.at("width")},
                     {"height", labels.at("height")}});
    for (const Json& instance : labels.at("instances")) {
      poses[key].push_back(instance.at("pose"));
      infos[key].push_back(instance.at("info"));
      const bool is_cup = instance.contains("cup");
      const Json& info = instance["info"];
      if (info.at("px_count_visib") > 0)
        annotations.push_back(annotation(next_id(), frame, is_cup ? Category::cup : Category::thing,
                                         instance.at("visible"), info.at("bbox_visib"), info.at("px_count_visib")));
      if (!is_cup) continue;
      Json cup = instance["cup"];
      cup["instance"] = poses[key].size() - 1;
      const Json& liquid = cup["liquid"];
      if (!liquid.is_null() && liquid.at("px_count_visib") > 0)
        annotations.push_back(annotation(
            next_id(), frame,
            liquid.at("category") == "liquid surface" ? Category::liquid_surface : Category::liquid_seen_through,
            instance.at("liquid_visible"), liquid.at("bbox_visib"), liquid.at("px_count_visib")));
      cups[key].push_back(std::move(cup));
    }
  }
  const Json complete = {{"frames", frames.size()}};
  const Json coco = {{"info", {{"description", "simulated by Fathom"}}},
                     {"licenses", Json::array()},
                     {"categories", categories()},
                     {"images", shown},
                     {"annotations", annotations}};
  for (const auto& [file, content] :
       std::initializer_list<std::pair<const char*, const Json*>>{{"scene_camera.json", &cameras},
                                                                  {"scene_gt_info.json", &infos},
                                                                  {"scene_cups.json", &cups},
                                                                  {"coco.json", &coco},
                                                                  {"scene_gt.json", &poses},
                                                                  {kComplete, &complete}}) {
    const std::string text = content->dump() + "\n";
    // A data set that is whole stays as it is: a second run that is killed leaves no line twice in its manifest.
    if (manifest.holds(file) && read_text(folder / file) == text) continue;
    write_text(folder / file, text);
    manifest.add(file);
  }
}

}  // namespace

std::string scene_folder(int scene) { return fmt::format("train/{:06}", scene); }

void write_common(const fs::path& folder, const Dataset& dataset, const RunIdentity& identity) {
  make_directory(folder);
  Manifest manifest(folder, identity);
  manifest.require_same_run(std::vector<std::string>{"train", "models", "dataset.json"});
  manifest.begin();
  if (!is_complete(folder, dataset)) fs::remove(folder / "index.html");  // it comes last
  make_directory(folder / "models");
  remove_leftovers(folder / "models");
  make_directory(folder / "train");
  const auto write = [&](const std::string& name, const std::function<void(const fs::path&)>& write_file) {
    if (manifest.holds(name)) return;
    write_file(folder / name);
    manifest.add(name);
  };
  write("dataset.json", [&](const fs::path& path) {
    write_json(path, {{"seed", dataset.seed}, {"specification", dataset.spec.source}});
  });
  for (const Model& model : dataset.models.all())
    write(fmt::format("models/obj_{:06}.ply", model.id), [&](const fs::path& path) { write_model(path, model); });
  write("models/models_info.json", [&](const fs::path& path) { write_json(path, models_info(dataset.models)); });
  write("camera.json", [&](const fs::path& path) {
    const SensorModel sensor = setup_of(dataset, dataset_scene(dataset.spec, dataset.seed, 0), 0).rig.sensor;
    write_json(path, {{"fx", sensor.focal_px},
                      {"fy", sensor.focal_px},
                      {"cx", bop_principal_px(sensor).x()},
                      {"cy", bop_principal_px(sensor).y()},
                      {"width", sensor.width},
                      {"height", sensor.height},
                      {"depth_scale", kDepthUnitMm}});
  });
  manifest.finish();
}

int missing_frames(const fs::path& folder, const Dataset& dataset, int scene) {
  int missing = 0;
  for (int image = 0; image < dataset.frames_in(scene); ++image)
    missing += !fs::exists(folder / scene_folder(scene) / fmt::format("labels/{}.json", frame_name(image)));
  return missing;
}

int write_scene(const fs::path& data_set, const Dataset& dataset, int scene, const RunIdentity& identity,
                const std::function<void()>& step) {
  const fs::path folder = data_set / scene_folder(scene);
  const FolderOwner owner(folder);
  Manifest manifest(folder, identity);
  manifest.require_same_run(std::vector<std::string>{"labels"});
  manifest.begin();
  std::vector<std::string> kinds{"depth", "depth_true", "depth_apparent", "depth_first",
                                 "mask",  "mask_visib", "labels"};
  const bool has_infrared = dataset.spec.mode == CaptureMode::photometric;
  if (has_infrared) kinds.emplace_back("ir");
  if (scene * dataset.frames_of_scene < kPreviews) kinds.emplace_back("preview");
  for (const std::string& kind : kinds) {
    make_directory(folder / kind);
    remove_leftovers(folder / kind);
  }
  const int images = dataset.frames_in(scene);
  std::vector<int> missing;
  for (int image = 0; image < images; ++image) {
    if (is_made(folder, manifest, image))
      step();
    else
      missing.push_back(image);
  }
  if (!missing.empty()) fs::remove(folder / kComplete);
  parallel_items(static_cast<int>(missing.size()), [&](int i) {
    const std::vector<std::string> files = make_frame(folder, dataset, scene * dataset.frames_of_scene + missing[i]);
    for (const std::string& file : files) manifest.add(file);
    step();
  });
  // The frames are on the disk before anything says that the scene is whole.
  gather(folder, scene_folder(scene), read_labels_and_flush(folder, images), has_infrared, manifest);
  manifest.finish();
  return static_cast<int>(missing.size());
}

bool is_complete(const fs::path& folder, const Dataset& dataset) {
  for (int scene = 0; scene < dataset.scenes(); ++scene) {
    const fs::path file = folder / scene_folder(scene) / kComplete;
    if (!fs::exists(file) || read_json(file).at("frames") != dataset.frames_in(scene)) return false;
  }
  return true;
}

}  // namespace fathom
