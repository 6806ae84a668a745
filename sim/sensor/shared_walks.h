// Walks that pixels share with their neighbours. Light that is scattered back to two pixels side by side goes nearly
// the same ways, so each walk stands for all pixels around the one that it starts from.
//   Out of a body that scatters the ways of a pixel are its neighbour's, a little to the side. They meet other dots,
//   which make most of a walk's noise.
//   On a diffuse surface light arrives from the same places, and is as bright.
// Not shared: light out of liquids so thin that dots are seen through them, and that of scenes with glazes, which throw
// sharp dots.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"
#include "sim/render/connection.h"
#include "sim/scene/rig.h"
#include "sim/sensor/blurred_pattern.h"

namespace fathom {

class SharedWalks {
 public:
  /// Keeps references to its arguments, which must outlive it. Same seed, same walks, for any number of threads.
  SharedWalks(const PointLight& projector, const Rig& rig, const BlurredPattern& pattern, std::uint64_t seed);

  /// Prepares the rows begin … end − 1 of the infrared image, which follow those of the call before; what
  /// only they needed is forgotten. Walks from the middles of pixels: two to eight from each that sees a body that
  /// scatters, one from every second one in both directions of those that see a diffuse surface.
  void prepare(int begin, int end);

  /// What walk_light() estimates: radiance [DN] of `seen`, which sample number `sample` of `samples` of an infrared
  /// pixel sees. It is a mean over the pixels around it that see the same surface, as level and as lit, in pairs on
  /// opposite sides, so that what changes steadily over the surface cancels. The samples of a pixel share them out.
  /// Nothing where there is no such pixel or nothing is shared.
  std::optional<double> radiance(int x, int y, int sample, int samples, const SeenPoint& seen) const;

 private:
  /// Light that returned out of a body, as it would to any pixel.
  struct Returned {
    float dx_steps, dy_steps;  ///< on the pattern's grid, from where the projector's straight way to the pixel lies
    float dn;                  ///< radiance over the transmittance to the camera, for dots of intensity 1
    float blur_steps;
  };
  static constexpr int kNothing = -1;
  /// What a pixel's middle sees.
  struct Entry {
    int object = kNothing;  ///< also where nothing can be shared
    bool is_lit = false;    ///< of a body: nothing opaque stands in the projector's straight way
    const Body *entered = nullptr, *around = nullptr;
    Eigen::Vector3f point = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::Zero();
    std::uint32_t first = 0, last = 0;  ///< of a body: light in its row
    float walked = 0.0f;      ///< of a diffuse surface: radiance [DN] over albedo and transmittance, by its own walks
    float shared = kUnknown;  ///< the same with its neighbours'
  };
  static constexpr float kUnknown = -1.0f;

  Entry entry_of(const SeenPoint& seen) const;
  bool is_thin(const SeenPoint& seen) const;
  /// On the pattern's grid, of the straight way from the projector to a point.
  std::optional<Eigen::Vector2d> straight_way(const Eigen::Vector3d& point) const;
  void walk_row(int y);
  void walk(int x, int y, const SeenPoint& seen);
  void share_row(int y);
  double from_body(const Entry& entry, int y, const Eigen::Vector2d& way) const;
  const Entry* alike(int x, int y, const Entry& to) const;
  /// Mean over the pixels around (x, y) that are like `to`, of those that lie at distances of this part: 0 … parts − 1,
  /// by their parities. `value(entry, row)`.
  template <class Value>
  std::optional<double> mean_around(int x, int y, const Entry& to, int part, int parts, Value value) const;

  int aside_of(const Entry& entry) const;

  const PointLight& projector_;
  const Rig& rig_;
  const BlurredPattern& pattern_;
  std::uint64_t seed_;
  bool has_glaze_;
  int walked_ = 0, forgotten_ = 0;  ///< rows so far
  Image<Entry> entries_;
  std::vector<std::vector<Returned>> rows_;
};

}  // namespace fathom
