#include "core/rows.h"

#include <gtest/gtest.h>

#include "core/json.h"

namespace fathom {
namespace {

const std::vector<Row> kRows{{"height", 9.2101051, "mm"}, {"points_in_cup", 1234.0, ""}};

TEST(Rows, AreNameValueUnitInColumns) {
  EXPECT_EQ(format_rows(kRows, false),
            "height              9.21011 mm\n"
            "points_in_cup          1234\n");
}

TEST(Rows, AreOneJsonObjectWithEveryDigit) {
  const std::string text = format_rows(kRows, true);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(Json::parse(text), Json::parse(R"({"height": {"value": 9.2101051, "unit": "mm"},
                                               "points_in_cup": {"value": 1234.0, "unit": ""}})"));
}

TEST(Rows, AreOneLineEachWhateverTheyHold) {
  EXPECT_EQ(format_rows({{"why", "because\nrecognised 1\x1b[2J"}}, false),
            "why  because\\u000arecognised 1\\u001b[2J\n");
}

TEST(Rows, HoldTextsToo) {
  const std::vector<Row> rows{{"liquid", "yes"}, {"why", "because it is higher than the bottom"}};
  EXPECT_EQ(format_rows(rows, false),
            "liquid           yes\n"
            "why     because it is higher than the bottom\n");
  EXPECT_EQ(Json::parse(format_rows(rows, true))["liquid"]["value"], "yes");
}

}  // namespace
}  // namespace fathom
