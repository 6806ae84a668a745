// The paper's figures, remade. Each function computes one, writes its data and pictures to a folder and says what came
// out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/table.h"
#include "paper/heights.h"

namespace fathom {

/// A statement of the paper beside the program's.
struct Fact {
  std::string what, printed, here;
};

struct Figure {
  std::string name;  ///< "fig14": of NAME.csv, NAME.gp, NAME.png and NAME.svg
  std::string title;
  std::string sentence;  ///< what one sees
  std::vector<Fact> facts{};
  Table table{{}};
};

struct ReproduceSettings {
  std::filesystem::path folder;
  std::optional<int> trials;  ///< of each condition; without it each experiment has its own number
  std::uint64_t seed = 1;
  bool quiet = false;

  /// Of each condition of the figures.
  int shots() const { return trials.value_or(3); }
};

Figure reproduce_fig2(const ReproduceSettings& settings);  ///< side view, empty cup
Figure reproduce_fig3(const ReproduceSettings& settings);  ///< side view, 30 mm of milk tea
Figure reproduce_fig4(const ReproduceSettings& settings);  ///< side view, 30 mm of water
/// Measured heights of every filling and distance.
Figure reproduce_fig5(const ReproduceSettings& settings, const PaperHeights& heights);
Figure reproduce_fig10(const ReproduceSettings& settings);  ///< Eq. 3 over the incidence angle
Figure reproduce_fig12(const ReproduceSettings& settings);  ///< the skew of the two beams
Figure reproduce_fig13(const ReproduceSettings& settings);  ///< Eq. 6 over the distance
/// Eq. 7, exact and measured.
Figure reproduce_fig14(const ReproduceSettings& settings, const PaperHeights& heights);
Figure reproduce_recognition(const ReproduceSettings& settings);  ///< section VI-A, and what its rates hang on
Figure reproduce_table1(const ReproduceSettings& settings);       ///< section VI-B
/// Not a figure of the paper: Fig. 5 of all its liquids, of all light.
Figure reproduce_liquids(const ReproduceSettings& settings);
/// Not a figure of the paper: which of its facts about milk tea hold together, over all that is uncertain.
Figure reproduce_scattering(const ReproduceSettings& settings);

/// Writes NAME.csv, and by `plot` the pictures (report/gnuplot.h). The caller writes what other data `plot` reads.
void draw_figure(const ReproduceSettings& settings, const Figure& figure, const std::string& plot);

/// A length in the figures' tables: three decimals, no "-0.000".
std::string mm_text(double mm);

inline constexpr const char* kReportTitle = "Fathom: the figures of the paper, remade";

/// report.html: pictures, facts and tables in one file.
void write_report(const std::filesystem::path& folder, const std::vector<Figure>& figures);

}  // namespace fathom
