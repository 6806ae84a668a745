#include "detector/content.h"

#include <fmt/format.h>

#include "core/units.h"
#include "detector/detector.h"

namespace fathom {
namespace {

Liquid liquid_from(double probability, const FillSettings& settings) {
  if (probability >= settings.liquid_sure) return Liquid::kYes;
  return 1.0 - probability >= settings.dry_sure ? Liquid::kNo : Liquid::kUnknown;
}

LiquidKind kind_from(double p_opaque, double sure) {
  if (p_opaque >= sure) return LiquidKind::kOpaque;
  return p_opaque <= 1.0 - sure ? LiquidKind::kTransparent : LiquidKind::kUnknown;
}

std::string in_words(const FillDecision::Level& level) {
  return fmt::format("{:.0f} +- {:.0f} mm", mm_from_metres(level.fill_m), mm_from_metres(level.sigma_m));
}

std::string in_words(const CupEvidence& evidence) {
  std::string words = fmt::format("{} at {:.1f} mm", evidence.bottom_words, mm_from_metres(evidence.bottom.height_m));
  if (evidence.readings.empty()) words += "; nothing level is measured inside";
  for (const SurfaceReading& reading : evidence.readings)
    words += fmt::format("; level inside at {:.1f} +- {:.1f} mm", mm_from_metres(reading.height_m),
                         mm_from_metres(reading.sigma_m));
  if (!evidence.signs.words.empty()) words += "; " + evidence.signs.words;
  return words;
}

}  // namespace

void decide_content(DetectedCup& cup, const CupEvidence& evidence, const FillSettings& settings) {
  cup.bottom_m = evidence.bottom.height_m;
  cup.liquid = Liquid::kUnknown;
  cup.kind = LiquidKind::kUnknown;
  cup.p_liquid = cup.fill_m = cup.fill_sigma_m = std::nullopt;
  cup.why = in_words(evidence);
  if (evidence.readings.empty() && evidence.signs.opaque == 1.0) return;

  const FillDecision decision =
      decide_fill(evidence.readings, evidence.bottom, evidence.fill_max_m, evidence.signs, settings);
  const Liquid liquid = liquid_from(decision.p_liquid, settings);
  if (liquid == Liquid::kYes && !evidence.solid_words.empty()) {
    cup.why += "; solid? " + evidence.solid_words;
    return;
  }
  cup.p_liquid = decision.p_liquid;
  cup.liquid = liquid;
  cup.why += fmt::format("; P(liquid) {:.3f}", decision.p_liquid);
  if (liquid != Liquid::kYes) return;
  cup.kind = kind_from(decision.p_opaque, settings.kind_sure);
  if (evidence.readings.empty()) return;
  if (cup.kind == LiquidKind::kUnknown) {
    cup.why += fmt::format("; {} if clear, {} if opaque", in_words(decision.transparent), in_words(decision.opaque));
    return;
  }
  const FillDecision::Level& level = cup.kind == LiquidKind::kOpaque ? decision.opaque : decision.transparent;
  cup.fill_m = level.fill_m;
  cup.fill_sigma_m = level.sigma_m;
}

}  // namespace fathom
