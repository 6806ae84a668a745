// The liquid's surface as a height field.
#pragma once

#include <Eigen/Core>

#include "blind/world.h"

namespace fathom::blind {

struct Slope {
  double z;       ///< above the desk [m]
  double dx, dy;  ///< of z
};

/// At a place relative to the cup's axis.
Slope liquid_top(const World& world, const Eigen::Vector2d& place);

/// The cup's bottom there: a paraboloid whose edge is at Cup::bottom.
Slope cup_bottom(const Cup& cup, const Eigen::Vector2d& place);

/// Whether bubbles cover the surface there: cells of 6 mm, of which a share is covered.
bool is_foam(const World& world, const Eigen::Vector2d& place);

}  // namespace fathom::blind
