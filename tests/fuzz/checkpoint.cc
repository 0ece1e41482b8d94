#include "hdf5_bytes.h"
#include "readers.h"

#include <vibrocontact/analyses/transient/transient.h>

#include <filesystem>

using namespace vibrocontact;

namespace
{
  /// Two points on a body with one mode.
  ContactPair small_pair()
  {
    ContactPair pair;
    pair.interface.contacts.only().n_x = 2;
    pair.interface.gap = {0., 1e-6};
    pair.residual.reinit(6, 6);
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        pair.residual(i, j) = i == j ? 2e-9 : 1e-10;
    pair.omega = {2000.};
    pair.damping_ratio = {1e-4};
    pair.modal_load = {0.};
    pair.trace.reinit(6, 1);
    pair.trace(0, 0) = 0.03;
    return pair;
  }

  TransientMarch march_of(const ContactPair &pair)
  {
    TransientParameters parameters;
    parameters.end_time = 1;
    return {parameters, {}, {}, pair, {}, {}};
  }
} // namespace

void readers::checkpoint(const std::string &bytes)
{
  static const ContactPair pair = small_pair();
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
