// PCL's grabber of OpenNI2 devices sees the simulated cup.
#include <pcl/io/openni2_grabber.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <future>

#include "sim/sensor/capture_files.h"
#include "sim/sensor/depth.h"
#include "tests/openni2/client.h"

namespace fathom {
namespace {

TEST(Grabber, GivesOurCloud) {
  const Captured captured;
  const RecordedCapture recorded = read_capture(captured.frames);
  std::vector<Image<CloudPoint>> ours;
  for (std::size_t i = 0; i < recorded.frames.size(); ++i) {
    const Image<float> depth = depth_image(recorded.sensor(), read_frame(recorded, i, false).disparity_px);
    ours.push_back(cloud_of_depth(recorded.sensor(), depth, Image<float>(320, 240)));
  }

  pcl::io::OpenNI2Grabber grabber(captured.frames);
  std::promise<pcl::PointCloud<pcl::PointXYZ>::ConstPtr> first;
  bool given = false;
  std::function<void(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr&)> receive = [&](const auto& cloud) {
    if (!std::exchange(given, true)) first.set_value(cloud);
  };
  grabber.registerCallback(receive);
  grabber.start();
  auto future = first.get_future();
  ASSERT_EQ(future.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  grabber.stop();
  const auto cloud = future.get();
  ASSERT_EQ(cloud->width, 320u);
  ASSERT_EQ(cloud->height, 240u);

  double nearest = INFINITY;  // the grabber does not say which frame it is
  for (const Image<CloudPoint>& frame : ours) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const CloudPoint& a = frame.pixels()[i];
      const pcl::PointXYZ& b = cloud->points[i];
      if (std::isnan(a.z) != std::isnan(b.z)) farthest = INFINITY;
      if (!std::isnan(a.z)) farthest = std::max<double>(farthest, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z));
    }
    nearest = std::min(nearest, farthest);
  }
  EXPECT_LT(nearest, 2e-6);  // [m]; float coordinates of up to 1 m, by a field of view in float
}

}  // namespace
}  // namespace fathom
