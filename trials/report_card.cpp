#include "trials/report_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/files.h"
#include "report/gnuplot.h"
#include "report/gnuplot_text.h"
#include "report/html.h"
#include "trials/failure_gallery.h"

namespace fathom {
namespace {

/// A class of a factor: its place among the classes, and its words.
using Group = std::pair<double, std::string>;

struct Factor {
  const char* name;
  Group (*of)(const TrialResult& frame, const TrialCup* cup);  ///< `cup` is null for a factor of frames
  bool is_of_frames;
};

/// The class between two of the rising edges.
template <std::size_t N>
Group between(double value, const std::array<double, N>& edges, double scale = 1.0) {
  const auto above = std::upper_bound(edges.begin(), edges.end(), value);
  if (above == edges.begin()) return {-HUGE_VAL, fmt::format("below {:g}", scale * edges.front())};
  const double low = *std::prev(above);
  if (above == edges.end()) return {low, fmt::format("{:g} and more", scale * low)};
  return {low, fmt::format("{:g} to {:g}", scale * low, scale * *above)};
}

Group by_sensor(const TrialResult& frame, const TrialCup*) { return {0.0, frame.sensor}; }

Group by_others(const TrialResult& frame, const TrialCup*) {
  return {static_cast<double>(frame.others), fmt::format("{}", frame.others)};
}

Group by_distance(const TrialResult&, const TrialCup* cup) {
  constexpr double kWidth = 100.0;
  const double low = kWidth * std::floor(cup->distance_mm / kWidth);
  return {low, fmt::format("{:g} to {:g}", low, low + kWidth)};
}

Group by_sight(const TrialResult&, const TrialCup* cup) {
  return between(cup->visible, std::array{0.0, 0.3, 0.5, 0.7, 0.9}, 100.0);
}

Group by_fill(const TrialResult&, const TrialCup* cup) {
  if (cup->liquid == "empty") return {-1.0, "empty"};
  return between(cup->fill_mm, std::array{0.0, 10.0, 20.0, 40.0, 60.0});
}

Group by_liquid(const TrialResult&, const TrialCup* cup) {
  return {cup->liquid == "empty" ? -1.0 : cup->kind == name_of(LiquidKind::kTransparent) ? 0.0 : 1.0, cup->liquid};
}

Group by_cup(const TrialResult&, const TrialCup* cup) { return {0.0, cup->shape}; }

constexpr std::array kFactors{Factor{"sensor", by_sensor, true},           Factor{"other things", by_others, true},
                              Factor{"distance [mm]", by_distance, false}, Factor{"in sight [%]", by_sight, false},
                              Factor{"fill [mm]", by_fill, false},         Factor{"content", by_liquid, false},
                              Factor{"kind of cup", by_cup, false}};

struct Tally {
  int cups = 0, recognised = 0, told = 0, right = 0, frames = 0, false_frames = 0;

  void add(const TrialCup& cup) {
    ++cups;
    recognised += cup.found;
    if (!cup.found || cup.liquid_found == name_of(Liquid::kUnknown)) return;
    ++told;
    right += (cup.liquid_found == name_of(Liquid::kYes)) == (cup.liquid != "empty");
  }
};

struct Rate {
  const char* name;
  const char* colour;
  int Tally::*hits;
  int Tally::*of;
};
constexpr std::array kRates{Rate{"recognised", "blue", &Tally::recognised, &Tally::cups},
                            Rate{"liquid told", "orange", &Tally::told, &Tally::recognised},
                            Rate{"liquid right", "green", &Tally::right, &Tally::told},
                            Rate{"false cup", "red", &Tally::false_frames, &Tally::frames}};

std::map<Group, Tally> tallies(const Factor& factor, const std::vector<TrialResult>& trials) {
  std::map<Group, Tally> groups;
  for (const TrialResult& frame : trials) {
    if (factor.is_of_frames) {
      Tally& tally = groups[factor.of(frame, nullptr)];
      ++tally.frames;
      tally.false_frames += !frame.false_cups.empty();
    }
    for (const TrialCup& cup : frame.cups) groups[factor.of(frame, &cup)].add(cup);
  }
  return groups;
}

std::string percent(double share) { return fmt::format("{:.1f}", 100.0 * share); }

std::string tables(const std::vector<CardRow>& card) {
  std::string html;
  for (auto begin = card.begin(); begin != card.end();) {
    const auto end = std::find_if(begin, card.end(), [&](const CardRow& row) { return row.factor != begin->factor; });
    std::vector<std::vector<std::string>> rows;
    for (auto row = begin; row != end; ++row) {
      const Interval interval = row->interval();
      rows.push_back({row->group, row->rate, fmt::format("{}", row->hits), fmt::format("{}", row->of),
                      percent(row->share()), percent(interval.low), percent(interval.high)});
    }
    html += html_folded("By " + begin->factor,
                        html_table({begin->factor, "rate", "hits", "of", "%", "95 % from", "to"}, rows, true));
    begin = end;
  }
  return html;
}

/// The classes side by side, with a gap between factors; the rates of a class beside each other.
void draw_card(const std::filesystem::path& folder, const std::vector<CardRow>& card) {
  constexpr double kAside = 0.18;
  std::map<std::string, std::string> points;  // of each rate
  std::vector<std::string> labels;
  std::string titles, factor, group;
  for (const CardRow& row : card) {
    const bool is_new_factor = row.factor != factor;
    if (is_new_factor && !labels.empty()) labels.emplace_back();
    if (is_new_factor)
      titles += fmt::format("set label {} at {},1.03 rotate by 20 textcolor rgb ink noenhanced\n",
                            gnuplot_text(row.factor), labels.size());
    if (is_new_factor || row.group != group) labels.push_back(row.group);
    factor = row.factor, group = row.group;
    const Interval interval = row.interval();
    const auto rate = std::find_if(kRates.begin(), kRates.end(), [&](const Rate& one) { return one.name == row.rate; });
    const double aside = kAside * static_cast<double>(rate - kRates.begin() - 1);
    points[row.rate] += fmt::format("{},{},{},{}\n", static_cast<double>(labels.size()) - 1.0 + aside, row.share(),
                                    interval.low, interval.high);
  }
  std::string blocks;
  std::vector<std::string> series;
  for (const Rate& rate : kRates) {
    if (!points.contains(rate.name)) continue;
    const std::size_t number = series.size();
    blocks += fmt::format("$rate{} << END\nx,share,low,high\n{}END\n", number, points[rate.name]);
    series.push_back(fmt::format("$rate{} using 1:2:3:4 with yerrorbars pt 7 ps 1.1 lw 2 lc rgb {} title '{}'", number,
                                 rate.colour, rate.name));
  }
  draw(folder, "card",
       fmt::format(
           "{}{}{}\nset xtics rotate by 60 right\nset tmargin 6\nset bmargin 11\nset xrange [-1:{}]\n"
           "set yrange [0:1]\nset ylabel 'share, with 95 % intervals'\nset key outside bottom center horizontal\n"
           "plot {}",
           blocks, titles, gnuplot_xtics(labels), labels.size(), fmt::join(series, ", ")));
}

}  // namespace

std::vector<CardRow> report_card(const std::vector<TrialResult>& trials) {
  std::vector<CardRow> card;
  for (const Factor& factor : kFactors)
    for (const auto& [group, tally] : tallies(factor, trials))
      for (const Rate& rate : kRates)
        if (tally.*rate.of > 0)
          card.push_back({factor.name, group.second, rate.name, tally.*rate.hits, tally.*rate.of});
  return card;
}

Table card_table(const std::vector<CardRow>& card) {
  Table table({"factor", "group", "rate", "hits", "of", "share", "low", "high"});
  for (const CardRow& row : card) {
    const Interval interval = row.interval();
    table.add({row.factor, row.group, row.rate, fmt::format("{}", row.hits), fmt::format("{}", row.of),
               fmt::format("{:.4f}", row.share()), fmt::format("{:.4f}", interval.low),
               fmt::format("{:.4f}", interval.high)});
  }
  return table;
}

void write_report_card(const std::filesystem::path& folder, const std::vector<TrialResult>& trials,
                       const std::vector<Row>& rates, const std::vector<TrialResult>& pictured) {
  const std::vector<CardRow> card = report_card(trials);
  write_table(folder / "card.csv", card_table(card));
  draw_card(folder, card);
  std::vector<std::vector<std::string>> rows;
  for (const Row& row : rates)
    rows.push_back({row.name,
                    std::holds_alternative<double>(row.value) ? fmt::format("{:.4g}", std::get<double>(row.value))
                                                              : std::get<std::string>(row.value),
                    row.unit});
  const std::string body = fmt::format(
      "<h1>The detector on {} labelled frames</h1>{}{}{}<h1>What failed</h1>{}<p>Measured depth, near is "
      "bright. Green: outlines of cups that were found, red: of those that were not, blue: circles of what "
      "was taken for a cup.</p>{}",
      trials.size(), html_picture(folder / "card.png", "rates by class"), tables(card),
      html_folded("All rates", html_table({"rate", "value", "unit"}, rows)), failure_counts(trials),
      failure_figures(pictured, "failures/"));
  write_text(folder / "index.html", html_page("Report card", body));
}

}  // namespace fathom
