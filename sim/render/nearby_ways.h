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
  using Look = std::function<std::optional<SeenPoint>(double x, double y)>;

  /// `look`: what is seen at a place in the image [px]. `mirrored`: whether light is searched for that an interface
  /// reflects in part, too. Keeps a reference to the projector, which must outlive it.
  NearbyWays(const PointLight& projector, Look look, int width, bool mirrored);

  /// Searches for the ways of the rows begin … end − 1; others are forgotten. The same for any number of threads.
  void prepare(int begin, int end);

  /// How all ways to `seen`, which stands at a place of a row that is prepared, start; but for the straight one.
  /// Nothing where the corners around it see another surface.
  std::optional<std::vector<Start>> starts(Ways ways, double x, double y, const SeenPoint& seen) const;

 private:
  /// Between the corners [px]: light that finds room between them may be missed.
  static constexpr int kApart = 2;

  struct Corner {
    std::optional<SeenPoint> seen;
    std::array<std::vector<Connection>, 2> ways;  ///< by Ways
  };
  Corner corner(double x, double y) const;

  const PointLight& projector_;
  Look look_;
  bool mirrored_;
  int columns_;
  int first_row_ = 0;
  Image<Corner> corners_;
};

}  // namespace fathom
