// What the page of a capture is given: every pixel as it was traced, and no text that could do more than be read.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/intersect.h"
#include "sim/render/truth.h"
#include "tests/core/expect_error.h"
#include "tests/core/temporary_folder.h"
#include "tests/view/unpacked.h"
#include "view/packed.h"
#include "view/page.h"
#include "view/pixel_table.h"

namespace fathom {
namespace {

TEST(CapturePage, HasEveryPixelAsItWasTraced) {
  const auto setup = setup_from_json(Json::parse(R"({
      "sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0], "ir_size_px": [640, 512],
                 "depth_size_px": [320, 240], "focal_px": 285},
      "cups": [{"shape": "paper_cup", "position_mm": [0, 300], "liquid": "water", "fill_mm": 30}]})"),
                                     "test");
  const Geometry geometry = build_geometry(setup.scene, setup.rig.sensor.wavelength_nm);
  const Intersector world(geometry);
  const PointLight projector(world, setup.rig.projector_in_world());
  const Image<TruePixel> truth = trace_truth(projector, setup.rig);
  Image<float> depth(320, 240);
  for (std::size_t i = 0; i < depth.size(); ++i) depth.pixels()[i] = 0.5f + 1e-6f * static_cast<float>(i);

  const PixelTable table = trace_pixels(setup, projector, depth);
  const PlaceCode code(table.farthest());
  const Json json = json_from_pixels(table, code);
  const auto points = unpacked<std::int16_t>(json["point"]);
  const auto apparent = unpacked<std::uint16_t>(json["apparent"]), measured = unpacked<std::uint16_t>(json["measured"]);
  const auto paths = unpacked<std::uint8_t>(json["path"]);
  const double step = json["depth_step_m"];
  ASSERT_EQ(points.size(), 3 * truth.size());
  ASSERT_LT(code.step(), 5e-5);  // a twentieth of a millimetre
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TruePixel& pixel = truth.pixels()[i];
    ASSERT_EQ(paths[i], static_cast<std::uint8_t>(pixel.path));
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(points[3 * i + axis] * code.step(), pixel.position[axis], 0.51 * code.step());
    ASSERT_NEAR(apparent[i] * step, pixel.apparent_depth.value_or(0.0), 0.51 * step);
    ASSERT_NEAR(measured[i] * step, depth.pixels()[i], 0.51 * step);
  }
  // One bend of each ray under water, and the paper's height there within a millimetre of the traced one.
  const auto counts = unpacked<std::uint8_t>(json["bend_counts"]);
  ASSERT_EQ(counts.size(), 2 * table.bent.size());
  int compared = 0;
  for (const BentPixel& pixel : table.bent) {
    if (!std::isfinite(pixel.paper_height)) continue;
    const Eigen::Vector3d camera = setup.rig.camera_in_world();
    const Eigen::Vector3d towards = pixel.camera[0] - camera;
    const double share = table.apparent_depth[pixel.pixel] / towards.dot(setup.rig.world_from_camera.linear().col(2));
    EXPECT_NEAR((camera + share * towards).z(), pixel.paper_height, 1e-3);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(CapturePage, TakesLargerImagesInSteps) {
  auto setup = setup_from_json(
      Json::parse(R"({"sensor": {"model": "xtion_pro_live", "height_mm": 650, "aim_mm": [0, 300, 0]}})"), "test");
  setup.rig.sensor.width = 1301;
  setup.rig.sensor.height = 700;
  const Geometry geometry = build_geometry(setup.scene, setup.rig.sensor.wavelength_nm);
  const Intersector world(geometry);
  const PixelTable table =
      trace_pixels(setup, PointLight(world, setup.rig.projector_in_world()), Image<float>(1301, 700, 0.5f));
  EXPECT_EQ(table.stride, 2);
  EXPECT_EQ(table.columns, 651);
  EXPECT_EQ(table.rows, 350);
}

TEST(CapturePage, TextOfFilesEndsNoElement) {
  const Json data = {{"name", "</script><script>alert(2)</script><!--"}};
  for (const std::string_view script : {kCaptureScript, kDetectionScript, kDiagnosisScript}) {
    const std::string page = view_page("</title><script>alert(1)</script>", {data, script}, kThreeFolder);
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_EQ(page.find("<!--"), std::string::npos);
    std::size_t ends = 0;
    for (std::size_t at = 0; (at = page.find("</script>", at)) != std::string::npos; ++at) ++ends;
    EXPECT_EQ(ends, 8U);  // the data, five files of three.js, the pages' common script, the page's own
    for (const char* of_the_net : {"src=\"http", "href=\"http", "@import"})
      EXPECT_EQ(page.find(of_the_net), std::string::npos) << of_the_net;
  }
}

TEST(CapturePage, SaysWhatIsMissingWithoutThreeJs) {
  const TemporaryFolder folder;
  expect_error(
      [&] {
        view_page("page", {Json::object(), kCaptureScript}, folder / "");
      },
      {"three.min.js: is missing", "libjs-three"});
}

}  // namespace
}  // namespace fathom
