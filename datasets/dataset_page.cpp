// The page of a data set that is complete.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/files.h"
#include "datasets/scene_folder.h"
#include "report/html.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// Counts by class, in the classes' order.
class Histogram {
 public:
  /// `width` is that of a class of numbers; without it classes are names.
  explicit Histogram(std::string title, double width = 0.0) : title_(std::move(title)), width_(width) {}

  void add(double value) { ++numbers_[std::floor(value / width_)]; }
  void add(const std::string& name) { ++names_[name]; }

  std::string html() const {
    std::vector<std::pair<std::string, int>> bars(names_.begin(), names_.end());
    for (const auto& [number, count] : numbers_) {
      const double low = number * width_;
      bars.emplace_back(width_ == 1.0 ? fmt::format("{:g}", low) : fmt::format("{:g} to {:g}", low, low + width_),
                        count);
    }
    int most = 1;
    for (const auto& bar : bars) most = std::max(most, bar.second);
    std::string text = fmt::format("<section><h3>{}</h3><table>", html_escaped(title_));
    for (const auto& [name, count] : bars)
      text += fmt::format("<tr><td class=n>{}</td><td><div class=b style=\"width:{}px\"></div></td><td>{}</td></tr>",
                          html_escaped(name), 180 * count / most, count);
    return text + "</table></section>";
  }

 private:
  std::string title_;
  double width_;
  std::map<double, int> numbers_;
  std::map<std::string, int> names_;
};

std::string thumbnails(const fs::path& folder, const Dataset& dataset) {
  std::string text;
  for (int frame = 0; frame < std::min(kPreviews, dataset.frames); ++frame) {
    const std::string file = fmt::format("{}/preview/{:06}.png", scene_folder(frame / dataset.frames_of_scene),
                                         frame % dataset.frames_of_scene);
    if (fs::exists(folder / file))
      text += fmt::format("<img src=\"{}\" title=\"frame {}\" alt=\"frame {}\">\n", file, frame, frame);
  }
  return text;
}

std::vector<Histogram> histograms(const fs::path& folder, const Dataset& dataset) {
  Histogram cups{"cups in a frame", 1.0}, things{"other things in a frame", 1.0}, liquids{"what cups hold"},
      fills{"fill [mm]", 10.0}, seen{"share of a cup in sight", 0.1},
      distances{"distance of a cup from the camera [mm]", 50.0}, heights{"height of the sensor [mm]", 50.0};
  for (int scene = 0; scene < dataset.scenes(); ++scene) {
    const fs::path in = folder / scene_folder(scene);
    const Json poses = read_json(in / "scene_gt.json"), infos = read_json(in / "scene_gt_info.json"),
               of_cups = read_json(in / "scene_cups.json"), cameras = read_json(in / "scene_camera.json");
    for (const auto& [image, instances] : poses.items()) {
      cups.add(static_cast<double>(of_cups.at(image).size()));
      things.add(static_cast<double>(instances.size() - of_cups[image].size()));
      const Json &turn = cameras.at(image).at("cam_R_w2c"), &shift = cameras[image].at("cam_t_w2c");
      double height = 0.0;  // of the camera in the world: the third row of −Rᵀ t
      for (std::size_t row = 0; row < 3; ++row)
        height -= turn.at(3 * row + 2).get<double>() * shift.at(row).get<double>();
      heights.add(height);
      for (const Json& cup : of_cups[image]) {
        const std::size_t instance = cup.at("instance");
        seen.add(std::min(infos.at(image).at(instance).at("visib_fract").get<double>(), 0.999));
        const Json& at = instances.at(instance).at("cam_t_m2c");
        distances.add(std::hypot(at.at(0).get<double>(), at.at(1).get<double>(), at.at(2).get<double>()));
        const Json& liquid = cup.at("liquid");
        liquids.add(liquid.is_null() ? "nothing" : liquid.at("name").get<std::string>());
        if (!liquid.is_null()) fills.add(liquid.at("fill_mm").get<double>());
      }
    }
  }
  return {cups, things, liquids, fills, seen, distances, heights};
}

}  // namespace

void write_dataset_page(const fs::path& folder, const Dataset& dataset) {
  std::string charts;
  for (const Histogram& histogram : histograms(folder, dataset)) charts += histogram.html();
  const std::string body = fmt::format(
      "<style>section{{display:inline-block;vertical-align:top;margin:0 2em 1em 0}} section "
      "table{{border:0;display:table}} section "
      "td{{border:0;padding:0 .5em;text-align:left}} td.n{{text-align:right}} "
      ".b{{height:.8em;background:#4a7fb5}} img{{margin:2px;width:320px;height:240px;display:inline}}</style>"
      "<h1>{} labelled frames</h1>"
      "<p>Measured depth, near is bright. Cups are green, other things blue, liquids that are seen through cyan, and "
      "the surfaces of turbid ones orange.</p>{}<h2>What was drawn</h2>{}",
      dataset.frames, thumbnails(folder, dataset), charts);
  write_text(folder / "index.html", html_page("Labelled frames", body));
}

}  // namespace fathom
