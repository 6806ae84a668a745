// The shots of conditions that people look at: which they are, and that their points stand where the heights are taken.
#include "diagnosis/measurement/cup_shots.h"

#include <array>

#include "diagnosis/measurement/read_measurement.h"
#include "tests/diagnosis/measurement/written_measurement.h"

namespace fathom {
namespace {

struct CupShots : WrittenMeasurement {
  static std::string table(const char* rows) { return fmt::format("{}cloud\n{}", kFrameColumns, rows); }
};

TEST_F(CupShots, AreOneOfEachConditionInTheCupsOwnFrame) {
  write_text(folder / "frames.csv", table("0,0,0,0,0,0,none,0,0,0,clouds/a.pcd\n"
                                          "1,0,1,1,0,1,water,20,300,0,clouds/a.pcd\n"
                                          "2,0,1,1,1,2,water,20,300,0,clouds/a.pcd\n"
                                          "3,0,2,2,0,3,empty,0,300,0,clouds/a.pcd\n"));
  const std::array<std::filesystem::path, 1> folders{folder / ""};
  const Measurement measurement = read_measurements(folders);
  const std::vector<CupShot> shots = cup_shots(measurement, folders, 100'000);
  ASSERT_EQ(shots.size(), 2u);
  EXPECT_EQ(shots[0].frame->frame, "3");
  EXPECT_EQ(shots[1].frame->frame, "1");
  EXPECT_NEAR((shots[1].camera - Eigen::Vector3d(-0.0375, -0.3, 0.65)).norm(), 0.0, 1e-3);
  int on_disc = 0;
  for (const Eigen::Vector3f& point : shots[1].points) {
    const bool is_on_disc = point.z() > 0.01f;
    EXPECT_NEAR(point.z(), is_on_disc ? 0.020f : 0.0f, 1e-3f);
    EXPECT_TRUE(!is_on_disc || point.head<2>().norm() < 0.041f) << point.transpose();
    on_disc += is_on_disc;
  }
  EXPECT_GT(on_disc, 2000);
  std::size_t thinned = 0;
  for (const CupShot& shot : cup_shots(measurement, folders, 1000)) thinned += shot.points.size();
  EXPECT_LE(thinned, 1000u);
  EXPECT_GT(thinned, 500u);
}

/// Sessions of the second folder follow those of the first; its clouds lie in it.
TEST_F(CupShots, OfSeveralFoldersComeFromTheirOwn) {
  write_text(folder / "frames.csv", table("1,0,1,1,0,1,water,20,300,0,clouds/a.pcd\n"));
  make_directory(folder / "more/clouds");
  std::filesystem::copy(folder / "rig.json", folder / "more/rig.json");
  write_pcd(folder / "more/clouds/b.pcd", ideal_cloud(kHeight, 0.030));
  write_text(folder / "more/frames.csv", table("9,0,1,1,0,1,water,30,300,0,clouds/b.pcd\n"));
  const std::array<std::filesystem::path, 2> folders{folder / "", folder / "more"};
  const Measurement measurement = read_measurements(folders);
  const std::vector<CupShot> shots = cup_shots(measurement, folders, 100'000);
  ASSERT_EQ(shots.size(), 2u);
  EXPECT_EQ(shots[1].frame->frame, "9");
  EXPECT_EQ(shots[1].frame->session, 1);
}

}  // namespace
}  // namespace fathom
