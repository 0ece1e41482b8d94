#include "../unit/small_march.h"
#include "hdf5_bytes.h"
#include "readers.h"

#include <vibrocontact/marching/transient_checkpoint.h>

#include <filesystem>

using namespace vibrocontact;

void readers::checkpoint(const std::string &bytes)
{
  static const ContactPair pair = small_pair(true);
  static const std::string good = []
  {
    std::filesystem::create_directories("run");
    TransientMarch march = march_of(pair);
    march.state.time = 0.1;
    march.state.R.reinit(6);
    transient_checkpoint("run").write(march, {});
    const std::string sealed = content_of("run/checkpoint.h5");
    return sealed.substr(0, sealed.size() - 8);
  }();
  file_of("run/checkpoint.h5", hdf5_bytes(bytes, good, true));
  TransientMarch march = march_of(pair);
  if (taken([&] { transient_checkpoint("run").read(march, {}); }) && !(march.time() <= 1))
    throw std::logic_error("the time of a checkpoint is no number within the run");
}
