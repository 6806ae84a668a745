// The nearest of a set of points, by nanoflann's k-d tree.
#pragma once

#include <memory>

#include "detector/cloud.h"

namespace fathom {

class NearestPoints {
 public:
  /// At least one point.
  explicit NearestPoints(const Points& points);
  ~NearestPoints();

  const Eigen::Vector3f& point(int index) const;
  /// Index for point(). `guess` is any of them: the nearer it is, the less is looked at.
  int nearest(const Eigen::Vector3f& to, int guess = 0) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace fathom
