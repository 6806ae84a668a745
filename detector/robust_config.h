// Every parameter of the robust method, with the reason for its default.
#pragma once

#include "detector/content_signs.h"
#include "detector/desk.h"
#include "detector/fill.h"
#include "detector/round_wall.h"
#include "detector/segments.h"
#include "detector/surface.h"
#include "detector/vessel_rays.h"

namespace fathom {

/// Which round walls are cups.
struct CupLimits {
  double radius_min_m = 0.020;  ///< as the paper's
  double radius_max_m = 0.060;
  double height_min_m = 0.040;        ///< an espresso cup
  double height_max_m = 0.170;        ///< a half-litre tumbler; bottles and vases are taller
  double lean_max = 0.25;             ///< 14°: cups to stack lean up to 10°, bowls from 18°
  double radius_sigma_max_m = 0.003;  ///< arcs that leave more open do not tell a cup from something wide
  double lid_share_max = 0.10;        ///< of the lines of sight into the opening: mugs show 0 to 3 %, closed things all
  double beyond_share_max = 0.10;     ///< of the lines of sight to the wall: opaque cups let 0 to 4 % through
  double evenness_max = 0.53;         ///< rms over tolerance: 0.58 of points that lie anywhere, mugs 0.3 to 0.45
  int inside_min = 20;                ///< points; fewer do not show that it is open
};

/// Where the bottoms of cups are that no template knows.
struct UsualBottom {
  double height_m = 0.006;  ///< mugs 4 to 8 mm (foot and floor), some 10, paper cups 4 to 7, a measured pot 4.2
  double sigma_m = 0.002;
};

struct RobustConfig {
  DeskSearch desk;
  SegmentSearch segments;
  WallSearch wall;
  VesselRaysSettings rays;
  CupLimits cup;
  SurfaceSettings surface;
  ContentSignSettings signs;
  UsualBottom bottom;
  double baseline_m = 0.075;         ///< between camera and projector: Kinect v1 and Xtion
  double template_radius_m = 0.004;  ///< a cup is a template's if its radius, between two walls 3 mm apart, …
  double template_height_m = 0.006;  ///< … and its height differ by less: the rim is rounded and its pixels mixed
  double template_bottom_sigma_m = 0.0004;  ///< of a template that does not tell: as a mean over several views
  FillSettings fill;
};

}  // namespace fathom
