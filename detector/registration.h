// What the paper compares with: segments are aligned to templates by descriptors of their shape (FPFH, Rusu et al.
// 2009), with sample consensus over correspondences.
#pragma once

#include "detector/detector.h"

namespace fathom {

/// SAC-IA (Rusu et al. 2009), the paper's baseline.
Detection detect_sac_ia(const Cloud& cloud, const DetectorSettings& settings);

/// Prerejective RANSAC (Buch et al. 2013): poses whose sampled edges differ in length are dropped early.
Detection detect_prerejective(const Cloud& cloud, const DetectorSettings& settings);

}  // namespace fathom
