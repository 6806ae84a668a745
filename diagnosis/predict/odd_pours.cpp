#include "diagnosis/predict/odd_pours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/median.h"
#include "diagnosis/predict/predictor.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

/// One placement: how far its heights are off the prediction.
struct Stand {
  Factors factors;  ///< without a region
  std::vector<double> off_mm{};
  double shift_mm() const { return median(off_mm); }
};

/// What stands in time between other fillings.
struct Pour {
  std::vector<Stand> stands;

  const Factors& factors() const { return stands.front().factors; }
  double shift_mm() const {
    std::vector<double> shifts_mm;
    for (const Stand& stand : stands) shifts_mm.push_back(stand.shift_mm());
    return median(shifts_mm);
  }
};

/// Pours of one filling.
struct Poured {
  std::vector<Pour> pours;

  /// From the middle of all pours.
  double departure_mm(const Pour& pour) const {
    std::vector<double> shifts_mm;
    for (const Pour& one : pours) shifts_mm.push_back(one.shift_mm());
    return pour.shift_mm() - median(shifts_mm);
  }
};

/// In the order of time.
std::vector<Stand> stands_of(const Measurement& measurement, const Json& model_effects, const std::string& file) {
  std::vector<Observation> heights;
  for (const Observation& o : measurement.observations)
    if (o.observable == "height_mm" && o.factors.liquid != "none") heights.push_back(o);
  if (heights.empty()) return {};
  const Eigen::VectorXd predicted = Predictor(measurement.rig, heights, model_effects, file).predict({});
  std::map<std::string, Stand> stands;
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (const double off_mm = heights[i].value - predicted[static_cast<Eigen::Index>(i)]; std::isfinite(off_mm))
      stands.try_emplace(placement_key(heights[i]), Stand{heights[i].factors}).first->second.off_mm.push_back(off_mm);
  std::vector<Stand> in_time;
  for (auto& [key, stand] : stands) in_time.push_back(std::move(stand));
  std::sort(in_time.begin(), in_time.end(), [](const Stand& a, const Stand& b) {
    const auto when = [](const Factors& f) { return std::tuple(f.session, f.time_s, f.placement); };
    return when(a.factors) < when(b.factors);
  });
  return in_time;
}

std::vector<Pour> pours_of(std::vector<Stand> in_time) {
  std::vector<Pour> pours;
  for (Stand& stand : in_time) {
    if (pours.empty() || pour_of(pours.back().factors()) != pour_of(stand.factors)) pours.emplace_back();
    pours.back().stands.push_back(std::move(stand));
  }
  return pours;
}

std::vector<Poured> by_filling(std::vector<Pour> pours) {
  std::map<std::pair<std::string, double>, Poured> fillings;
  for (Pour& pour : pours) {
    const Factors& f = pour.factors();
    fillings[{f.liquid, f.fill_mm}].pours.push_back(std::move(pour));
  }
  std::vector<Poured> result;
  for (auto& [filling, poured] : fillings) result.push_back(std::move(poured));
  return result;
}

bool is_alike_everywhere(const Pour& pour, double departure_mm) {
  constexpr std::size_t kFewestStands = 2;
  constexpr double kAlike = 1.0 / 3.0;  // of the departure: a clear liquid's depth goes by the angle
  const double shift_mm = pour.shift_mm();
  return pour.stands.size() >= kFewestStands &&
         std::all_of(pour.stands.begin(), pour.stands.end(), [&](const Stand& stand) {
           return std::abs(stand.shift_mm() - shift_mm) < kAlike * std::abs(departure_mm);
         });
}

struct OddPour {
  const Pour* pour;
  double departure_mm;
};

/// Pours that are beyond doubt none of what they are called.
std::vector<OddPour> odd_pours(const std::vector<Poured>& fillings) {
  constexpr double kLeast_mm = 5.0, kScatters = 10.0;
  constexpr std::size_t kOthers = 2;  // times as many must be left
  const auto are_few = [](std::size_t few, std::size_t all) { return few + kOthers * few <= all; };
  std::vector<OddPour> all_odd;
  double squares_mm2 = 0.0;
  std::size_t all = 0;
  for (const Poured& filling : fillings) {
    if (!are_few(1, filling.pours.size())) continue;
    std::vector<OddPour> odd;
    for (const Pour& pour : filling.pours) {
      const double departure_mm = filling.departure_mm(pour);
      if (std::abs(departure_mm) > kLeast_mm && is_alike_everywhere(pour, departure_mm))
        odd.push_back({&pour, departure_mm});
      else
        squares_mm2 += departure_mm * departure_mm;
    }
    if (!are_few(odd.size(), filling.pours.size())) return {};
    all += filling.pours.size();
    all_odd.insert(all_odd.end(), odd.begin(), odd.end());
  }
  if (all_odd.empty()) return {};
  const double scatter_mm = std::sqrt(squares_mm2 / static_cast<double>(all - all_odd.size()));
  std::erase_if(all_odd, [&](const OddPour& odd) { return std::abs(odd.departure_mm) < kScatters * scatter_mm; });
  return all_odd;
}

Mistake mistake_of(const OddPour& odd) {
  const Factors& f = odd.pour->factors();
  return {"wrong_pour", fmt::format("Pour {} of {} {} mm, {} placements from number {} on, reads {:.1f} mm {} than the "
                                    "others of it: another filling or another cup, and left out.",
                                    f.pour, f.liquid, f.fill_mm, odd.pour->stands.size(), f.placement,
                                    std::abs(odd.departure_mm), odd.departure_mm > 0.0 ? "higher" : "lower")};
}

}  // namespace

void leave_out_odd_pours(const Json& model_effects, const std::string& file, Measurement& measurement) {
  const std::vector<Poured> fillings = by_filling(pours_of(stands_of(measurement, model_effects, file)));
  std::set<std::string> left_out;
  for (const OddPour& odd : odd_pours(fillings)) {
    measurement.mistakes.push_back(mistake_of(odd));
    for (const Stand& stand : odd.pour->stands) left_out.insert(placement_key({"", stand.factors}));
  }
  std::erase_if(measurement.observations, [&](const Observation& o) { return left_out.contains(placement_key(o)); });
}

}  // namespace fathom
