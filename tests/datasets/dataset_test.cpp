// What a data set promises: labels that agree with the models' meshes and with each other, and the same bytes whichever
// way its frames were made.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "datasets/labels.h"
#include "datasets/scene_folder.h"
#include "tests/core/expect_error.h"
#include "tests/core/files_below.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace dataset_test {

namespace fs = std::filesystem;

constexpr const char* kSmall = R"({
  "sensor": {"models": ["xtion_pro_live_device"], "units": 3, "height_mm": [600, 700], "aim_y_mm": 350},
  "cups": {"number": [2, 2], "kinds": [{"shape": "mug"}, {"shape": {"height_mm": [70, 110], "bottom_mm": 5, "inner_radius_mm": [30, 40], "wall_mm": 3}, "variants": 2}]},
  "objects": {"number": [2, 2], "kinds": [{"solid": "can"}, {"solid": "bottle", "rotation_deg": [90, 0, 0]}]},
  "liquids": ["water", "whole_milk"], "empty": 0.2
})";

const RunIdentity kIdentity{"generate", {{"seed", 7}}};

struct DatasetFolder : testing::Test {
  TemporaryFolder folder;

  Dataset dataset(int frames) {
    write_text(folder / "spec.json", kSmall);
    return {.spec = read_dataset_spec(folder / "spec.json", 7), .seed = 7, .frames = frames, .frames_of_scene = 2};
  }
  int write(const Dataset& dataset, int scene, const std::string& to = "out") {
    return write_scene(folder / to, dataset, scene, kIdentity, [] {});
  }
};

TEST(RunLengths, CountColumnsAndBeginWithZeros) {
  Image<std::uint8_t> mask(3, 2);
  EXPECT_EQ(run_lengths(mask).counts, std::vector<int>{6});
  mask(0, 0) = mask(1, 1) = mask(2, 0) = 255;
  EXPECT_EQ(run_lengths(mask).counts, (std::vector<int>{0, 1, 2, 2, 1}));
  EXPECT_EQ(run_lengths(mask).area(), 3);
  Image<std::uint8_t> low(3, 4);  // at the bottom of two columns
  low(0, 2) = low(0, 3) = low(1, 3) = 255;
  EXPECT_EQ(run_lengths(low).counts, (std::vector<int>{2, 2, 3, 1, 4}));
  Image<std::uint8_t> inside(3, 4);
  inside(1, 1) = inside(1, 2) = 255;
  EXPECT_EQ(run_lengths(inside).counts, (std::vector<int>{5, 2, 5}));
}

TEST(ModelsInfo, SymmetriesAreTheTurnsThatChangeNothing) {
  const Json clutter = Json::parse(R"({
    "sensor": {"height_mm": 650, "aim_mm": [0, 350, 0]}, "region_mm": {"x_mm": [-200, 200], "y_mm": [200, 500]},
    "cups": {"kinds": [{"shape": "mug"}]},
    "objects": {"number": [0, 0], "kinds": [{"solid": {"box_mm": [40, 50, 60]}}, {"solid": {"box_mm": [40, 40, 60]}},
      {"solid": {"box_mm": [40, 40, 40]}}, {"solid": {"profile_mm": [[0, 0], [30, 0], [30, 80], [0, 80]]}}, {"solid": "bottle"}]}
  })");
  const Json info = models_info(Models(clutter_spec_from_json(JsonReader(clutter, "spec.json"))));
  const auto turns = [&](const char* id) { return info.at(id).value("symmetries_discrete", Json::array()).size(); };
  EXPECT_EQ(turns("1"), 0u) << "a mug has its handle on one side";
  EXPECT_EQ(turns("2"), 3u) << "half turns";
  EXPECT_EQ(turns("3"), 7u) << "and quarter turns about its long axis";
  EXPECT_EQ(turns("4"), 23u) << "those of the cube";
  EXPECT_EQ(turns("5"), 1u) << "a cylinder upside down";
  EXPECT_EQ(turns("6"), 0u) << "a bottle has its neck at one end";
  EXPECT_TRUE(info.at("5").contains("symmetries_continuous"));
  // Each leaves the box where it is: the middle of a thing that stands on z = 0 stays.
  for (const Json& turn : info.at("2").at("symmetries_discrete"))
    EXPECT_NEAR(turn.at(10).get<double>() * 30.0 + turn.at(11).get<double>(), 30.0, 1e-9);
}

TEST_F(DatasetFolder, LabelsAgreeWithTheModelsMeshes) {
  const Dataset set = dataset(1);
  Json scene = dataset_scene(set.spec, 7, 0);
  scene["objects"][0]["position_mm"] = {-330, 300};  // cut by the image's border
  Camera camera(setup_from_json(scene, "scene.json"), CaptureMode::geometric, 1, 1);
  const Frame frame = camera.shoot(0);
  const std::vector<InstanceLabel> labels = label_frame(scene, set.models, camera, FramePixels(camera, frame));
  ASSERT_EQ(labels.size(), 4u);
  const SensorModel& sensor = camera.setup().rig.sensor;
  for (const InstanceLabel& label : labels) {
    Eigen::AlignedBox2d projected;
    for (const Eigen::Vector3d& vertex : label.model->mesh.vertices) {
      const Eigen::Vector3d at = label.camera_from_model * vertex;
      projected.extend(sensor.focal_px * sensor.optics.distorted(at.head<2>() / at.z()) + sensor.principal_px);
    }
    // A pixel counts where its middle lies on the thing, also beyond the image.
    const auto& box = label.whole_box;
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->x, projected.min().x(), 1.0) << label.model->name;
    EXPECT_NEAR(box->y, projected.min().y(), 1.0);
    EXPECT_NEAR(box->x + box->width, projected.max().x(), 1.0);
    EXPECT_NEAR(box->y + box->height, projected.max().y(), 1.0);
    const int inside = run_lengths(label.whole).area();
    EXPECT_LE(inside, label.whole_pixels);
    EXPECT_EQ(inside == label.whole_pixels, box->x >= 0 && box->y >= 0 && box->x + box->width <= sensor.width &&
                                                box->y + box->height <= sensor.height);
    for (std::size_t i = 0; i < label.whole.size(); ++i) {
      ASSERT_LE(label.visible.pixels()[i], label.whole.pixels()[i]) << "seen where it is not";
      if (label.liquid) {
        ASSERT_LE(label.liquid->mask.pixels()[i], label.visible.pixels()[i]);
      }
    }
  }
}

TEST_F(DatasetFolder, LiquidsSayWhereTheyAreAndWhereTheySeemToBe) {
  const Dataset set = dataset(1);
  for (std::uint64_t number = 0, clear = 0; clear < 2; ++number) {
    ASSERT_LT(number, 40u);
    const Json scene = dataset_scene(set.spec, 7, number);
    Camera camera(setup_from_json(scene, "scene.json"), CaptureMode::geometric, 1, 1);
    for (const InstanceLabel& label : label_frame(scene, set.models, camera, FramePixels(camera, camera.shoot(0)))) {
      if (!label.liquid || run_lengths(label.liquid->mask).area() < 500) continue;
      const LiquidLabel& liquid = *label.liquid;
      EXPECT_NEAR(liquid.surface_mm - liquid.bottom_mm, liquid.fill_mm, 0.02);
      ASSERT_TRUE(liquid.apparent_mm);
      if (liquid.is_turbid) {
        EXPECT_NEAR(*liquid.apparent_mm, liquid.surface_mm, 0.1) << "paint is seen where it is";
      } else if (liquid.fill_mm > 20.0) {
        EXPECT_GT(*liquid.apparent_mm, liquid.bottom_mm + 0.15 * liquid.fill_mm) << "a clear liquid raises its bottom";
        EXPECT_LT(*liquid.apparent_mm, liquid.surface_mm + 1.0);
        ++clear;
      }
    }
  }
}

TEST_F(DatasetFolder, HasTheSameBytesWhicheverWayItWasMade) {
  const Dataset set = dataset(3);
  write_common(folder / "out", set, kIdentity);
  EXPECT_EQ(write(set, 1), 1);
  EXPECT_FALSE(is_complete(folder / "out", set));
  EXPECT_EQ(write(set, 0), 2);
  EXPECT_TRUE(is_complete(folder / "out", set));
  const auto whole = files_below(folder / "out");
  EXPECT_EQ(write(set, 0), 0) << "what is there is not made again";
  EXPECT_EQ(files_below(folder / "out"), whole);

  // A run that was killed has cut a file short, has not noted another, and has gathered nothing.
  write_text(folder / "out/train/000000/depth/000001.png", "half");
  fs::remove(folder / "out/train/000000/labels/000000.json");
  fs::remove(folder / "out/train/000000/complete.json");
  EXPECT_EQ(write(set, 0), 2);
  EXPECT_EQ(files_below(folder / "out"), whole);

  // A set of fewer frames that is continued becomes the longer one.
  const Dataset shorter = dataset(1);
  write_common(folder / "grown", shorter, kIdentity);
  EXPECT_EQ(write(shorter, 0, "grown"), 1);
  EXPECT_TRUE(is_complete(folder / "grown", shorter));
  EXPECT_FALSE(is_complete(folder / "grown", dataset(2))) << "a frame is missing in a scene that was complete";
  EXPECT_EQ(missing_frames(folder / "grown", set, 0), 1);
  EXPECT_EQ(write(set, 0, "grown"), 1);
  EXPECT_EQ(write(set, 1, "grown"), 1);
  EXPECT_EQ(files_below(folder / "grown"), whole);
}

TEST_F(DatasetFolder, OfAnotherSpecificationIsRefused) {
  const Dataset set = dataset(1);
  write_common(folder / "out", set, kIdentity);
  write(set, 0);
  expect_error([&] { write_scene(folder / "out", set, 0, {"generate", {{"seed", 8}}}, [] {}); }, {"seed"});
  const auto before = files_below(folder / "out");
  expect_error([&] { write_common(folder / "out", set, {"generate", {{"seed", 8}}}); }, {"seed", "another run"});
  EXPECT_EQ(files_below(folder / "out"), before) << "what is refused has written nothing";
  make_directory(folder / "theirs/train");
  expect_error([&] { write_common(folder / "theirs", set, kIdentity); }, {"train: is there already"});
}

TEST_F(DatasetFolder, LoadsAsBopAndCocoSayIt) {
  const Dataset set = dataset(2);
  write_common(folder / "out", set, kIdentity);
  write(set, 0);
  const fs::path scene = folder / "out/train/000000";
  const Json poses = read_json(scene / "scene_gt.json"), infos = read_json(scene / "scene_gt_info.json"),
             cameras = read_json(scene / "scene_camera.json"), coco = read_json(scene / "coco.json");
  const Json models = read_json(folder / "out/models/models_info.json");
  std::set<int> categories;
  for (const Json& category : coco.at("categories")) categories.insert(category.at("id").get<int>());
  for (const std::string image : {"0", "1"}) {
    ASSERT_EQ(poses.at(image).size(), infos.at(image).size());
    EXPECT_EQ(cameras.at(image).at("cam_K").size(), 9u);
    for (std::size_t i = 0; i < poses[image].size(); ++i) {
      EXPECT_TRUE(models.contains(fmt::format("{}", poses[image][i].at("obj_id").get<int>())));
      const Image<std::uint16_t> mask =
          read_png_grey(scene / fmt::format("mask_visib/{:06}_{:06}.png", std::stoi(image), i));
      EXPECT_EQ(std::count_if(mask.pixels().begin(), mask.pixels().end(), [](auto pixel) { return pixel == 255; }),
                infos[image][i].at("px_count_visib"));
    }
  }
  ASSERT_FALSE(coco.at("annotations").empty());
  for (const Json& annotation : coco["annotations"]) {
    EXPECT_TRUE(categories.contains(annotation.at("category_id")));
    const Json& runs = annotation.at("segmentation");
    int pixels = 0, inside = 0;
    for (std::size_t i = 0; i < runs.at("counts").size(); ++i) {
      pixels += runs["counts"][i].get<int>();
      if (i % 2) inside += runs["counts"][i].get<int>();
    }
    EXPECT_EQ(pixels, runs.at("size").at(0).get<int>() * runs["size"].at(1).get<int>());
    EXPECT_EQ(inside, annotation.at("area"));
  }
}

TEST_F(DatasetFolder, MistakesInASpecificationAreOneLine) {
  const auto refuses = [&](const std::string& text, std::initializer_list<std::string> parts) {
    write_text(folder / "bad.json", text);
    expect_error([&] { read_dataset_spec(folder / "bad.json", 1); }, parts);
  };
  refuses("[]", {"bad.json", "must be an object"});
  refuses(R"({"cup": {}})", {"/cup:", "cups"});
  refuses(R"({"fill_share": [0.5, 0.2]})", {"/fill_share: must not end below its start"});
  refuses(R"({"sensor": {"models": ["kinect_9"]}})", {"/sensor/models/0", "kinect_v1"});
  refuses(R"({"liquids": ["lava"]})", {"/liquids/0", "lava"});
  refuses(R"({"light": "full"})", {"/light", "photometric"});
  refuses(R"({"cups": {"kinds": [{"shape": "mug", "variants": 3}]}})", {"/cups/kinds/0/shape: must be an object"});
  refuses(
      R"({"cups": {"kinds": [{"shape": {"height_mm": [0, 0], "bottom_mm": 5, "inner_radius_mm": 30, "wall_mm": 3}, "variants": 1}]}})",
      {"height_mm"});
}

}  // namespace dataset_test
}  // namespace fathom
