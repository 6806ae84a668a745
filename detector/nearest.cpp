#include "detector/nearest.h"

#include <algorithm>
#include <cassert>

namespace fathom {

NearestPoints::NearestPoints(const Points& points) : points_(points) {
  assert(!points.empty());
  build(0, static_cast<int>(points_.size()));
}

int NearestPoints::build(int begin, int end) {
  constexpr int kLeaf = 8;
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({begin, end});
  if (end - begin <= kLeaf) return node;
  Eigen::Array3f low = points_[begin].array(), high = low;
  for (int i = begin; i < end; ++i) low = low.min(points_[i].array()), high = high.max(points_[i].array());
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
                   [axis](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a[axis] < b[axis]; });
  nodes_[node].axis = axis;
  nodes_[node].split = points_[middle][axis];
  build(begin, middle);
  const int right = build(middle, end);
  nodes_[node].right = right;
  return node;
}

void NearestPoints::search(int node, const Eigen::Vector3f& to, float& best, int& index) const {
  const Node& here = nodes_[node];
  if (here.axis < 0) {
    for (int i = here.begin; i < here.end; ++i) {
      const float squared = (points_[i] - to).squaredNorm();
      if (squared < best) best = squared, index = i;
    }
    return;
  }
  const float beyond = to[here.axis] - here.split;
  search(beyond < 0.0f ? node + 1 : here.right, to, best, index);
  if (beyond * beyond < best) search(beyond < 0.0f ? here.right : node + 1, to, best, index);
}

int NearestPoints::nearest(const Eigen::Vector3f& to, int guess) const {
  int index = guess;
  float best = (points_[guess] - to).squaredNorm();
  search(0, to, best, index);
  return index;
}

}  // namespace fathom
