#include "bench/other_renderers.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "core/image_file.h"
#include "core/json.h"
#include "tests/core/temporary_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// The projector's image as a slide between black margins.
struct Slide {
  Eigen::AlignedBox2d window;  ///< in units of the projector's focal length
  Image<std::uint16_t> image;  ///< full scale is a dot's centre
};

Slide slide_of(const SparseDots& dots) {
  std::vector<SparseDot> all = dots.on(dots.desk());
  for (const SparseDot& dot : dots.on(dots.bottom())) all.push_back(dot);

  constexpr int kTexelsPerIrPx = 4;
  const SensorModel& sensor = dots.view().rig.sensor;
  const double texel = 1.0 / (sensor.focal_px * sensor.ir_scale() * kTexelsPerIrPx);
  // Both renderers interpolate linearly, which is a blur with a variance of a sixth of a texel squared.
  const double sigma_texels = std::sqrt(std::pow(kTexelsPerIrPx * sensor.pattern.dot_sigma_ir_px, 2) - 1.0 / 6.0);
  const int reach = static_cast<int>(std::ceil(6.0 * sigma_texels));

  Eigen::AlignedBox2d centres;
  for (const SparseDot& dot : all) centres.extend(dot.direction);
  const Eigen::Vector2i size =
      (centres.sizes() / texel).array().ceil().cast<int>() + 2 * (reach + 1);  // whole texels around the outermost dots
  const Eigen::Vector2d first = centres.min().array() - (reach + 1) * texel;
  Slide slide{{first, first + texel * size.cast<double>()}, Image<std::uint16_t>(size.x(), size.y())};
  for (const SparseDot& dot : all) {
    const Eigen::Vector2d centre = (dot.direction - first) / texel;
    const Eigen::Vector2i middle = centre.cast<int>();
    for (int y = middle.y() - reach; y <= middle.y() + reach; ++y)
      for (int x = middle.x() - reach; x <= middle.x() + reach; ++x) {
        const double apart = (Eigen::Vector2d(x + 0.5, y + 0.5) - centre).norm() / sigma_texels;
        slide.image(x, y) += static_cast<std::uint16_t>(std::lround(65535.0 * std::exp(-0.5 * apart * apart)));
      }
  }
  return slide;
}

/// The scene in numbers that both renderers' files begin with.
Json numbers_of(const SparseDots& dots, const Slide& slide) {
  const Rig& rig = dots.view().rig;
  const Eigen::Matrix3d axes = rig.world_from_camera.linear();
  const auto vector = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  const Ground bottom = dots.bottom();
  return {{"CameraMm", vector(rig.camera_in_world() / kMetresPerMm)},
          {"ProjectorMm", vector(rig.projector_in_world() / kMetresPerMm)},
          {"Right", vector(axes.col(0))},
          {"Down", vector(axes.col(1))},
          {"Forward", vector(axes.col(2))},
          {"FocalPx", rig.sensor.focal_px * rig.sensor.ir_scale()},
          {"Columns", rig.sensor.ir_width},
          {"Rows", rig.sensor.ir_height},
          {"SlideLeft", slide.window.min().x()},
          {"SlideTop", slide.window.min().y()},
          {"SlideColumns", slide.window.sizes().x()},
          {"SlideRows", slide.window.sizes().y()},
          {"DotSigma", dots.dot_sigma()},
          {"DistanceMm", dots.distance_mm()},
          {"FillMm", mm_from_metres(bottom.fill)},
          {"Index", bottom.index},
          {"DeskAlbedo", dots.desk().albedo},
          {"CupAlbedo", bottom.albedo}};
}

std::string povray_text(const Json& numbers) {
  std::string text;
  for (const auto& [name, value] : numbers.items())
    text += value.is_array()
                ? fmt::format("#declare {} = <{}, {}, {}>;\n", name, value[0].dump(), value[1].dump(), value[2].dump())
                : fmt::format("#declare {} = {};\n", name, value.dump());
  return text;
}

/// Where the bottom's dots are on the slide, in shares of its size, y up.
std::string bottom_dots_text(const SparseDots& dots, const Slide& slide) {
  std::string text;
  const std::vector<SparseDot> on_bottom = dots.on(dots.bottom());
  for (const SparseDot& dot : on_bottom) {
    const Eigen::Vector2d at = (dot.direction - slide.window.min()).cwiseQuotient(slide.window.sizes());
    text += fmt::format("{}<{}, {}>", text.empty() ? "" : ", ", at.x(), 1.0 - at.y());
  }
  return fmt::format("#declare BottomDots = array[{}] {{ {} }}\n", on_bottom.size(), text);
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double children_cpu_s() {
  rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

void run(const fs::path& folder, const std::string& command) {
  if (std::system(fmt::format("cd '{}' && {} > log 2>&1", folder.string(), command).c_str()) != 0)
    throw Error(command, read_text(folder / "log"));
}

/// Mean of every 2 × 2 pixels.
Image<float> halved(const Image<float>& image) {
  Image<float> half(image.width() / 2, image.height() / 2);
  for (int y = 0; y < half.height(); ++y)
    for (int x = 0; x < half.width(); ++x)
      half(x, y) = 0.25f * (image(2 * x, 2 * y) + image(2 * x + 1, 2 * y) + image(2 * x, 2 * y + 1) +
                            image(2 * x + 1, 2 * y + 1));
  return half;
}

}  // namespace

bool is_installed(const std::string& program) {
  return std::system(fmt::format("command -v {} > /dev/null", program).c_str()) == 0;
}

Rendering render_with_povray(const SparseDots& dots, int photons) {
  const TemporaryFolder folder;
  const Slide slide = slide_of(dots);
  write_png(folder / "slide.png", slide.image);
  Json numbers = numbers_of(dots, slide);
  numbers["Photons"] = photons;
  write_text(folder / "parameters.inc", povray_text(numbers) + bottom_dots_text(dots, slide));
  fs::copy_file(fs::path(FATHOM_BENCH_FOLDER) / "dots.pov",
                folder / "dots.pov");  // Debian lets it read its working folder, not any other
  const double cpu_before = children_cpu_s();
  const auto start = std::chrono::steady_clock::now();
  // OpenEXR, linear. Four pixels for one: their centres are where samples are known to lie.
  run(folder / "", fmt::format("povray +Idots.pov +Odots.exr +FE -D -A +W{} +H{}", 2 * dots.view().rig.sensor.ir_width,
                               2 * dots.view().rig.sensor.ir_height));
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {halved(read_exr_channel(folder / "dots.exr", "R")), children_cpu_s() - cpu_before, wall.count()};
}

Rendering render_with_cycles(const SparseDots& dots, int samples_per_pixel) {
  const TemporaryFolder folder;
  const Slide slide = slide_of(dots);
  write_png(folder / "slide.png", slide.image);
  Json numbers = numbers_of(dots, slide);
  numbers["Samples"] = samples_per_pixel;
  write_text(folder / "parameters.json", numbers.dump(2));
  run(folder / "", fmt::format("blender --background --factory-startup --python-exit-code 1 --python '{}'",
                               (fs::path(FATHOM_BENCH_FOLDER) / "dots_in_cycles.py").string()));
  Rendering rendering{read_exr_channel(folder / "dots.exr", "R"), 0.0, 0.0};
  std::istringstream(read_text(folder / "times.txt")) >> rendering.cpu_s >> rendering.wall_s;
  return rendering;
}

}  // namespace fathom
