#include "datasets/labels.h"

#include <algorithm>
#include <array>

#include "core/median.h"
#include "core/units.h"
#include "sim/scene/cup.h"
#include "sim/scene/cup_mesh.h"

namespace fathom {
namespace {

Json by_rows(const Eigen::Matrix3d& matrix) {
  Json numbers = Json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) numbers.push_back(matrix(row, column));
  return numbers;
}

/// The pixels that may show a body with this box, as far as one image's width and height beyond the image, where BOP
/// counts what is cut off as well; all of them where part of it lies behind the camera.
PixelBox window_of(const Model& model, const Pose& camera_from_model, const SensorModel& sensor) {
  constexpr double kMargin = 3.0;
  const Eigen::Vector2d size(sensor.width, sensor.height);
  Eigen::AlignedBox2d seen, canvas(-size, 2.0 * size);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at =
        camera_from_model * model.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    if (at.z() <= 0.0) return {-sensor.width, -sensor.height, 3 * sensor.width, 3 * sensor.height};
    seen.extend(sensor.focal_px * sensor.optics.distorted(at.head<2>() / at.z()) + sensor.principal_px);
  }
  const Eigen::Vector2d low = (seen.min().array() - kMargin).floor(), high = (seen.max().array() + kMargin).ceil();
  const Eigen::Vector2i from = low.cwiseMax(canvas.min()).cwiseMin(canvas.max()).cast<int>(),
                        to = high.cwiseMax(canvas.min()).cwiseMin(canvas.max()).cast<int>();
  return {from.x(), from.y(), to.x() - from.x(), to.y() - from.y()};
}

std::optional<PixelBox> box_of(const Image<std::uint8_t>& mask) {
  int left = mask.width(), top = mask.height(), right = -1, bottom = -1;
  for (int y = 0; y < mask.height(); ++y) {
    const std::uint8_t *begin = mask.row(y), *end = begin + mask.width();
    const std::uint8_t* first = std::find_if(begin, end, [](std::uint8_t value) { return value > 0; });
    if (first == end) continue;
    const std::uint8_t* last = end - 1;
    while (*last == 0) --last;
    left = std::min(left, static_cast<int>(first - begin)), right = std::max(right, static_cast<int>(last - begin));
    top = std::min(top, y), bottom = y;
  }
  if (right < 0) return std::nullopt;
  return PixelBox{left, top, right - left + 1, bottom - top + 1};
}

/// Where the thing would be seen if nothing else were there. Where it is seen no ray needs to say so.
void see_alone(const Pose& world_from_model, const Rig& rig, const Image<std::uint16_t>& depth, InstanceLabel& label) {
  const Model& model = *label.model;
  const int width = rig.sensor.width, height = rig.sensor.height;
  label.whole = Image<std::uint8_t>(width, height);
  const Pose alone_from_world = model.alone_from_model * world_from_model.inverse();
  const Eigen::Vector3d origin = alone_from_world * rig.camera_in_world();
  const PixelBox window = window_of(model, label.camera_from_model, rig.sensor);
  Image<std::uint8_t> silhouette(window.width, window.height);
  for (int y = 0; y < window.height; ++y) {
    const int row = window.y + y;
    const auto in_image = [&](int column) { return column >= 0 && column < width && row >= 0 && row < height; };
    for (int x = 0; x < window.width; x += static_cast<int>(kPacket)) {
      const int end = std::min(x + static_cast<int>(kPacket), window.width);
      std::array<Ray, kPacket> rays;
      std::array<int, kPacket> columns;
      std::size_t count = 0;
      for (int across = x; across < end; ++across) {
        const int column = window.x + across;
        if (in_image(column) && label.visible(column, row) > 0) {
          silhouette(across, y) = 255;
          continue;
        }
        rays[count] = {origin, alone_from_world.linear() * rig.direction_in_world(column + 0.5, row + 0.5)};
        columns[count++] = across;
      }
      const Packet<Hit> hits = count > 0 ? model.alone->first_hits(std::span(rays).first(count)) : Packet<Hit>();
      for (std::size_t i = 0; i < count; ++i)
        if (hits.find(i)) silhouette(columns[i], y) = 255;
      for (int across = x; across < end; ++across) {
        if (!silhouette(across, y)) continue;
        ++label.whole_pixels;
        const int column = window.x + across;
        if (!in_image(column)) continue;
        label.whole(column, row) = 255;
        label.valid += depth(column, row) > 0;
      }
    }
  }
  label.whole_box = box_of(silhouette);
  if (label.whole_box) label.whole_box->x += window.x, label.whole_box->y += window.y;
}

/// 255 where one of two objects is what is seen first.
Image<std::uint8_t> mask_of(int object, int or_object, const Image<int>& first) {
  Image<std::uint8_t> mask(first.width(), first.height());
  std::transform(first.pixels().begin(), first.pixels().end(), mask.pixels().begin(),
                 [=](int seen) { return seen == object || seen == or_object ? std::uint8_t{255} : std::uint8_t{0}; });
  return mask;
}

/// Tenths of a millimetre; 0 where there is nothing, or more than 16 bits hold.
std::uint16_t depth_count(double depth) {
  const double count = depth * (1e3 / kDepthUnitMm) + 0.5;  // a cast cuts off
  return count >= 1.0 && count < 65536.0 ? static_cast<std::uint16_t>(count) : std::uint16_t{0};
}

/// Height above the desk of what a camera without noise measures at a pixel.
double apparent_height(const Rig& rig, int x, int y, double apparent_depth) {
  const Eigen::Vector3d direction = rig.direction_in_world(x + 0.5, y + 0.5);
  const double forward = rig.world_from_camera.linear().col(2).dot(direction);
  return (rig.camera_in_world() + apparent_depth / forward * direction).z();
}

double bottom_height(const Cup& cup) {
  const auto* shape = std::get_if<CupShape>(&cup.shape);
  return shape ? shape->bottom() : liquid_level(cup) - cup.filling->depth;
}

std::optional<LiquidLabel> liquid_of(const Camera& camera, const Image<int>& first, std::size_t index) {
  const Cup& cup = camera.setup().scene.cups[index];
  const std::optional<int> number = camera.geometry().cups[index].liquid;
  if (!cup.filling || !number) return std::nullopt;
  const Rig& rig = camera.setup().rig;
  const Medium& medium = cup.filling->medium;
  LiquidLabel label{.name = medium.name,
                    .is_turbid = medium.scatters(),
                    .index = medium.n(rig.sensor.wavelength_nm),
                    .fill_mm = mm_from_metres(cup.filling->depth),
                    .surface_mm = mm_from_metres(liquid_level(cup)),
                    .bottom_mm = mm_from_metres(bottom_height(cup)),
                    .mask = mask_of(*number, *number, first)};
  label.runs = run_lengths(label.mask);
  std::vector<double> heights;
  const PixelBox box = label.runs.box.value_or(PixelBox{});
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x)
      if (const auto& depth = camera.truth()(x, y).apparent_depth; label.mask(x, y) && depth)
        heights.push_back(mm_from_metres(apparent_height(rig, x, y, *depth)));
  if (!heights.empty()) label.apparent_mm = median(std::move(heights));
  return label;
}

InstanceLabel label_of(const Model& model, std::size_t index, int object, std::optional<int> liquid,
                       const Camera& camera, const FramePixels& pixels) {
  const Rig& rig = camera.setup().rig;
  const Pose world_from_model = camera.geometry().world_from_object.at(object - 1);
  InstanceLabel label{.model = &model,
                      .index = index,
                      .camera_from_model = rig.world_from_camera.inverse() * world_from_model,
                      .visible = mask_of(object, liquid.value_or(object), pixels.first_object)};
  label.visible_runs = run_lengths(label.visible);
  see_alone(world_from_model, rig, pixels.measured, label);
  return label;
}

Json box_entry(const std::optional<PixelBox>& box) {
  return box ? Json{box->x, box->y, box->width, box->height} : Json{-1, -1, -1, -1};
}

}  // namespace

Eigen::Vector2d bop_principal_px(const SensorModel& sensor) {
  return sensor.principal_px - Eigen::Vector2d::Constant(0.5);
}

int RunLengths::area() const {
  int area = 0;
  for (std::size_t i = 1; i < counts.size(); i += 2) area += counts[i];
  return area;
}

RunLengths run_lengths(const Image<std::uint8_t>& mask) {
  RunLengths runs{mask.width(), mask.height(), {}, box_of(mask)};
  int begun = 0;  // where the last run begins
  bool is_inside = false;
  // Around the box all is zero. A run ends in the row below the box, or at the top of the next column.
  const PixelBox box = runs.box.value_or(PixelBox{});
  const int below = box.y + box.height, top = below < mask.height() ? box.y : 0,
            bottom = std::min(below + 1, mask.height()), right = std::min(box.x + box.width + 1, mask.width());
  for (int x = box.x; x < right; ++x)
    for (int y = top; y < bottom; ++y)
      if ((mask(x, y) > 0) != is_inside) {
        const int place = x * mask.height() + y;
        runs.counts.push_back(place - begun);
        begun = place;
        is_inside = !is_inside;
      }
  runs.counts.push_back(static_cast<int>(mask.size()) - begun);
  return runs;
}

FramePixels::FramePixels(const Camera& camera, const Frame& frame) {
  const Image<TruePixel>& truth = camera.truth();
  const Rig& rig = camera.setup().rig;
  const Eigen::Vector3d forward = rig.world_from_camera.linear().col(2), eye = rig.camera_in_world();
  measured = seen = apparent = first = Image<std::uint16_t>(truth.width(), truth.height());
  first_object = Image<int>(truth.width(), truth.height());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TruePixel& pixel = truth.pixels()[i];
    measured.pixels()[i] = depth_count(frame.depth.pixels()[i]);
    seen.pixels()[i] = depth_count(pixel.object > 0 ? forward.dot(pixel.position - eye) : 0.0);
    apparent.pixels()[i] = depth_count(pixel.apparent_depth.value_or(0.0));
    first.pixels()[i] = depth_count(pixel.first_depth);
    first_object.pixels()[i] = pixel.first_object;
  }
}

std::vector<InstanceLabel> label_frame(const Json& scene, const Models& models, const Camera& camera,
                                       const FramePixels& pixels) {
  const Geometry& geometry = camera.geometry();
  std::vector<InstanceLabel> labels;
  for (std::size_t i = 0; i < scene.at("cups").size(); ++i) {
    labels.push_back(
        label_of(models.of_cup(scene["cups"][i]), i, geometry.cups[i].cup, geometry.cups[i].liquid, camera, pixels));
    labels.back().liquid = liquid_of(camera, pixels.first_object, i);
  }
  for (std::size_t i = 0; i < scene.at("objects").size(); ++i)
    labels.push_back(
        label_of(models.of_thing(scene["objects"][i]), i, geometry.things[i], std::nullopt, camera, pixels));
  return labels;
}

Json camera_entry(const Rig& rig) {
  const SensorModel& sensor = rig.sensor;
  const Pose camera_from_world = rig.world_from_camera.inverse();
  const Eigen::Vector2d principal = bop_principal_px(sensor);
  return {{"cam_K", {sensor.focal_px, 0.0, principal.x(), 0.0, sensor.focal_px, principal.y(), 0.0, 0.0, 1.0}},
          {"depth_scale", kDepthUnitMm},
          {"cam_R_w2c", by_rows(camera_from_world.linear())},
          {"cam_t_w2c", json_in_mm(camera_from_world.translation())}};
}

Json pose_entry(const InstanceLabel& instance) {
  return {{"cam_R_m2c", by_rows(instance.camera_from_model.linear())},
          {"cam_t_m2c", json_in_mm(instance.camera_from_model.translation())},
          {"obj_id", instance.model->id}};
}

Json info_entry(const InstanceLabel& instance) {
  const int whole = instance.whole_pixels, visible = instance.visible_runs.area();
  return {{"bbox_obj", box_entry(instance.whole_box)},
          {"bbox_visib", box_entry(instance.visible_runs.box)},
          {"px_count_all", whole},
          {"px_count_valid", instance.valid},
          {"px_count_visib", visible},
          {"visib_fract", whole > 0 ? std::min(1.0, static_cast<double>(visible) / whole) : 0.0}};
}

Json cup_entry(const InstanceLabel& instance, const Cup& cup) {
  const Pose& camera_from_model = instance.camera_from_model;
  const Eigen::AlignedBox3d& box = instance.model->box;
  Json entry = {{"obj_id", instance.model->id},
                {"name", instance.model->name},
                {"box_centre_mm", json_in_mm(camera_from_model * box.center())},
                {"box_size_mm", json_in_mm(box.sizes())},
                {"up", {camera_from_model(0, 2), camera_from_model(1, 2), camera_from_model(2, 2)}}};
  if (const auto* shape = std::get_if<CupShape>(&cup.shape)) {
    entry["rim"] = {{"centre_mm", json_in_mm(camera_from_model * Eigen::Vector3d(0.0, 0.0, shape->height()))},
                    {"inner_radius_mm", mm_from_metres(shape->inner.back().x())},
                    {"outer_radius_mm", mm_from_metres(shape->outer.back().x())}};
    if (const auto& handle = shape->handle) {
      const double middle = 0.5 * (handle->low + handle->high);
      const double out = handle_wall(*shape) + handle->reach;
      entry["handle"] = {{"middle_mm", json_in_mm(camera_from_model * Eigen::Vector3d(out, 0.0, middle))},
                         {"axis", {camera_from_model(0, 0), camera_from_model(1, 0), camera_from_model(2, 0)}},
                         {"tube_radius_mm", mm_from_metres(handle->tube_radius)}};
    }
  }
  if (!instance.liquid) {
    entry["liquid"] = nullptr;
    return entry;
  }
  const LiquidLabel& liquid = *instance.liquid;
  entry["liquid"] = {{"name", liquid.name},
                     {"category", liquid.is_turbid ? "liquid surface" : "liquid seen through"},
                     {"refractive_index", liquid.index},
                     {"fill_mm", liquid.fill_mm},
                     {"surface_height_mm", liquid.surface_mm},
                     {"bottom_height_mm", liquid.bottom_mm},
                     {"apparent_height_mm", liquid.apparent_mm ? Json(*liquid.apparent_mm) : Json()},
                     {"px_count_visib", liquid.runs.area()},
                     {"bbox_visib", box_entry(liquid.runs.box)}};
  return entry;
}

}  // namespace fathom
