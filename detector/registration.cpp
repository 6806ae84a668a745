#include "detector/registration.h"

#include <fmt/format.h>
#include <pcl/features/normal_3d.h>
#include <pcl/registration/ia_ransac.h>
#include <pcl/registration/sample_consensus_prerejective.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/units.h"
#include "detector/fpfh.h"
#include "detector/judge_segments.h"
#include "detector/nearest.h"
#include "detector/pcl_points.h"
#include "detector/quiet_pcl.h"

namespace fathom {
namespace {

using Descriptors = pcl::PointCloud<pcl::FPFHSignature33>;

struct Described {
  PclCloud::Ptr points;
  Descriptors::Ptr descriptors;
};

Described describe(const Points& points, const RegistrationConfig& config) {
  const PclCloud::Ptr all = pcl_cloud(points);
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  const auto normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(all);
  estimation.setSearchMethod(tree);
  estimation.setRadiusSearch(config.normal_radius_m);
  estimation.compute(*normals);

  Described result{std::make_shared<PclCloud>(), std::make_shared<Descriptors>()};
  Points kept;  // normals
  for (std::size_t i = 0; i < all->size(); ++i) {
    if (!std::isfinite((*normals)[i].normal_x)) continue;  // too few neighbours
    result.points->push_back((*all)[i]);
    kept.emplace_back((*normals)[i].getNormalVector3fMap());
  }
  if (result.points->empty()) return result;
  tree->setInputCloud(result.points);
  std::vector<std::vector<Neighbour>> neighbours(result.points->size());
  std::vector<int> indices;
  std::vector<float> squared_distances;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    tree->radiusSearch(static_cast<int>(i), config.feature_radius_m, indices, squared_distances);
    for (std::size_t k = 0; k < indices.size(); ++k) neighbours[i].push_back({indices[k], squared_distances[k]});
  }
  for (const Fpfh& histograms : fast_point_feature_histograms(points_from(*result.points), kept, neighbours))
    std::copy(histograms.begin(), histograms.end(), result.descriptors->emplace_back().histogram);
  return result;
}

/// What both methods are given.
template <class Consensus>
void set_pair(const Described& known, const Described& segment, const RegistrationConfig& config, Consensus& sac) {
  std::srand(1);  // PCL draws by it
  sac.setInputSource(known.points);
  sac.setSourceFeatures(known.descriptors);
  sac.setInputTarget(segment.points);
  sac.setTargetFeatures(segment.descriptors);
  sac.setMaxCorrespondenceDistance(config.score_max_m);
}

/// Pose of the template in the segment's frame, whatever it is worth.
using Register = Eigen::Matrix4f (*)(const Described& known, const Described& segment, const RegistrationConfig&);

Eigen::Matrix4f register_sac_ia(const Described& known, const Described& segment, const RegistrationConfig& config) {
  pcl::SampleConsensusInitialAlignment<pcl::PointXYZ, pcl::PointXYZ, pcl::FPFHSignature33> sac;
  set_pair(known, segment, config, sac);
  sac.setMinSampleDistance(0.02f);
  sac.setMaximumIterations(config.iterations);
  PclCloud aligned;
  sac.align(aligned);
  return sac.getFinalTransformation();
}

Eigen::Matrix4f register_prerejective(const Described& known, const Described& segment,
                                      const RegistrationConfig& config) {
  pcl::SampleConsensusPrerejective<pcl::PointXYZ, pcl::PointXYZ, pcl::FPFHSignature33> sac;
  set_pair(known, segment, config, sac);
  sac.setNumberOfSamples(3);
  sac.setCorrespondenceRandomness(5);
  sac.setSimilarityThreshold(0.9f);
  sac.setInlierFraction(0.25f);
  sac.setMaximumIterations(10 * config.iterations);  // most are dropped before they cost anything
  PclCloud aligned;
  sac.align(aligned);
  return sac.hasConverged() ? sac.getFinalTransformation() : Eigen::Matrix4f(Eigen::Matrix4f::Zero());
}

struct Placed {
  std::size_t index;  ///< of the template
  double score_m;     ///< mean distance of the segment's points from the template
  Eigen::Isometry3d desk_from_template;
};

std::optional<Placed> place_templates(const Points& segment, const std::vector<CupTemplate>& templates,
                                      const RegistrationConfig& config, Register align) {
  const QuietPcl quiet;
  const Points thin = thinned(segment);
  const Described seen = describe(thin, config);
  constexpr std::size_t kFewest = 20;  // points that descriptors can be told apart by
  if (seen.points->size() < kFewest) return std::nullopt;
  std::optional<Placed> best;
  for (std::size_t i = 0; i < templates.size(); ++i) {
    const Eigen::Matrix4f pose = align(describe(templates[i].points, config), seen, config);
    if (pose.isZero()) continue;
    Eigen::Isometry3d placed;
    placed.matrix() = pose.cast<double>();
    const Eigen::Isometry3f back = placed.inverse().cast<float>();
    const NearestPoints target(templates[i].points);
    double sum = 0.0;
    for (const Eigen::Vector3f& point : thin) {
      const Eigen::Vector3f in_template = back * point;
      sum += (target.point(target.nearest(in_template)) - in_template).norm();
    }
    const double score = sum / static_cast<double>(thin.size());
    if (!best || score < best->score_m) best = Placed{i, score, placed};
  }
  return best;
}

Placement place_by_registration(CupCandidate candidate, const std::vector<CupTemplate>& templates,
                                const RegistrationConfig& config, Register align) {
  const auto placed = place_templates(candidate.points, templates, config, align);
  if (!placed || placed->score_m > config.score_max_m) {
    candidate.rejected =
        placed ? fmt::format("mean distance {:.1f} mm from {} is above {:g} mm", mm_from_metres(placed->score_m),
                             templates[placed->index].name, mm_from_metres(config.score_max_m))
               : "no template can be aligned";
    return RejectedSegment{std::move(candidate), std::nullopt};
  }
  const Eigen::Vector2d foot = placed->desk_from_template.translation().head<2>();
  candidate.circle = Circle{foot, templates[placed->index].radius_m, 0.0};
  candidate.rejected.clear();
  return PlacedCup{std::move(candidate), {placed->index, placed->score_m, config.iterations}};
}

Detection detect_by(const Cloud& cloud, const DetectorSettings& settings, Register align) {
  return judge_segments(cloud, settings, "aligned to", [&](CupCandidate candidate) {
    return place_by_registration(std::move(candidate), settings.templates, settings.registration, align);
  });
}

}  // namespace

Detection detect_sac_ia(const Cloud& cloud, const DetectorSettings& settings) {
  return detect_by(cloud, settings, register_sac_ia);
}

Detection detect_prerejective(const Cloud& cloud, const DetectorSettings& settings) {
  return detect_by(cloud, settings, register_prerejective);
}

}  // namespace fathom
