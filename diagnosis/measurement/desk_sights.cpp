#include "diagnosis/measurement/desk_sights.h"

#include "core/units.h"

namespace fathom {

void DeskSights::add(const FrameRecord& frame, const DeskCells& cells) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * kBiasCell_px);
  for (const BiasCell& cell : cells.view().cells) {
    Eigen::AlignedBox2d& box =
        boxes_[{frame.bare_desk(), mm_from_metres(frame.distance_m), mm_from_metres(frame.lateral_m)}];
    box.extend(Eigen::Vector2d(cell.pixel_px() - half));
    box.extend(Eigen::Vector2d(cell.pixel_px() + half));
  }
}

void DeskSights::add(const DeskSights& others) {
  for (const auto& [place, box] : others.boxes_) boxes_[place].extend(box);
}

std::optional<Eigen::AlignedBox2d> DeskSights::at(const Factors& factors) const {
  const auto found = boxes_.find({factors.liquid == "none", factors.distance_mm, factors.lateral_mm});
  if (found == boxes_.end()) return std::nullopt;
  return found->second;
}

}  // namespace fathom
