#include "app/capture_files.h"

#include <algorithm>
#include <cmath>

#include "app/preview.h"
#include "core/image_file.h"
#include "core/parallel.h"
#include "core/units.h"

namespace fathom {
namespace {

/// 10-bit intensities as 8-bit grey.
Image<std::uint8_t> grey_from_dn(const Image<float>& ir) {
  Image<std::uint8_t> grey(ir.width(), ir.height());
  for (std::size_t i = 0; i < ir.size(); ++i)
    grey.pixels()[i] = static_cast<std::uint8_t>(std::clamp(ir.pixels()[i] / 4.0f, 0.0f, 255.0f));
  return grey;
}

Image<std::uint16_t> whole_mm(const Image<float>& depth) {
  Image<std::uint16_t> mm(depth.width(), depth.height());
  for (std::size_t i = 0; i < depth.size(); ++i)
    mm.pixels()[i] = static_cast<std::uint16_t>(std::clamp(std::lround(mm_from_metres(depth.pixels()[i])), 0L, 65535L));
  return mm;
}

/// One channel of the truth as an image.
template <class Value>
ExrChannel channel(const char* name, const Image<TruePixel>& truth, Value value) {
  ExrChannel result{name, Image<float>(truth.width(), truth.height())};
  for (std::size_t i = 0; i < truth.size(); ++i)
    result.image.pixels()[i] = static_cast<float>(value(truth.pixels()[i]));
  return result;
}

}  // namespace

void write_frame(const std::filesystem::path& folder, const Frame& frame, const Image<TruePixel>& truth) {
  if (!frame.ir.empty()) {
    write_exr(folder / "ir.exr", {{"Y", frame.ir}});
    write_png(folder / "ir.png", grey_from_dn(frame.ir));
  }
  write_exr(folder / "disparity.exr", {{"Y", frame.disparity_px}});
  write_exr(folder / "depth.exr", {{"Z", frame.depth}});
  write_png(folder / "depth.png", whole_mm(frame.depth));
  write_pcd(folder / "cloud.pcd", frame.cloud);
  write_png(folder / "preview.png", preview(frame, truth));
}

void write_truth(const std::filesystem::path& folder, const Image<TruePixel>& truth) {
  write_exr(folder / "truth.exr",
            {channel("position.X", truth, [](const TruePixel& p) { return p.position.x(); }),
             channel("position.Y", truth, [](const TruePixel& p) { return p.position.y(); }),
             channel("position.Z", truth, [](const TruePixel& p) { return p.position.z(); }),
             channel("apparent.Z", truth, [](const TruePixel& p) { return p.apparent_depth.value_or(0.0); }),
             channel("object", truth, [](const TruePixel& p) { return p.object; }),
             channel("path", truth, [](const TruePixel& p) { return static_cast<int>(p.path); })});
}

Json run_record(const Setup& setup, const Camera& camera) {
  const double wavelength_nm = setup.rig.sensor.wavelength_nm;
  Json media = Json::object();
  for (const Cup& cup : setup.scene.cups) {
    if (!cup.filling) continue;
    const Medium& medium = cup.filling->medium;
    media[medium.name] = {{"index", medium.n(wavelength_nm)},
                          {"absorption_per_mm", medium.absorption * kMetresPerMm},
                          {"scattering_per_mm", medium.scattering * kMetresPerMm},
                          {"anisotropy", medium.anisotropy},
                          {"source", medium.source}};
  }
  Json objects = Json::object();
  const std::vector<std::string>& names = camera.geometry().objects;
  for (std::size_t i = 0; i < names.size(); ++i) objects[std::to_string(i + 1)] = names[i];
  const CaptureStatistics& s = camera.statistics();
  return {{"scene", setup.source},
          {"sensor", json_from_rig(setup.rig)},
          {"media", media},
          {"objects", objects},
          {"approximations", camera.geometry().approximations},
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

}  // namespace fathom
