#include "bench/ray_recorder.h"

#include <atomic>
#include <limits>

#include "core/parallel.h"
#include "sim/optics/flat_refraction.h"
#include "sim/render/connection.h"

namespace fathom {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

struct Recorder {
  const Intersector& world;
  Eigen::Vector3d projector;
  std::vector<RecordedRay>& rays;
  std::uint64_t hits = 0;

  void add(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double far, RayKind kind, bool hit) {
    const Eigen::Vector3f o = origin.cast<float>(), d = direction.cast<float>();
    rays.push_back({{o.x(), o.y(), o.z()}, {d.x(), d.y(), d.z()}, static_cast<float>(far), kind});
    hits += hit;
  }

  bool add_shadow(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const bool blocked = world.occluded(from, to);
    const Eigen::Vector3d path = to - from;
    add(from, path.normalized(), path.norm() - Intersector::kClearance, RayKind::occluded, blocked);
    return blocked;
  }

  void add_camera_ray(const Ray& ray) {
    add(ray.origin, ray.direction, kForEver, RayKind::camera, world.first_hit(ray).has_value());
  }

  /// see() and illuminate() for one camera ray.
  void add_path(const Ray& camera_ray) {
    add_camera_ray(camera_ray);
    const std::optional<SeenPoint> seen = see(world, camera_ray);
    if (!seen) return;
    if (!seen->around) {
      if (seen->normal.dot(projector - seen->point) > 0.0) add_shadow(seen->point, projector);
      return;
    }
    const double to_surface = (*seen->around->level - camera_ray.origin.z()) / camera_ray.direction.z();
    const Eigen::Vector3d entry = camera_ray.origin + to_surface * camera_ray.direction;
    add(entry, (seen->point - entry).normalized(), kForEver, RayKind::refracted, true);
    add_shadow_through(*seen, *seen->around);
  }

  void add_shadow_through(const SeenPoint& seen, const Body& liquid) {
    const double height = projector.z() - *liquid.level, depth = *liquid.level - seen.point.z();
    if (height <= 0.0 || depth <= 0.0) return;
    const Eigen::Vector2d across = (seen.point - projector).head<2>();
    const double offset = cross_flat_interface(height, depth, across.norm(), 1.0, liquid.medium.n).offset;
    Eigen::Vector3d bend(projector.x(), projector.y(), *liquid.level);
    bend.head<2>() += offset * across.normalized();
    if (seen.normal.dot(bend - seen.point) > 0.0 && !add_shadow(seen.point, bend)) add_shadow(bend, projector);
  }
};

/// Records `rows` rows; `for_each_pixel_of(row, use)` calls use(x_px, y_px) for each of a row's camera rays.
template <class ForEachPixel>
Recording record(const Intersector& world, const Rig& rig, int rows, ForEachPixel for_each_pixel_of) {
  Recording recording{std::vector<std::vector<RecordedRay>>(rows)};
  std::atomic<std::uint64_t> hits = 0;
  parallel_ranges(rows, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      Recorder recorder{world, rig.projector_in_world(), recording.rows[y]};
      for_each_pixel_of(y, [&](double x_px, double y_px) {
        recorder.add_path({rig.camera_in_world(), rig.direction_in_world(x_px, y_px)});
      });
      hits += recorder.hits;
    }
  });
  recording.hits = hits;
  return recording;
}

}  // namespace

std::uint64_t Recording::rays() const {
  std::uint64_t count = 0;
  for (const std::vector<RecordedRay>& row : rows) count += row.size();
  return count;
}

Recording record_truth(const Intersector& world, const Rig& rig) {
  return record(world, rig, rig.sensor.height, [&](int y, auto use) {
    for (int x = 0; x < rig.sensor.width; ++x) use(x + 0.5, y + 0.5);
  });
}

namespace {

/// Calls use(x_px, y_px) for every sample of a row of infrared pixels.
template <class Use>
void for_each_sample(const SensorModel& sensor, int samples_across, int y, Use use) {
  const double px_per_ir_px = 1.0 / sensor.ir_scale();
  for (int x = 0; x < sensor.ir_width; ++x)
    for (int j = 0; j < samples_across; ++j)
      for (int i = 0; i < samples_across; ++i)
        use((x + (i + 0.5) / samples_across) * px_per_ir_px,
            (y - sensor.ir_first_row() + (j + 0.5) / samples_across) * px_per_ir_px);
}

}  // namespace

Recording record_render(const Intersector& world, const Rig& rig, int samples_across) {
  return record(world, rig, rig.sensor.ir_height,
                [&](int y, auto use) { for_each_sample(rig.sensor, samples_across, y, use); });
}

Recording record_camera_rays(const Intersector& world, const Rig& rig, int samples_across) {
  Recording recording{std::vector<std::vector<RecordedRay>>(rig.sensor.ir_height)};
  for (int y = 0; y < rig.sensor.ir_height; ++y) {
    Recorder recorder{world, rig.projector_in_world(), recording.rows[y]};
    for_each_sample(rig.sensor, samples_across, y, [&](double x_px, double y_px) {
      recorder.add_camera_ray({rig.camera_in_world(), rig.direction_in_world(x_px, y_px)});
    });
    recording.hits += recorder.hits;
  }
  return recording;
}

}  // namespace fathom
