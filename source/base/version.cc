#include <vibrocontact/base/version.h>

#include <deal.II/base/config.h>

#include <vibrocontact_commit.h>

namespace vibrocontact
{
  std::string version()
  {
    return VIBROCONTACT_VERSION;
  }

  std::string commit()
  {
    return VIBROCONTACT_COMMIT;
  }

  std::string dealii_version()
  {
    return DEAL_II_PACKAGE_VERSION;
  }
} // namespace vibrocontact
