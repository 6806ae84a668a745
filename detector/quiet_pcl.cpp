#include "detector/quiet_pcl.h"

#include <pcl/console/print.h>

namespace fathom {

QuietPcl::QuietPcl() : verbosity_before_(pcl::console::getVerbosityLevel()) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
}

QuietPcl::~QuietPcl() {
  pcl::console::setVerbosityLevel(static_cast<pcl::console::VERBOSITY_LEVEL>(verbosity_before_));
}

}  // namespace fathom
