#include "sim/scene/surface_shape.h"

namespace fathom {

Implicit implicit(const Cone& cone, const Eigen::Vector3d& point) {
  const Eigen::Vector2d from_axis = point.head<2>() - cone.axis;
  const double rho = from_axis.norm();
  const Eigen::Vector2d out = from_axis / rho;
  Implicit result{
      rho - cone.radius_at_desk - cone.slope * point.z(), {out.x(), out.y(), -cone.slope}, Eigen::Matrix3d::Zero()};
  result.hessian.topLeftCorner<2, 2>() = (Eigen::Matrix2d::Identity() - out * out.transpose()) / rho;
  return result;
}

Implicit implicit(const LiquidTop& top, const Eigen::Vector3d& point) {
  const LiquidTop::Height height = top.at(point.head<2>());
  Implicit result{point.z() - height.z, {-height.gradient.x(), -height.gradient.y(), 1.0}, Eigen::Matrix3d::Zero()};
  result.hessian.topLeftCorner<2, 2>() = -height.hessian;
  return result;
}

}  // namespace fathom
