// Ways of light that pixels have in common. What leads to one point of a surface leads, a little aside, to the next. So
// ways are searched for at the corners of a grid in the image, and followed from there to what is seen in between,
// which takes a fraction of the time.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "core/image.h"
#include "sim/render/connection.h"

namespace fathom {

class NearbyWays {
 public:
  /// Which places and ways are asked for.
  struct Scope {
    bool images;          ///< what is seen in the first mirror image, too
    bool mirrored_light;  ///< light that an interface reflects in part, too
  };

  /// `camera_ray`: through a place in the image [px]. Keeps a reference to the projector, which must outlive it.
  NearbyWays(const PointLight& projector, std::function<Ray(double x, double y)> camera_ray, int width, Scope scope);

  /// Searches for the ways of the rows begin … end − 1; others are forgotten. The same for any number of threads.
  void prepare(int begin, int end);

  /// How all ways to `seen` start, but for the straight one. It stands, `in_image` or not, at a place of a row that is
  /// prepared. Nothing where the corners around it see another surface.
  std::optional<std::vector<Start>> starts(Ways ways, bool in_image, double x, double y, const SeenPoint& seen) const;

 private:
  /// Between the corners [px]: light that finds room between them may be missed.
  static constexpr int kApart = 2;

  struct Corner {
    std::optional<SeenPoint> seen;
    std::array<std::vector<Connection>, 2> ways;  ///< by Ways
  };
  void search_row(int row);
  Corner corner(const std::optional<SeenPoint>& seen) const;

  const PointLight& projector_;
  std::function<Ray(double, double)> camera_ray_;
  Scope scope_;
  int columns_;
  int first_row_ = 0;
  std::array<Image<Corner>, 2> corners_;  ///< seen straight, and in the first mirror image
};

}  // namespace fathom
