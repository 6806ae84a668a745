#include "diagnosis/predict/predictor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

#include "core/error.h"
#include "core/json.h"
#include "core/parallel.h"
#include "core/units.h"
#include "diagnosis/statistics/groups.h"
#include "sim/effects/effects_json.h"
#include "sim/effects/registry.h"

namespace fathom {
namespace {

using ConditionKey = std::tuple<int, int, int, std::string, double, double, double>;

ConditionKey key_of(const Factors& f) {
  return {f.session, f.pour, f.placement, f.liquid, f.fill_mm, f.distance_mm, f.lateral_mm};
}

std::vector<Condition> conditions_of(const LaboratoryRig& rig, const std::vector<Observation>& observations,
                                     const DeskSights& sights) {
  std::map<ConditionKey, Condition> found;
  for (std::size_t row = 0; row < observations.size(); ++row) {
    const Factors& f = observations[row].factors;
    // How a desk moves over a session is of no one time, and comes last: the time is that of what was seen at once.
    found.try_emplace(key_of(f), Condition{f, {}, {}}).first->second.rows.push_back(row);
  }
  std::vector<Condition> conditions;
  for (auto& [key, condition] : found) {
    condition.factors.region.clear();
    condition.pixels = sample_pixels(rig, view_of(condition.factors));
    condition.pixels.view.desk_px = sights.at(condition.factors);
    conditions.push_back(std::move(condition));
  }
  return conditions;
}

void number_equals(std::vector<Condition>& conditions) {
  std::map<std::tuple<std::string, double, double, double>, std::size_t> first;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Factors& f = conditions[i].factors;
    conditions[i].equal = first.try_emplace({f.liquid, f.fill_mm, f.distance_mm, f.lateral_mm}, i).first->second;
  }
}

bool goes_by_time(const Json& model_effects) {
  return std::any_of(model_effects.begin(), model_effects.end(), [](const Json& named) {
    const Effect* effect = find_effect(named.value("name", ""));
    return effect && effect->of_time;
  });
}

/// A whole interior's mean height, as tables without clouds have it.
double interior_height_mm(const FrameEstimates& estimates) {
  return estimates.interior.weight >= kFewestInInterior ? mm_from_metres(estimates.interior.mean)
                                                        : std::numeric_limits<double>::quiet_NaN();
}

/// 1 σ of the desk's height when all disparities of a frame share an error: 1/z changes by it over f b, everywhere.
double wander_mm(const SensorModel& sensor, const Plane& desk) {
  const Calibration believed = sensor.calibration();
  return mm_from_metres(desk.offset * desk.offset * std::abs(desk.normal.z()) * sensor.unit.wander_px /
                        (believed.focal_px * believed.baseline));
}

/// The desk of a few rays, as far as it is no plane: what a unit's bias would be learned from. The points' disparities
/// off their own plane, between pixels bilinear.
DeskError desk_of_rays(std::span<const SensedPoint> desk, const LaboratoryRig& rig) {
  constexpr double kAcross_px = kImageWidth_px / kDeskColumns, kDown_px = kImageHeight_px / kDeskRows;
  const auto place = [](int column, int row) { return static_cast<std::size_t>(row) * kDeskColumns + column; };
  const double of_inverse = rig.focal_px * rig.baseline_m;
  Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto sight = [](const SensedPoint& p) { return Eigen::Vector3d(p.point.cast<double>() / p.point.z()); };
  for (const SensedPoint& p : desk) {
    normal += sight(p) * sight(p).transpose();
    right += sight(p) * of_inverse / static_cast<double>(p.point.z());
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  // On the raster of the rays; NaN where no desk is seen.
  std::vector<double> errors_px(static_cast<std::size_t>(kDeskColumns) * kDeskRows,
                                std::numeric_limits<double>::quiet_NaN());
  for (const SensedPoint& p : desk) {
    const Eigen::Vector2d pixel = bias_point(p.point, rig).pixel_px;
    const int column = std::clamp(static_cast<int>(pixel.x() / kAcross_px), 0, kDeskColumns - 1),
              row = std::clamp(static_cast<int>(pixel.y() / kDown_px), 0, kDeskRows - 1);
    errors_px[place(column, row)] = of_inverse / p.point.z() - plane.dot(sight(p));
  }
  return [errors_px = std::move(errors_px), place](const BiasCell& cell) -> std::optional<double> {
    const double x = cell.column_px / kAcross_px - 0.5, y = cell.row_px / kDown_px - 0.5;
    const int left = std::clamp(static_cast<int>(std::floor(x)), 0, kDeskColumns - 2),
              top = std::clamp(static_cast<int>(std::floor(y)), 0, kDeskRows - 2);
    double sum = 0.0, weights = 0.0;
    for (int row = top; row <= top + 1; ++row)
      for (int column = left; column <= left + 1; ++column) {
        const double error = errors_px[place(column, row)];
        if (std::isnan(error)) continue;
        const double weight = std::max(1.0 - std::abs(x - column), 0.0) * std::max(1.0 - std::abs(y - row), 0.0) + 1e-6;
        sum += weight * error;
        weights += weight;
      }
    if (weights == 0.0) return std::nullopt;
    return sum / weights;
  };
}

}  // namespace

Predictor::Predictor(const LaboratoryRig& rig, const std::vector<Observation>& observations, SharedJson model_effects,
                     std::string file, std::shared_ptr<const UnitBias> unit, const DeskSights& sights)
    : model_(nominal_model(rig, file)),
      model_effects_(std::move(model_effects)),
      model_goes_by_time_(goes_by_time(model_effects_)),
      file_(std::move(file)),
      unit_(std::move(unit)),
      conditions_(conditions_of(rig, observations, sights)) {
  number_equals(conditions_);
  for (const Observation& observation : observations) {
    observables_.push_back(observation.observable);
    regions_.push_back(observation.factors.region);
  }
  look_at_nominal();
}

void Predictor::look_at_nominal() {
  const std::vector<std::vector<std::size_t>> groups = alike({}, all_conditions());
  parallel_items(static_cast<int>(groups.size()), [&](int group) {
    const Condition& first = conditions_[groups[group].front()];
    const auto frame =
        std::make_shared<const SurrogateFrame>(surrogate_frame(setup(first), model_.laboratory, first.pixels));
    for (const std::size_t i : groups[group]) conditions_[i].nominal = frame;
  });
  find_desks();
  if (unit_) nominal_bias_ = bias_by({});
  parallel_items(static_cast<int>(groups.size()), [&](int group) {
    const Condition& first = conditions_[groups[group].front()];
    const auto estimates =
        unit_ ? estimates_without(std::array{as_bias(nominal_bias_)}, *first.nominal, model_.laboratory, first.pixels)
              : first.nominal->estimates;
    for (const std::size_t i : groups[group]) conditions_[i].nominal_estimates = estimates;
  });
}

void Predictor::find_desks() {
  desk_of_session_.clear();
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    const auto [known, is_first] = desk_of_session_.try_emplace(conditions_[i].factors.session, i);
    if (conditions_[i].factors.liquid == "none") known->second = i;
  }
}

BiasField Predictor::bias_by(const Change& change) const {
  std::map<int, DeskError> desks;
  for (const auto& [session, i] : desk_of_session_) {
    const Condition& condition = conditions_[i];
    const SurrogateFrame frame =
        surrogate_points(setup(condition, change), model_.laboratory, condition.pixels, condition.nominal.get());
    desks[session] = desk_of_rays(frame.desk, model_.laboratory);
  }
  return unit_->learn(desks);
}

const BiasField* Predictor::bias_of(const Change& change, BiasField& own) const {
  if (!unit_) return nullptr;
  const bool is_nominal = std::all_of(desk_of_session_.begin(), desk_of_session_.end(), [&](const auto& session) {
    const Condition& condition = conditions_[session.second];
    return desk_looks_alike(surrogate_view(setup(condition, change)), condition.nominal->view);
  });
  if (is_nominal) return &nominal_bias_;
  own = bias_by(change);
  return &own;
}

std::vector<Eigen::VectorXd> Predictor::unit_errors() const {
  if (!unit_) return {};
  constexpr int kMost = 48;  // of which the last is a hundredth of the first
  std::vector<BiasPoint> points;
  std::vector<std::size_t> looked_at;
  for (const std::vector<std::size_t>& group : alike({}, all_conditions())) looked_at.push_back(group.front());
  for (const std::size_t i : looked_at)
    for (const SensedPoint& sensed : conditions_[i].nominal->inside)
      points.push_back(bias_point(sensed.point, model_.laboratory));
  for (const auto& [session, i] : desk_of_session_)
    for (const SensedPoint& sensed : conditions_[i].nominal->desk)
      points.push_back(bias_point(sensed.point, model_.laboratory));
  const std::vector<Bias> modes = unit_->error_modes(kMost, points);
  const Eigen::VectorXd nominal = predict_from([](const Condition& c) { return c.nominal_estimates; });
  std::vector<Eigen::VectorXd> errors(modes.size());
  parallel_items(static_cast<int>(modes.size()), [&](int mode) {
    errors[mode] = predict_from([&](const Condition& c) {
      return estimates_without(std::array{as_bias(nominal_bias_), modes[mode]}, *c.nominal, model_.laboratory,
                               c.pixels);
    });
    errors[mode] -= nominal;
    for (double& value : errors[mode])
      if (!std::isfinite(value)) value = 0.0;
  });
  return errors;
}

std::optional<Predictor::UnitKnowledge> Predictor::unit_knowledge() const {
  if (!unit_) return std::nullopt;
  constexpr std::size_t kEvery = 20;  // a bias is the same over dozens of pixels
  const UnitBias bare = unit_->with_bare_desks();
  UnitKnowledge squares;
  double count = 0.0;
  for (const std::vector<std::size_t>& group : alike({}, all_conditions())) {
    const std::vector<SensedPoint>& inside = conditions_[group.front()].nominal->inside;
    for (std::size_t i = 0; i < inside.size(); i += kEvery, ++count) {
      const BiasPoint point = bias_point(inside[i].point, model_.laboratory);
      squares.now_px += std::pow(unit_->sigma(point), 2);
      squares.with_bare_desks_px += std::pow(bare.sigma(point), 2);
    }
  }
  if (count == 0.0) return std::nullopt;
  return UnitKnowledge{std::sqrt(squares.now_px / count), std::sqrt(squares.with_bare_desks_px / count)};
}

Eigen::VectorXd Predictor::predict_from(
    const std::function<std::optional<FrameEstimates>(const Condition&)>& estimates) const {
  Values values = no_values();
  const Look as_given = [&](const Setup&, const Condition& condition) { return estimates(condition); };
  for (const std::vector<std::size_t>& group : alike({}, all_conditions())) predict_alike(as_given, {}, group, values);
  return with_shapes(std::move(values));
}

std::vector<std::size_t> Predictor::all_conditions() const {
  std::vector<std::size_t> all(conditions_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

Setup Predictor::setup(const Condition& condition, const Change& change) const {
  Setup setup = setup_of(model_, condition.factors);
  setup.effects = model_effects_;
  setup.file = file_;
  setup = with_effects(std::move(setup));
  if (change.apply) change.apply(setup);
  return setup;
}

std::vector<bool> Predictor::near_shadows() const {
  constexpr double kTooMuch = 0.35;  // of a region
  const auto is_of_region = [](const std::string& name) { return name == "height_mm" || name == "stray_share"; };
  std::vector<bool> shadowed(observables_.size(), false);
  for (const std::vector<std::size_t>& group : alike({}, all_conditions())) {
    const Condition& first = conditions_[group.front()];
    const std::array<double, 5> shares = shares_near_shadows(*first.nominal, model_.laboratory, first.pixels);
    for (const std::size_t condition : group)
      for (const std::size_t row : conditions_[condition].rows)
        for (std::size_t i = 0; i < shares.size(); ++i)
          if (is_of_region(observables_[row]) && regions_[row] == kCupRegionNames[i] && shares[i] > kTooMuch)
            shadowed[row] = true;
  }
  return shadowed;
}

void Predictor::add(const Observation& observation) {
  const auto known = std::find_if(conditions_.begin(), conditions_.end(), [&](const Condition& condition) {
    return key_of(condition.factors) == key_of(observation.factors);
  });
  known->rows.push_back(observables_.size());
  observables_.push_back(observation.observable);
  regions_.push_back(observation.factors.region);
}

void Predictor::add(ContentShape shape) {
  const std::size_t row = observables_.size();
  add(shape.observation);
  shapes_.emplace_back(row, std::move(shape));
}

std::vector<ContentSight> Predictor::content_sights(const std::vector<Observation>& observations) const {
  constexpr double kMostInShadow = 0.05;  // of a cell
  std::map<ConditionKey, CellHeights> measured;
  for (const Observation& o : observations) {
    if (o.observable != "cell_height_mm") continue;
    const auto [known, is_new] = measured.try_emplace(key_of(o.factors));
    if (is_new) known->second.fill(std::numeric_limits<double>::quiet_NaN());
    for (int cell = 0; cell < kCupCells; ++cell)
      if (o.factors.region == name_of_cell(cell)) known->second[cell] = o.value;
  }
  std::vector<ContentSight> sights;
  for (std::size_t i = 0; i < conditions_.size(); ++i) {
    const Condition& condition = conditions_[i];
    const auto own = measured.find(key_of(condition.factors));
    if (own == measured.end() || !condition.nominal_estimates) continue;
    const auto shadows = cells_near_shadows(*condition.nominal, model_.laboratory, condition.pixels);
    ContentSight sight{i, condition.factors, own->second, cell_heights(*condition.nominal_estimates), {}};
    for (int cell = 0; cell < kCupCells; ++cell)
      sight.cells[cell] =
          std::isfinite(sight.measured[cell]) && std::isfinite(sight.predicted[cell]) && shadows[cell] <= kMostInShadow;
    sights.push_back(std::move(sight));
  }
  return sights;
}

void Predictor::keep(const std::vector<bool>& kept) {
  std::vector<std::size_t> new_row(kept.size());
  std::size_t count = 0;
  for (std::size_t row = 0; row < kept.size(); ++row) {
    if (!kept[row]) continue;
    observables_[count] = observables_[row];
    regions_[count] = regions_[row];
    new_row[row] = count++;
  }
  observables_.resize(count);
  regions_.resize(count);
  for (Condition& condition : conditions_) {
    std::erase_if(condition.rows, [&](std::size_t row) { return !kept[row]; });
    for (std::size_t& row : condition.rows) row = new_row[row];
  }
  std::erase_if(conditions_, [](const Condition& condition) { return condition.rows.empty(); });
  number_equals(conditions_);
  find_desks();
}

std::optional<Predictor::Foreseen> Predictor::foresee(const Look& look, const Condition& condition,
                                                      const Change& change) const {
  Setup shot = setup(condition, change);
  auto estimates = look(shot, condition);
  if (!estimates) return std::nullopt;
  std::vector<NamedValue> named = named_values(*estimates);
  auto waves = under_waves(shot, model_.laboratory, condition.pixels);
  return Foreseen{std::move(shot), std::move(*estimates), std::move(named), waves};
}

double Predictor::value_of(std::size_t row, const Foreseen& foreseen) const {
  const std::string& observable = observables_[row];
  if (observable == "desk_wander_mm") return wander_mm(foreseen.shot.rig.sensor, foreseen.estimates.desk);
  if (observable == "desk_waves_px" || observable == "desk_pitch_motion_deg" || observable == "desk_roll_motion_deg")
    return 0.0;
  if (observable == "liquid_motion_mm") return foreseen.waves ? foreseen.waves->scatter_mm : 0.0;
  if (observable == "stray_share" && foreseen.waves)
    for (std::size_t i = 0; i < kCupRegionNames.size(); ++i)
      if (regions_[row] == kCupRegionNames[i]) return foreseen.waves->stray_share[i];
  if (observable == "height_mm" && regions_[row] == kWholeInterior) return interior_height_mm(foreseen.estimates);
  for (const NamedValue& value : foreseen.named)
    if (value.observable == observable && value.region == regions_[row]) return value.value;
  if (observable == "log_ir_contrast") return log_contrast_of_dots(foreseen.shot);  // few rays make no dots
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::vector<std::size_t>> Predictor::alike(const Change& change,
                                                       const std::vector<std::size_t>& conditions) const {
  std::map<std::size_t, std::vector<std::size_t>> by_first;
  for (const std::size_t i : conditions)
    by_first[change.of_time || model_goes_by_time_ ? i : conditions_[i].equal].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [first, members] : by_first) groups.push_back(std::move(members));
  return groups;
}

void Predictor::predict_alike(const Look& look, const Change& change, const std::vector<std::size_t>& conditions,
                              Values& values) const {
  const std::optional<Foreseen> foreseen = foresee(look, conditions_[conditions.front()], change);
  for (const std::size_t i : conditions) {
    if (foreseen && !shapes_.empty()) values.cells[i] = cell_heights(foreseen->estimates);
    for (const std::size_t row : conditions_[i].rows)
      values.of_rows[row] = foreseen ? value_of(row, *foreseen) : std::numeric_limits<double>::quiet_NaN();
  }
}

Predictor::Values Predictor::no_values() const {
  Values values;
  values.of_rows = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(observables_.size()));
  values.cells.resize(conditions_.size());
  return values;
}

Eigen::VectorXd Predictor::with_shapes(Values values) const {
  for (const auto& [row, shape] : shapes_)
    values.of_rows[static_cast<Eigen::Index>(row)] = shape.predicted([&](std::size_t condition) {
      const std::optional<CellHeights>& seen = values.cells[condition];
      return seen ? &*seen : nullptr;
    });
  return values.of_rows;
}

Eigen::VectorXd Predictor::predict(const Change& change, const std::vector<std::size_t>& conditions) const {
  BiasField own;
  const BiasField* const bias = bias_of(change, own);
  const Look by_few_rays = [this, bias](const Setup& shot, const Condition& condition) {
    const SampledPixels& pixels = condition.pixels;
    if (!bias) return surrogate_frame(shot, model_.laboratory, pixels, condition.nominal.get()).estimates;
    const SurrogateFrame frame = surrogate_points(shot, model_.laboratory, pixels, condition.nominal.get());
    if (frame.is_known && bias == &nominal_bias_) return condition.nominal_estimates;
    return estimates_without(std::array{as_bias(*bias)}, frame, model_.laboratory, pixels);
  };
  const std::vector<std::vector<std::size_t>> groups = alike(change, conditions);
  Values values = no_values();
  parallel_items(static_cast<int>(groups.size()),
                 [&](int group) { predict_alike(by_few_rays, change, groups[group], values); });
  return with_shapes(std::move(values));
}

Eigen::VectorXd Predictor::predict_by(const Shoot& shoot, const Change& change,
                                      const std::vector<std::size_t>& conditions) const {
  BiasField own;
  const BiasField* const bias = bias_of(change, own);
  const Look look = [&](const Setup& shot, const Condition& condition) {
    std::vector<SensedPoint> points = shoot(shot, condition);
    if (bias) take_off(as_bias(*bias), model_.laboratory, points);
    FrameView view = view_of(condition.factors);
    view.desk_px = condition.pixels.view.desk_px;
    return estimate_frame(points, model_.laboratory, view);
  };
  Values values = no_values();
  for (const std::vector<std::size_t>& group : alike(change, conditions)) predict_alike(look, change, group, values);
  return values.of_rows;
}

Eigen::VectorXd Predictor::predict(const Change& change) const { return predict(change, all_conditions()); }

FrameView view_of(const Factors& factors) {
  if (factors.liquid == "none") return {};
  return {Eigen::Vector2d(metres_from_mm(factors.lateral_mm), metres_from_mm(factors.distance_mm)),
          metres_from_mm(factors.fill_mm)};
}

Change switch_on(const std::vector<EffectValue>& effects) {
  struct On {
    const Effect* effect;
    std::string liquid;
    std::vector<double> values;
  };
  std::vector<On> switched;
  for (const EffectValue& value : effects) {
    EffectName name = effect_name(value.effect);
    const Effect* effect = find_effect(name.id);
    if (!effect) throw Error("effects", unknown_name("effect", value.effect, effect_ids()));
    On on{effect, std::move(name.liquid), value.values};
    for (std::size_t i = on.values.size(); i < effect->parameters.size(); ++i)
      on.values.push_back(effect->parameters[i].nominal);
    for (std::size_t i = 0; i < on.values.size(); ++i)
      on.values[i] = std::clamp(on.values[i], effect->parameters[i].lower, effect->parameters[i].upper);
    switched.push_back(std::move(on));
  }
  const bool of_time = std::any_of(switched.begin(), switched.end(), [](const On& on) { return on.effect->of_time; });
  return {[switched](Setup& setup) {
            for (const On& on : switched) on.effect->apply(setup, {on.values, on.liquid});
          },
          of_time};
}

std::vector<std::size_t> conditions_where(const Predictor& predictor, const std::function<bool(const Factors&)>& is) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < predictor.conditions().size(); ++i)
    if (is(predictor.conditions()[i].factors)) found.push_back(i);
  return found;
}

std::vector<std::size_t> conditions_touched(const Predictor& predictor, const Effect& effect,
                                            const std::string& liquid) {
  return conditions_where(predictor, [&](const Factors& f) {
    return liquid.empty() ? !effect.of_liquids || has_liquid(f) : f.liquid == liquid;
  });
}

Eigen::VectorXd slope(const Predictor& predictor, const std::function<Change(double)>& at, double low, double high,
                      const std::vector<std::size_t>& conditions) {
  Eigen::VectorXd difference =
      (predictor.predict(at(high), conditions) - predictor.predict(at(low), conditions)) / (high - low);
  for (double& value : difference)
    if (!std::isfinite(value)) value = 0.0;
  return difference;
}

}  // namespace fathom
