#include "diagnosis/predict/bookkeeping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/json.h"
#include "core/median.h"
#include "core/units.h"
#include "diagnosis/predict/predictor.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {
namespace {

/// What the notes mean in a case: the factors as they should have been.
using Reading = std::function<Factors(Factors)>;

/// Session, liquid and fill [mm] as written down.
using FillingKey = std::tuple<int, std::string, double>;
FillingKey filling_of(const Factors& factors) { return {factors.session, factors.liquid, factors.fill_mm}; }
int session_of(const Factors& factors) { return factors.session; }

/// " of session 1" where all its fillings are, " of 2 and 4 mm" where other fillings of it are not, nothing where all
/// are.
std::string whose(const std::set<FillingKey>& wrong, const std::set<FillingKey>& all) {
  if (wrong == all) return {};
  std::set<int> sessions;
  std::set<double> fills_mm;
  for (const auto& [session, liquid, fill_mm] : wrong) sessions.insert(session), fills_mm.insert(fill_mm);
  const bool is_whole_sessions = std::all_of(all.begin(), all.end(), [&](const FillingKey& filling) {
    return wrong.contains(filling) || !sessions.contains(std::get<0>(filling));
  });
  return is_whole_sessions ? fmt::format(" of session {}", fmt::join(sessions, " and "))
                           : fmt::format(" of {} mm", fmt::join(fills_mm, " and "));
}

class Heights {
 public:
  Heights(const Json& model_effects, const std::string& file, const Measurement& measurement)
      : model_effects_(model_effects), file_(file), rig_(measurement.rig) {
    for (const Observation& observation : measurement.observations)
      if (observation.observable == "height_mm" && has_liquid(observation.factors)) rows_.push_back(observation);
    if (!rows_.empty()) as_written_ = predicted(rows_);
  }

  /// The sessions in which the heights that another reading changes are met far better by it.
  std::set<int> sessions_that_fit_far_better(const Reading& reading) const {
    std::set<int> sessions;
    for (const auto& [session, fit] : fits_by<int>(session_of, reading))
      if (fit.is_far_better()) sessions.insert(session);
    return sessions;
  }

  /// The fillings whose heights another reading meets better, in sessions in which these together are met far better.
  std::set<FillingKey> fillings_that_fit_far_better(const Reading& reading) const {
    std::map<int, Fit> better;
    const std::map<FillingKey, Fit> fits = fits_by<FillingKey>(filling_of, reading);
    for (const auto& [filling, fit] : fits)
      if (fit.after < fit.before) better[std::get<0>(filling)] += fit;
    std::set<FillingKey> fillings;
    for (const auto& [filling, fit] : fits)
      if (fit.after < fit.before && better[std::get<0>(filling)].is_far_better()) fillings.insert(filling);
    return fillings;
  }

  /// All with liquids.
  std::set<FillingKey> fillings() const {
    std::set<FillingKey> result;
    for (const Observation& row : rows_) result.insert(filling_of(row.factors));
    return result;
  }

 private:
  /// Squared residuals [mm²] of the heights that another reading changes.
  struct Fit {
    double before = 0.0, after = 0.0, change = 0.0;
    int changed = 0;

    bool is_far_better() const {
      constexpr double kFarBetter = 3.0;    // ratio of residuals: most of them is gone
      constexpr double kLeastChange = 1.0;  // [mm] in the mean square; less may be physics
      constexpr int kFewest = 8;
      return changed >= kFewest && change > kLeastChange * changed && before > kFarBetter * kFarBetter * after;
    }
    Fit& operator+=(const Fit& other) {
      before += other.before, after += other.after, change += other.change, changed += other.changed;
      return *this;
    }
  };

  /// Of heights whose liquid would not fit into the cup nothing is said.
  template <class Key>
  std::map<Key, Fit> fits_by(Key (*key_of)(const Factors&), const Reading& reading) const {
    std::vector<Observation> rows = rows_;
    for (Observation& row : rows) {
      const Factors other = reading(row.factors);
      if (metres_from_mm(other.fill_mm) < rig_.cup.height() - rig_.cup.bottom()) row.factors = other;
    }
    std::map<Key, Fit> fits;
    if (rows.empty()) return fits;
    const Eigen::VectorXd other = predicted(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (!std::isfinite(other[k]) || !std::isfinite(as_written_[k]) || other[k] == as_written_[k]) continue;
      Fit& fit = fits[key_of(rows_[i].factors)];
      ++fit.changed;
      fit.before += std::pow(rows[i].value - as_written_[k], 2);
      fit.after += std::pow(rows[i].value - other[k], 2);
      fit.change += std::pow(other[k] - as_written_[k], 2);
    }
    return fits;
  }

  Eigen::VectorXd predicted(const std::vector<Observation>& rows) const {
    return Predictor(rig_, rows, model_effects_, file_).predict({});
  }

  const Json& model_effects_;
  const std::string& file_;
  const LaboratoryRig& rig_;
  std::vector<Observation> rows_;
  Eigen::VectorXd as_written_;
};

void correct(const Reading& reading, Measurement& measurement) {
  for (Observation& observation : measurement.observations) observation.factors = reading(observation.factors);
  for (FrameRecord& frame : measurement.frames) {
    const Factors right = reading(factors_of(frame));
    frame.liquid = right.liquid, frame.fill_m = metres_from_mm(right.fill_mm);
  }
}

/// Walls were looked for above the fills as written and above what is seen, which of a clear liquid is not its surface:
/// what stands higher has been taken for some.
void leave_out_walls_below(const Reading& reading, Measurement& measurement) {
  const CupProfile& cup = measurement.rig.cup;
  const auto from = [&](const Factors& f) { return inner_wall_above(cup, cup.bottom() + metres_from_mm(f.fill_mm)); };
  std::erase_if(measurement.observations, [&](const Observation& observation) {
    const Factors& written = observation.factors;
    return written.region == "walls" && from(reading(written)) > from(written);
  });
}

void put_units_right(const Heights& heights, Measurement& measurement) {
  struct Unit {
    const char* name;
    double mm;
  };
  constexpr std::array kUnits{Unit{"centimetres", 10.0}, Unit{"inches", 25.4}, Unit{"metres", 1000.0}};
  for (const Unit& unit : kUnits) {
    const Reading in_unit = [&](Factors factors) {
      factors.fill_mm *= unit.mm;
      return factors;
    };
    const std::set<FillingKey> wrong = heights.fillings_that_fit_far_better(in_unit);
    if (wrong.empty()) continue;
    const Reading put_right = [&](const Factors& f) { return wrong.contains(filling_of(f)) ? in_unit(f) : f; };
    leave_out_walls_below(put_right, measurement);
    correct(put_right, measurement);
    measurement.mistakes.push_back({"unit_error", fmt::format("Fills{} were written down in {}, not in millimetres.",
                                                              whose(wrong, heights.fillings()), unit.name)});
    return;
  }
}

void put_labels_right(const Heights& heights, Measurement& measurement) {
  std::set<std::string> liquids;
  for (const Observation& observation : measurement.observations)
    if (has_liquid(observation.factors)) liquids.insert(observation.factors.liquid);
  for (auto one = liquids.begin(); one != liquids.end(); ++one)
    for (auto other = std::next(one); other != liquids.end(); ++other) {
      const Reading exchanged = [&](Factors factors) {
        if (factors.liquid == *one)
          factors.liquid = *other;
        else if (factors.liquid == *other)
          factors.liquid = *one;
        return factors;
      };
      for (const int session : heights.sessions_that_fit_far_better(exchanged)) {
        correct([&](const Factors& f) { return f.session == session ? exchanged(f) : f; }, measurement);
        measurement.mistakes.push_back(
            {"label_swap", fmt::format("The labels of {} and {} are exchanged in session {}.", *one, *other, session)});
      }
    }
}

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

/// From the middle of all pours of its filling.
double departure_mm(const Pour& pour, const std::vector<Pour>& all) {
  std::vector<double> shifts_mm;
  for (const Pour& one : all) shifts_mm.push_back(one.shift_mm());
  return pour.shift_mm() - median(shifts_mm);
}

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

/// By liquid and fill [mm].
using Poured = std::map<std::pair<std::string, double>, std::vector<Pour>>;

Poured by_filling(std::vector<Pour> pours) {
  Poured poured;
  for (Pour& pour : pours) {
    const Factors& f = pour.factors();
    poured[{f.liquid, f.fill_mm}].push_back(std::move(pour));
  }
  return poured;
}

bool is_alike_everywhere(const Pour& pour, double off_mm) {
  constexpr std::size_t kFewestStands = 2;
  constexpr double kAlike = 1.0 / 3.0;  // of the departure: a clear liquid's depth goes by the angle
  const double shift_mm = pour.shift_mm();
  return pour.stands.size() >= kFewestStands &&
         std::all_of(pour.stands.begin(), pour.stands.end(), [&](const Stand& stand) {
           return std::abs(stand.shift_mm() - shift_mm) < kAlike * std::abs(off_mm);
         });
}

struct OddPour {
  const Pour* pour;
  double departure_mm;
};

/// Pours that are beyond doubt none of what they are called.
std::vector<OddPour> odd_pours(const Poured& poured) {
  constexpr double kLeast_mm = 5.0, kScatters = 10.0;
  constexpr std::size_t kOthers = 2;  // times as many must be left
  const auto are_few = [](std::size_t few, std::size_t all) { return few + kOthers * few <= all; };
  std::vector<OddPour> all_odd;
  double squares_mm2 = 0.0;
  std::size_t all = 0;
  for (const auto& [filling, pours] : poured) {
    if (!are_few(1, pours.size())) continue;
    std::vector<OddPour> odd;
    for (const Pour& pour : pours) {
      const double off_mm = departure_mm(pour, pours);
      if (std::abs(off_mm) > kLeast_mm && is_alike_everywhere(pour, off_mm))
        odd.push_back({&pour, off_mm});
      else
        squares_mm2 += off_mm * off_mm;
    }
    if (!are_few(odd.size(), pours.size())) return {};
    all += pours.size();
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

/// A pour that holds something else than its label says, beside others that hold what it says: it is left out and a
/// mistake ("wrong_pour") is added where the heights of at least two placements of it, all alike, are off by more than
/// 5 mm and ten times what pours scatter by from those of at least twice as many pours of the same filling.
void leave_out_odd_pours(const Json& model_effects, const std::string& file, Measurement& measurement) {
  const Poured poured = by_filling(pours_of(stands_of(measurement, model_effects, file)));
  std::set<std::string> left_out;
  for (const OddPour& odd : odd_pours(poured)) {
    measurement.mistakes.push_back(mistake_of(odd));
    for (const Stand& stand : odd.pour->stands) left_out.insert(placement_key({"", stand.factors}));
  }
  std::erase_if(measurement.observations, [&](const Observation& o) { return left_out.contains(placement_key(o)); });
}

}  // namespace

void put_bookkeeping_right(const Json& model_effects, const std::string& file, Measurement& measurement) {
  const Heights heights(model_effects, file, measurement);
  put_units_right(heights, measurement);
  put_labels_right(heights, measurement);
  leave_out_odd_pours(model_effects, file, measurement);
}

}  // namespace fathom
