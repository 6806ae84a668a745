// The parts of what is seen in a cup and on the desk that are looked at apart. Measured and predicted points alike.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/cup_profile.h"

namespace fathom {

/// Within the radius that heights are taken in: a disc of half of it, and four sectors of the ring around.
enum class CupRegion { centre, near, far, left, right };
inline constexpr std::array<std::string_view, 5> kCupRegionNames{"centre", "near", "far", "left", "right"};
inline constexpr std::string_view kWholeInterior = "interior";
inline constexpr double kInteriorMargin = 0.010;  ///< [m] from the inner wall, as the heights' definition has it

/// [m] in which heights are taken: clear of the inner wall at every height, be it seen through a liquid. Nothing is
/// left of a cup that is narrower than the margin.
inline double interior_radius(const CupProfile& cup) { return std::max(cup.narrowest() - kInteriorMargin, 0.0); }

/// A raster of squares that covers the same disc, row by row from the near left: small enough for a bump.
inline constexpr int kCupCellsAcross = 5;
inline constexpr int kCupCells = kCupCellsAcross * kCupCellsAcross;

/// Middle of a cell, in radii of the disc: to the right and far.
inline Eigen::Vector2d middle_of_cell(int cell) {
  constexpr double kWidth = 2.0 / kCupCellsAcross;
  return {kWidth * (cell % kCupCellsAcross + 0.5) - 1.0, kWidth * (cell / kCupCellsAcross + 0.5) - 1.0};
}

/// The cell of a point `from_axis` [m] on the desk; -1 outside of the disc.
inline int cup_cell_of(const Eigen::Vector2d& from_axis, double radius) {
  if (!(from_axis.squaredNorm() < radius * radius)) return -1;
  const auto part = [&](double along) {
    return std::clamp(static_cast<int>(0.5 * kCupCellsAcross * (along / radius + 1.0)), 0, kCupCellsAcross - 1);
  };
  return kCupCellsAcross * part(from_axis.y()) + part(from_axis.x());
}

/// Thirds of the image, row by row.
inline constexpr std::array<std::string_view, 9> kDeskRegionNames{
    "top left", "top", "top right", "left", "middle", "right", "bottom left", "bottom", "bottom right"};

/// Shares that a point has in the regions; `from_axis` [m] on the desk. Borders are `soft` [m] wide, so that a few
/// samples, each standing for an area of that width, cover a region as all points of a cloud do.
inline std::array<double, 5> shares_of_regions(const Eigen::Vector2d& from_axis, double radius, double soft) {
  const auto step = [soft](double inside) {
    return soft > 0.0 ? std::clamp(inside / soft + 0.5, 0.0, 1.0) : (inside > 0.0 ? 1.0 : 0.0);
  };
  constexpr double kDiagonal = 0.70710678118654752;
  const double rho = from_axis.norm();
  const double within = step(radius - rho), central = std::min(step(0.5 * radius - rho), within);
  const double ring = within - central;
  const double one = step(kDiagonal * (from_axis.y() - from_axis.x())),
               other = step(kDiagonal * (from_axis.y() + from_axis.x()));
  return {central, ring * (1.0 - one) * (1.0 - other), ring * one * other, ring * one * (1.0 - other),
          ring * (1.0 - one) * other};
}

/// A height with the share of its point that lies in a region.
struct SharedHeight {
  float height, weight;
};

/// Their weighted median; sorts them. There must be one.
inline float middle_height(std::vector<SharedHeight>& heights) {
  std::sort(heights.begin(), heights.end(), [](const auto& a, const auto& b) { return a.height < b.height; });
  double all = 0.0, below = 0.0;
  for (const SharedHeight& one : heights) all += one.weight;
  for (const SharedHeight& one : heights)
    if ((below += one.weight) >= 0.5 * all) return one.height;
  return heights.back().height;
}

}  // namespace fathom
