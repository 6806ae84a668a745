// All observations of a campaign, for any effects: the model side of a diagnosis.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "diagnosis/measurement/named_values.h"
#include "diagnosis/measurement/read_measurement.h"
#include "diagnosis/predict/content_shape.h"
#include "diagnosis/predict/nominal_model.h"
#include "diagnosis/predict/surrogate.h"
#include "sim/effects/effect.h"

namespace fathom {

/// Frames that differ in nothing that the model knows of: one placement, or the bare desk of a session.
struct Condition {
  Factors factors;                ///< without a region
  std::vector<std::size_t> rows;  ///< its observations
  SampledPixels pixels;
  std::size_t equal = 0;  ///< number of the first condition that differs from it in time, pour and placement alone
  std::shared_ptr<const SurrogateFrame> nominal{};    ///< as few rays see it without a change
  std::optional<FrameEstimates> nominal_estimates{};  ///< of that, the unit's bias taken off
};

/// The points of a cloud of a condition's set-up.
using Shoot = std::function<std::vector<SensedPoint>(const Setup& setup, const Condition& condition)>;

/// What changes a set-up, at given values.
struct Change {
  std::function<void(Setup& setup)> apply = {};
  bool of_time = false;  ///< whether it changes otherwise equal conditions each in its own way
};

class Predictor {
 public:
  /// `observations` must outlive nothing: their factors are copied. Effects of `model_effects` (as in model.json) are
  /// part of the nominal model. `unit`: what was learned of the unit's bias and taken off the observations; so it is of
  /// predictions. `sights`: the part of the image in which clouds show the desk; of predictions no more counts. Throws
  /// Error on what cannot be modelled.
  Predictor(const LaboratoryRig& rig, const std::vector<Observation>& observations,
            SharedJson model_effects = SharedJson::array(), std::string file = "rig.json",
            std::shared_ptr<const UnitBias> unit = {}, const DeskSights& sights = {});

  /// One value for each observation, NaN where the model sees nothing there or does not predict that observable.
  Eigen::VectorXd predict(const Change& change) const;
  /// The same of the conditions listed, all other values 0.
  Eigen::VectorXd predict(const Change& change, const std::vector<std::size_t>& conditions) const;
  /// The same from clouds that somebody else shoots, one condition after the other: what few rays' desks would be taken
  /// to have of a bias is taken off them, and they are measured as a laboratory does.
  Eigen::VectorXd predict_by(const Shoot& shoot, const Change& change,
                             const std::vector<std::size_t>& conditions) const;

  /// What errors of the unit's bias change: patterns of 1 σ, planes first, then the largest. None without a unit.
  std::vector<Eigen::VectorXd> unit_errors() const;

  /// 1 σ of what is not known of the unit's bias, mean over what is seen in cups [px]: now, and if every session had
  /// views of the bare desk. Nothing without a unit.
  struct UnitKnowledge {
    double now_px = 0.0, with_bare_desks_px = 0.0;
  };
  std::optional<UnitKnowledge> unit_knowledge() const;

  /// Some conditions, those together that the change leaves alike: they are predicted once.
  std::vector<std::vector<std::size_t>> alike(const Change& change, const std::vector<std::size_t>& conditions) const;

  /// What is shot in a condition, all effects switched on.
  Setup setup(const Condition& condition, const Change& change = {}) const;

  /// Whether each observation is of a region of the cup that the model puts into shadow, or near one.
  std::vector<bool> near_shadows() const;

  /// One more observation, of a condition that it knows.
  void add(const Observation& observation);
  /// The same of a shape, of conditions as content_sights() numbers them.
  void add(ContentShape shape);

  /// What placements show of their cups in cells clear of shadows. `observations` hold the cells' heights
  /// ("cell_height_mm").
  std::vector<ContentSight> content_sights(const std::vector<Observation>& observations) const;

  /// Forgets the other observations, and conditions of which none is left; before shapes are added.
  void keep(const std::vector<bool>& kept);

  const std::vector<Condition>& conditions() const { return conditions_; }
  std::vector<std::size_t> all_conditions() const;  ///< their indices
  const NominalModel& model() const { return model_; }

 private:
  /// What is found in a condition's set-up. Nothing when no desk is seen.
  using Look = std::function<std::optional<FrameEstimates>(const Setup& setup, const Condition& condition)>;
  struct Foreseen {
    Setup shot;
    FrameEstimates estimates;
    std::vector<NamedValue> named;  ///< of the estimates
    std::optional<UnderWaves> waves;
  };

  /// Of all observations; and of the conditions that were looked at, the cells' heights.
  struct Values {
    Eigen::VectorXd of_rows;
    std::vector<std::optional<CellHeights>> cells;
  };

  void look_at_nominal();
  void find_desks();
  /// What would be learned of a unit without bias, were its desks as this change makes them.
  BiasField bias_by(const Change& change) const;
  /// The same, or nominal_bias_ where the change leaves every session's desk as it is; null without a unit. `own` holds
  /// what is not nominal.
  const BiasField* bias_of(const Change& change, BiasField& own) const;
  Eigen::VectorXd predict_from(const std::function<std::optional<FrameEstimates>(const Condition&)>& estimates) const;
  std::optional<Foreseen> foresee(const Look& look, const Condition& condition, const Change& change) const;
  double value_of(std::size_t row, const Foreseen& foreseen) const;
  /// Rows of conditions that are alike.
  void predict_alike(const Look& look, const Change& change, const std::vector<std::size_t>& conditions,
                     Values& values) const;
  /// Nothing predicted yet, and then all of it.
  Values no_values() const;
  Eigen::VectorXd with_shapes(Values values) const;

  NominalModel model_;
  SharedJson model_effects_;
  bool model_goes_by_time_;
  std::string file_;
  std::shared_ptr<const UnitBias> unit_;
  BiasField nominal_bias_;                      ///< that few rays' desks would be taken to have
  std::map<int, std::size_t> desk_of_session_;  ///< a condition that shows most of it
  std::vector<std::string> observables_, regions_;
  std::vector<Condition> conditions_;
  std::vector<std::pair<std::size_t, ContentShape>> shapes_;  ///< with their rows
};

/// How clouds of a condition are looked at.
FrameView view_of(const Factors& factors);

/// Switches effects on, each named as by EffectName. Values outside their bounds are taken at the bound. Throws
/// Error on an unknown id.
Change switch_on(const std::vector<EffectValue>& effects);

/// Indices of the predictor's conditions.
std::vector<std::size_t> conditions_where(const Predictor& predictor, const std::function<bool(const Factors&)>& is);

/// Those that an effect (named as by EffectName) can change: of one of liquids, the ones with a liquid, or with its
/// own.
std::vector<std::size_t> conditions_touched(const Predictor& predictor, const Effect& effect,
                                            const std::string& liquid);

/// Change per unit of every observation between the set-ups with `low` and `high` of a quantity, in those conditions;
/// the same rays look at both. 0 elsewhere, and where either sees nothing.
Eigen::VectorXd slope(const Predictor& predictor, const std::function<Change(double)>& at, double low, double high,
                      const std::vector<std::size_t>& conditions);

}  // namespace fathom
