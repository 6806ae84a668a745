#include "detector/nearest.h"

#include <cassert>
#include <nanoflann.hpp>

namespace fathom {
namespace {

/// As nanoflann asks for them.
struct TreePoints {
  Points points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t index, std::size_t axis) const { return points[index][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // it finds it itself
  }
};

/// One result that is there from the beginning, so that a search starts within its distance.
struct NearestOne {
  float squared;
  int index;

  bool full() const { return true; }
  float worstDist() const { return squared; }
  bool addPoint(float other, int at) {
    if (other < squared) squared = other, index = at;
    return true;
  }
};

constexpr int kLeaf = 8;

}  // namespace

struct NearestPoints::Tree {
  explicit Tree(const Points& of) : dataset{of}, index(3, dataset, nanoflann::KDTreeSingleIndexAdaptorParams(kLeaf)) {}

  TreePoints dataset;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePoints, float, int>, TreePoints, 3, int>
      index;
};

NearestPoints::NearestPoints(const Points& points) : tree_(std::make_unique<Tree>(points)) { assert(!points.empty()); }

NearestPoints::~NearestPoints() = default;

const Eigen::Vector3f& NearestPoints::point(int index) const { return tree_->dataset.points[index]; }

int NearestPoints::nearest(const Eigen::Vector3f& to, int guess) const {
  NearestOne best{(point(guess) - to).squaredNorm(), guess};
  tree_->index.findNeighbors(best, to.data(), nanoflann::SearchParams());
  return best.index;
}

}  // namespace fathom
