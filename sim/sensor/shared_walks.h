// Walks that pixels share with their neighbours. Light that is scattered back to two pixels side by side goes nearly
// the same ways, so each walk stands for all pixels around the one that it starts from.
//   Out of a body that scatters the ways of a pixel are its neighbour's, a little to the side. They meet other dots,
//   which make most of a walk's noise.
//   On a diffuse surface light arrives from the same places, and is as bright. So it is on one that is seen mirrored.
// Not shared: light out of liquids so thin that dots are seen through them, and that of scenes with glazes, which throw
// sharp dots.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/image.h"
#include "sim/render/connection.h"
#include "sim/scene/rig.h"
#include "sim/sensor/blurred_pattern.h"
#include "sim/sensor/spread_dots.h"

namespace fathom {

/// Who walks, and for whom.
struct WalkSharing {
  int stride;         ///< of the pixels that walk into bodies, along rows and columns [px]
  int aside;          ///< pixels to each side for which such a walk counts …
  float farthest_m;   ///< … but no farther
  int knot_distance;  ///< pixels between the knots at which the dots that all walks around show are worked out
  /// Only pairs on opposite sides count, pixels at edges walk for themselves, and diffuse surfaces share as well;
  /// otherwise these are left out.
  bool is_exact;
};
/// More pixels that share take out more chance; but the light of places farther apart is less alike.
inline constexpr WalkSharing kFineSharing{1, 9, 0.0055f, 4, true};
/// Some thousand walks for a cup, each of which counts for much of its surface.
inline constexpr WalkSharing kCoarseSharing{6, 48, 0.024f, 24, false};

class SharedWalks {
 public:
  /// How a pixel sees a point: along its ray, or mirrored in what the ray meets.
  enum Look { straight, mirrored };

  /// Keeps references to its arguments, which must outlive it. Same seed, same walks, for any number of threads.
  /// `rows_at_once`: at most as many are prepared in one call.
  SharedWalks(const PointLight& projector, const Rig& rig, const BlurredPattern& pattern, const WalkSharing& sharing,
              std::uint64_t seed, int rows_at_once);

  /// Prepares the rows begin … end − 1 of the infrared image; those of the call before are forgotten, but for what both
  /// need where one follows the other. Walks from the middles of pixels: three to twelve from each that sees a body
  /// that scatters, one from every second one in both directions of those that see a diffuse surface.
  void prepare(int begin, int end);

  /// What walk_light() estimates: radiance [DN] of `seen`, which sample number `sample` of `samples` of an infrared
  /// pixel sees. It is a mean over the pixels around it that see the same surface, as level and as lit, in pairs on
  /// opposite sides, so that what changes steadily over the surface cancels. The samples of a pixel share them out.
  /// Nothing where there is no such pixel or nothing is shared.
  std::optional<double> radiance(Look look, int x, int y, int sample, int samples, const SeenPoint& seen) const;

  /// [m] For walk_light(): of a walk into a body.
  double near_start(const SeenPoint& seen) const { return kNear * dots_apart(seen); }

 private:
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

  /// Grid steps from where light enters a body, beyond which what returns shows dots too wide to be told apart.
  static constexpr double kNear = 1.5;

  double dots_apart(const SeenPoint& seen) const;  ///< [m]
  Entry entry_of(const SeenPoint& seen) const;
  bool is_thin(const SeenPoint& seen) const;
  /// On the pattern's grid, of the straight way from the projector to a point.
  std::optional<Eigen::Vector2d> straight_way(const Eigen::Vector3d& point) const;
  void walk_row(int y);
  void walk(Look look, int x, int y, const SeenPoint& seen);
  /// Diffuse surfaces: every second pixel of every second row by the walks around it, then the others by these.
  void share_row(Look look, int y);
  void fill_row(Look look, int y);
  /// Mean over gain of the walks around a pixel on a diffuse surface; kUnknown where there are none.
  float walked_around(Look look, int x, int y) const;
  void tie_knots(int begin, int end);
  std::optional<SpreadDots> knot(int x, int y) const;
  /// Radiance over gain from the four knots around a pixel, if all of them are like it, or any where that is enough.
  std::optional<double> between_knots(int x, int y, const Entry& to, const Eigen::Vector2d& way) const;
  double from_body(const Entry& entry, int y, const Eigen::Vector2d& way) const;
  /// Of a pixel in a row that is there.
  Entry& entry(Look look, int x, int y) { return entries_[look](x, y % entries_[look].height()); }
  char& holds_any(Look look, int y) { return holds_any_[look][y % holds_any_[look].size()]; }
  const Entry& entry(Look look, int x, int y) const { return entries_[look](x, y % entries_[look].height()); }
  const Entry* alike(Look look, int x, int y, const Entry& to) const;
  /// The pixels around (x, y) that are like `to`, of those that lie at distances of this part: 0 … parts − 1, by their
  /// parities. `visit(entry, row)`.
  template <class Visit>
  void for_each_pair(Look look, int x, int y, const Entry& to, int part, int parts, Visit visit) const;
  /// Mean over them of `value(entry, row)`.
  template <class Value>
  std::optional<double> mean_around(Look look, int x, int y, const Entry& to, int part, int parts, Value value) const;

  int aside_of(const Entry& entry) const;
  /// Radiance over gain of what is like `to`, as the pixel (x, y) has it.
  std::optional<double> mean_at(Look look, int x, int y, int sample, int samples, const Entry& to) const;

  const PointLight& projector_;
  const Rig& rig_;
  const BlurredPattern& pattern_;
  WalkSharing sharing_;
  int room_;  ///< rows above and below those that are asked for, of which they make use
  std::uint64_t seed_;
  bool has_glaze_;
  int prepared_ = 0;                ///< rows up to this one
  int walked_ = 0, forgotten_ = 0;  ///< the same
  int width_, height_;
  std::array<Image<Entry>, 2> entries_;  ///< by Look, of the rows that are there: row y lies at y modulo their number
  /// Which of these rows hold any: in most nothing is seen mirrored, and their memory is left alone.
  std::array<std::vector<char>, 2> holds_any_;
  std::vector<std::vector<SpreadLight>> rows_;  ///< over the transmittance to the camera
  int first_knot_row_ = 0;                      ///< of the rows that are prepared
  Image<std::optional<SpreadDots>> knots_;
};

}  // namespace fathom
