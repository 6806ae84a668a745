// The nearest of a set of points, by a k-d tree.
#pragma once

#include <vector>

#include "detector/cloud.h"

namespace fathom {

class NearestPoints {
 public:
  /// At least one point.
  explicit NearestPoints(const Points& points);

  const Eigen::Vector3f& point(int index) const { return points_[index]; }
  /// Index for point(). `guess` is any of them: the nearer it is, the less is looked at.
  int nearest(const Eigen::Vector3f& to, int guess = 0) const;

 private:
  struct Node {
    int begin, end;   ///< of its points
    int axis = -1;    ///< −1: a leaf
    float split = 0;  ///< left of it the next node's, right of it those of `right`
    int right = 0;
  };
  int build(int begin, int end);
  void search(int node, const Eigen::Vector3f& to, float& best, int& index) const;

  Points points_;  ///< in the order of the leaves
  std::vector<Node> nodes_;
};

}  // namespace fathom
