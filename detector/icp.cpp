#include "detector/icp.h"

#include <pcl/registration/icp.h>
#include <pcl/search/kdtree.h>

#include <cassert>
#include <cmath>

#include "detector/pcl_points.h"
#include "detector/quiet_pcl.h"

namespace fathom {
namespace {

struct CountingIcp : pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> {
  int iterations() const { return nr_iterations_; }
};

double mean_distance(const PclCloud& from, const PclCloud::ConstPtr& to) {
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(to);
  pcl::Indices nearest(1);
  std::vector<float> squared(1);
  double sum = 0.0;
  for (const pcl::PointXYZ& point : from) {
    tree.nearestKSearch(point, 1, nearest, squared);
    sum += std::sqrt(static_cast<double>(squared[0]));
  }
  return sum / static_cast<double>(from.size());
}

}  // namespace

std::optional<TemplateMatch> match_templates(const Candidate& candidate, const std::vector<CupTemplate>& templates,
                                             const IcpSettings& settings) {
  assert(candidate.circle);
  const QuietPcl quiet;
  const PclCloud::ConstPtr segment = pcl_cloud(in_template_frame(candidate.points, *candidate.circle));
  std::optional<TemplateMatch> best;
  for (std::size_t i = 0; i < templates.size(); ++i) {
    const PclCloud::ConstPtr target = pcl_cloud(templates[i].points);
    CountingIcp icp;
    icp.setInputSource(segment);
    icp.setInputTarget(target);
    icp.setMaximumIterations(settings.iterations_max);
    PclCloud aligned;
    icp.align(aligned);
    const double score = mean_distance(aligned, target);
    if (!best || score < best->score_m) best = TemplateMatch{i, score, icp.iterations()};
  }
  return best;
}

}  // namespace fathom
