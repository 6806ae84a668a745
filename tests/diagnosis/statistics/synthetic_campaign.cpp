#include "tests/diagnosis/statistics/synthetic_campaign.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/dense.h"
#include "core/rng.h"
#include "diagnosis/statistics/groups.h"

namespace fathom {

namespace {

/// Standard deviations of one observable's errors.
struct Noise {
  double repeat, observation, placement, pour, session;
};
const std::map<std::string, Noise> kNoise{{"height_mm", {0.25, 0.10, 0.12, 0.08, 0.05}},
                                          {"valid_fraction", {0.02, 0.008, 0.01, 0.006, 0.0}},
                                          {"ir_mean", {0.03, 0.01, 0.015, 0.01, 0.01}},
                                          {"desk_mm", {0.05, 0.04, 0.05, 0.0, 0.02}}};

using Shape = std::function<double(const Observation&)>;

double d(const Observation& o) { return (o.factors.distance_mm - 300.0) / 100.0; }
double x(const Observation& o) { return o.factors.lateral_mm / 100.0; }
double f(const Observation& o) { return o.factors.fill_mm / 30.0; }
bool is(const Observation& o, const char* observable) { return o.observable == observable; }
double height(const Observation& o) { return is(o, "height_mm") ? 1.0 : 0.0; }
double desk(const Observation& o) { return is(o, "desk_mm") ? 1.0 : 0.0; }
double clear(const Observation& o) { return o.factors.liquid == "water" ? 1.0 : 0.0; }
double opaque(const Observation& o) { return o.factors.liquid == "milk_tea" ? 1.0 : 0.0; }
double ring(const Observation& o) { return o.factors.region == "ring" ? 1.0 : 0.0; }
double wet(const Observation& o) { return clear(o) + opaque(o); }
/// Share of the fill by which a clear liquid seems raised.
double raised(const Observation& o) { return clear(o) * f(o) * (0.3 + 0.03 * d(o) + 0.01 * d(o) * d(o)); }
double ir(const Observation& o) { return is(o, "ir_mean") ? 1.0 : 0.0; }
double valid(const Observation& o) { return is(o, "valid_fraction") ? 1.0 : 0.0; }

struct Effect {
  const char* name;
  double curvature;  ///< of its response, relative, at a typical departure
  bool is_positive;  ///< bounded below by 0
  Shape change;      ///< of an observation at a typical departure
};

const std::vector<Effect>& effects() {
  static const std::vector<Effect> list{
      {"sensor_height", 0, false, [](const Observation& o) { return height(o) * 0.05 * d(o) + desk(o) * 1.0; }},
      {"sensor_pitch", 0, false, [](const Observation& o) { return height(o) * 0.1 * d(o) + desk(o) * d(o); }},
      {"sensor_roll", 0, false, [](const Observation& o) { return height(o) * 0.1 * x(o) + desk(o) * x(o); }},
      {"baseline", 0.02, false,
       [](const Observation& o) {
         return height(o) * 0.4 * (1.0 + 0.3 * d(o)) + desk(o) * 0.9 * (1.0 + 0.1 * d(o) * d(o));
       }},
      {"focal_length", 0.02, false,
       [](const Observation& o) {
         return height(o) * 0.4 * (1.0 + 0.28 * d(o)) + desk(o) * (1.0 + 0.2 * d(o) + 0.1 * x(o) * x(o));
       }},
      {"disparity_offset", 0.05, false,
       [](const Observation& o) {
         return height(o) * 0.3 * (1.0 + 0.5 * d(o) + 0.1 * d(o) * d(o)) +
                desk(o) * (1.0 + 0.5 * d(o) + 0.15 * d(o) * d(o));
       }},
      {"principal_point", 0, false,
       [](const Observation& o) { return height(o) * 0.3 * x(o) * (1 + d(o)) + desk(o) * x(o) * (1 + 0.2 * d(o)); }},
      {"radial_distortion", 0, false,
       [](const Observation& o) { return (height(o) * 0.3 + desk(o) * 0.6) * (x(o) * x(o) + 0.3 * d(o) * d(o)); }},
      {"thermal_drift", 0, false,
       [](const Observation& o) { return (height(o) * 0.5 + desk(o) * 0.5) * std::exp(-o.factors.time_s / 900.0); }},
      {"depth_quantization", 0, true,
       [](const Observation& o) {
         return height(o) * 0.3 * std::sin(9.0 * d(o) + 2.0 * f(o) + x(o)) + valid(o) * 0.01;
       }},
      {"refractive_index", 0.03, false,
       [](const Observation& o) { return height(o) * clear(o) * f(o) * (1.0 + 0.1 * d(o)); }},
      {"absorption", 0.1, true,
       [](const Observation& o) { return ir(o) * clear(o) * -0.1 * f(o) + valid(o) * clear(o) * -0.03 * f(o) * f(o); }},
      {"subsurface_scattering", 0.1, true,
       [](const Observation& o) { return opaque(o) * (height(o) * -1.0 * (1.0 + 0.1 * d(o)) + ir(o) * 0.05); }},
      {"stratification", 0, true,
       [](const Observation& o) { return height(o) * clear(o) * f(o) * f(o) * (0.3 + 0.2 * ring(o)); }},
      {"meniscus", 0, true, [](const Observation& o) { return wet(o) * ring(o) * (height(o) * 0.6 + ir(o) * -0.03); }},
      {"surface_tilt", 0, false,
       [](const Observation& o) { return wet(o) * height(o) * (0.3 * d(o) + 0.3 * x(o)) * (0.5 + clear(o)); }},
      {"foam", 0, true,
       [](const Observation& o) { return wet(o) * (height(o) * 0.5 + ir(o) * 0.1) + valid(o) * wet(o) * 0.03; }},
      {"ripples", 0, true,
       [](const Observation& o) { return valid(o) * clear(o) * -0.05 * f(o) + ir(o) * clear(o) * -0.01; }},
      {"cup_bottom_height", 0, false, [](const Observation& o) { return height(o) * (1.0 - opaque(o)); }},
      {"concave_bottom", 0, true, [](const Observation& o) { return height(o) * (1.0 - opaque(o)) * (ring(o) - 0.4); }},
      {"wall_albedo", 0, false, [](const Observation& o) { return ir(o) * 0.05 * (1.0 + ring(o)) + valid(o) * 0.01; }},
      {"wall_multipath", 0.05, true,
       [](const Observation& o) {
         return height(o) * 0.4 * (1.0 - opaque(o)) * ring(o) * (1 + 0.5 * d(o)) + ir(o) * 0.02 * ring(o);
       }},
      {"specular_ghost", 0, true,
       [](const Observation& o) { return valid(o) * -0.05 * wet(o) * (1.0 - 0.3 * d(o)) * (1.0 - ring(o)); }},
      {"fill_offset", 0, false,
       [](const Observation& o) { return wet(o) * height(o) * (opaque(o) + raised(o) / std::max(f(o), 1e-9)); }},
      {"fill_scale", 0, false, [](const Observation& o) { return height(o) * (opaque(o) * f(o) + raised(o)); }},
      {"evaporation", 0, true,
       [](const Observation& o) { return height(o) * -(opaque(o) + 0.3 * clear(o)) * o.factors.time_s / 3600.0; }},
      // An exact twin of cup_bottom_height, which no observation tells apart.
      {"cup_on_coaster", 0, false, [](const Observation& o) { return 0.5 * height(o) * (1.0 - opaque(o)); }},
  };
  return list;
}

struct PriorShape {
  const char* name;
  double sigma;
  Shape change;
};

const std::vector<PriorShape>& calibration() {
  static const std::vector<PriorShape> list{
      {"sensor.height_mm", 0.3, [](const Observation& o) { return height(o) * 0.05 * d(o) + desk(o); }},
      {"sensor.pitch_deg", 0.2, [](const Observation& o) { return height(o) * 0.1 * d(o) + desk(o) * d(o); }},
      {"sensor.roll_deg", 0.2, [](const Observation& o) { return height(o) * 0.1 * x(o) + desk(o) * x(o); }},
      {"sensor.baseline_mm", 0.1, effects()[3].change},
      {"sensor.focal_px", 0.1, effects()[4].change},
      {"sensor.disparity_offset_px", 0.1, effects()[5].change},
      {"cup.bottom_mm", 0.1, effects()[18].change},
  };
  return list;
}

double response(const Effect& effect, double departure) { return departure * (1.0 + effect.curvature * departure); }

double heavy(Rng& rng) {  // t of 3 degrees of freedom, unit variance
  const double chi2 = rng.gamma(1.5, 2.0);
  return rng.normal() / std::sqrt(chi2 / 3.0) / std::sqrt(3.0);
}

std::vector<Observation> observations(const CampaignDesign& design) {
  std::vector<Observation> result;
  int pour = 0, placement = 0;
  std::vector<double> clock(design.sessions, 0.0);
  const auto add = [&](const Factors& factors) {
    const auto one = [&](const std::string& observable, const std::string& region) {
      Factors own = factors;
      own.region = region;
      result.push_back({observable, own, 0.0, 0.0, design.repeats});
    };
    if (factors.liquid != "none")
      for (const std::string& region : design.regions) {
        one("height_mm", region);
        if (design.has_infrared) one("ir_mean", region);
      }
    if (factors.liquid != "none" && design.has_infrared) one("valid_fraction", design.regions[0]);
    if (design.has_desk) one("desk_mm", "desk");
  };
  const auto place = [&](int session, int of_pour, const std::string& liquid, double fill_mm) {
    const double first_frame_s = clock[session] + 40.0;
    for (const double distance : design.distances_mm)
      for (const double lateral : design.laterals_mm)
        for (int again = 0; again < design.placements; ++again) {
          clock[session] += 40.0;
          add({session, of_pour, ++placement, clock[session], clock[session] - first_frame_s, liquid, fill_mm, distance,
               lateral, ""});
        }
  };
  for (int repetition = 0; repetition < design.pours; ++repetition) {
    const int session = repetition % design.sessions;
    std::vector<std::pair<std::string, double>> fillings{{"empty", 0.0}};
    for (const std::string& liquid : design.liquids)
      for (const double fill : design.fills_mm) fillings.emplace_back(liquid, fill);
    if (design.turns_about && repetition % 2 == 1) std::reverse(fillings.begin(), fillings.end());
    for (const auto& [liquid, fill] : fillings) place(session, ++pour, liquid, fill);
  }
  return result;
}

}  // namespace

World::World(const CampaignDesign& design) {
  nominal_.observations = observations(design);
  const auto n = static_cast<Eigen::Index>(nominal_.observations.size());
  const auto column = [&](const Shape& shape) {
    Eigen::VectorXd result(n);
    for (Eigen::Index i = 0; i < n; ++i) result[i] = shape(nominal_.observations[i]);
    return result;
  };
  nominal_.predicted = column([](const Observation& o) {
    return height(o) * (7.0 + 30.0 * raised(o) + 30.0 * opaque(o) * f(o)) + ir(o) * 0.5 + valid(o) * 0.9;
  });
  for (const PriorShape& prior : calibration())
    nominal_.nuisances.push_back({prior.name, prior.sigma, column(prior.change)});
  std::map<int, Eigen::VectorXd> pours;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Observation& o = nominal_.observations[i];
    if (o.factors.fill_mm == 0.0) continue;
    auto& sensitivity = pours.try_emplace(o.factors.pour, Eigen::VectorXd::Zero(n)).first->second;
    sensitivity[i] = effects()[23].change(o);
  }
  for (const auto& [pour, sensitivity] : pours)
    nominal_.nuisances.push_back({"fill of pour " + std::to_string(pour), 0.3, sensitivity});
  for (const Effect& effect : effects()) {
    const Parameter parameter{"departure", 0.0, 1.0, effect.is_positive ? 0.0 : -20.0, 20.0};
    nominal_.candidates.push_back({effect.name, {parameter}, column(effect.change)});
  }

  covariance_ = Eigen::MatrixXd::Zero(n, n);
  for (const Nuisance& nuisance : nominal_.nuisances)
    covariance_ += nuisance.sigma * nuisance.sigma * nuisance.sensitivity * nuisance.sensitivity.transpose();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const Observation &a = nominal_.observations[i], &b = nominal_.observations[j];
      if (a.observable != b.observable) continue;
      const Noise& noise = kNoise.at(a.observable);
      if (i == j) covariance_(i, j) += noise.repeat * noise.repeat / a.repeats + noise.observation * noise.observation;
      if (a.factors.placement == b.factors.placement) covariance_(i, j) += noise.placement * noise.placement;
      if (a.factors.pour == b.factors.pour && !pour_key(a).empty()) covariance_(i, j) += noise.pour * noise.pour;
      if (a.factors.session == b.factors.session) covariance_(i, j) += noise.session * noise.session;
    }
  factor_.compute(covariance_);
}

Predict World::predict() const {
  return [this](const std::vector<EffectValue>& values) {
    Eigen::VectorXd predicted = nominal_.predicted;
    for (const EffectValue& value : values) {
      const int k = candidate(value.effect);
      predicted += response(effects()[k], value.values[0]) * nominal_.candidates[k].sensitivity.col(0);
    }
    return predicted;
  };
}

int World::candidate(const std::string& effect) const {
  const auto found = std::find_if(nominal_.candidates.begin(), nominal_.candidates.end(),
                                  [&](const Candidate& c) { return c.effect == effect; });
  return static_cast<int>(found - nominal_.candidates.begin());
}

Evidence World::measure(const std::vector<EffectValue>& truth, const Errors& errors, std::uint64_t seed,
                        const Eigen::VectorXd& unregistered) const {
  Evidence evidence = nominal_;
  Rng rng(seed, 71);
  const auto draw = [&] { return errors.scale * (errors.heavy_tails ? heavy(rng) : rng.normal()); };
  Eigen::VectorXd value = predict()(truth);
  if (unregistered.size() > 0) value += unregistered;
  if (errors.dust > 0.0)
    for (std::uint64_t k = 0; k < 3; ++k) value += escaping(errors.dust, mix_bits(seed) + k);
  for (const Nuisance& nuisance : nominal_.nuisances)
    value += nuisance.sigma * errors.scale * rng.normal() * nuisance.sensitivity;
  std::map<std::string, double> shared;
  const auto common = [&](const std::string& key, double sd) {
    const auto [entry, is_new] = shared.try_emplace(key, 0.0);
    if (is_new) entry->second = sd * draw();
    return entry->second;
  };
  for (std::size_t i = 0; i < evidence.observations.size(); ++i) {
    Observation& o = evidence.observations[i];
    const auto row = static_cast<Eigen::Index>(i);
    o.value = value[row];
    if (errors.silent) continue;
    const Noise& noise = kNoise.at(o.observable);
    o.value += noise.observation * draw() +
               common(o.observable + "/l" + std::to_string(o.factors.placement), noise.placement) +
               common(o.observable + "/p" + std::to_string(o.factors.pour), pour_key(o).empty() ? 0.0 : noise.pour) +
               common(o.observable + "/s" + std::to_string(o.factors.session), noise.session);
    double mean = 0.0, squares = 0.0;
    for (int repeat = 0; repeat < o.repeats; ++repeat) {
      const double off = noise.repeat * draw();
      mean += off / o.repeats;
      squares += off * off;
    }
    o.value += mean;
    if (o.repeats > 1) o.repeat_sd = std::sqrt(std::max(0.0, squares - o.repeats * mean * mean) / (o.repeats - 1));
  }
  return evidence;
}

double World::strength(const Eigen::VectorXd& change) const { return factor_.matrixL().solve(change).norm(); }

EffectValue World::at_strength(const std::string& effect, double strength_wanted, double sign) const {
  const int k = candidate(effect);
  const double per_unit = strength(nominal_.candidates[k].sensitivity.col(0));
  const double departure = (effects()[k].is_positive ? 1.0 : sign) * strength_wanted / per_unit;
  return {effect, {departure}};
}

Eigen::VectorXd World::escaping(double escape, std::uint64_t seed) const {
  Rng rng(seed, 72);
  Eigen::VectorXd change(nominal_.predicted.size());
  std::map<std::string, Eigen::VectorXd> coefficients;
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const Observation& o = nominal_.observations[i];
    const auto [entry, is_new] = coefficients.try_emplace(o.observable + o.factors.liquid + o.factors.region, 8);
    if (is_new)
      for (double& coefficient : entry->second) coefficient = rng.normal();
    Eigen::VectorXd shapes(8);
    shapes << 1.0, d(o), x(o), f(o), d(o) * d(o), x(o) * x(o), f(o) * f(o), d(o) * x(o);
    change[i] = kNoise.at(o.observable).placement * shapes.dot(entry->second);
  }
  Eigen::MatrixXd sensitivities(change.size(), static_cast<Eigen::Index>(nominal_.candidates.size()));
  for (Eigen::Index k = 0; k < sensitivities.cols(); ++k)
    sensitivities.col(k) = nominal_.candidates[k].sensitivity.col(0);
  const Eigen::MatrixXd spanned = factor_.matrixL().solve(sensitivities);
  const Eigen::VectorXd whitened = factor_.matrixL().solve(change);
  const double outside = (whitened - spanned * least_squares(spanned, whitened)).norm();
  return change * (escape / outside);
}

}  // namespace fathom
