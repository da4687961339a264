#include "ros/dds_serving.h"

#include <unistd.h>

#include "base/error.h"

namespace hl {

void beginServing(const std::string& own_version, const std::string& version_of_server) {
  if (version_of_server != own_version)
    throw Error("is of version " + own_version + " and was started by one of " + version_of_server +
                ": install both of one version");
  close_range(STDERR_FILENO + 1, ~0U, 0);
}

}  // namespace hl
