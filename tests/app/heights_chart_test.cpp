// The chart of a diagnosis: what a point says, and where it leads.
#include "report/heights_chart.h"

#include <gtest/gtest.h>

namespace fathom {
namespace {

DiagnosedCampaign campaign() {
  Observation height;
  height.observable = "height_mm";
  height.value = 21.5;
  height.factors.liquid = "<b>tea & milk";
  height.factors.fill_mm = 20.0;
  height.factors.distance_mm = 300.0;
  height.factors.region = "centre";
  DiagnosedCampaign one;
  one.observations = {height};
  one.shots = {{{"7", "tea", "../a b/javascript:x.pcd", Image<std::uint8_t>(2, 3)}}, {0}};
  one.diagnosis.residuals.before = {1.25};
  one.diagnosis.residuals.after = {-0.125};
  one.diagnosis.residuals.error = {0.25};
  return one;
}

TEST(HeightsChart, APointSaysItsConditionAndLeadsToItsCloudAndInfraredImage) {
  const std::string svg = heights_chart(campaign());
  EXPECT_NE(svg.find("&lt;b&gt;tea &amp; milk, 20 mm, cup at (0, 300) mm, centre of the cup"), std::string::npos)
      << svg;
  EXPECT_NE(svg.find("+1.25 mm before, -0.12 mm after, ± 0.25 mm"), std::string::npos) << svg;
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
  EXPECT_NE(svg.find("placement 0, frame 7"), std::string::npos) << svg;
  EXPECT_NE(svg.find("href=\"#shot-0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("id=\"shot-0\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos) << svg;
  EXPECT_NE(svg.find("href=\"../a%20b/javascript%3Ax.pcd\""), std::string::npos) << svg;
}

TEST(HeightsChart, WithoutACloudNothingLeadsAnywhere) {
  DiagnosedCampaign one = campaign();
  one.shots = {};
  EXPECT_EQ(heights_chart(one).find("href"), std::string::npos);
  one.observations[0].observable = "desk_height_mm";
  EXPECT_EQ(heights_chart(one), "");
}

}  // namespace
}  // namespace fathom
