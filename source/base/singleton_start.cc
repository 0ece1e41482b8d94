#include <vibrocontact/base/singleton_start.h>

#include <cstdlib>
#include <filesystem>

namespace vibrocontact
{
  namespace fs = std::filesystem;

  SingletonStart::SingletonStart()
  {
    for (const char *name : {"PMIX_RANK", "OMPI_COMM_WORLD_RANK"})
      if (std::getenv(name))
        return;
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "vibrocontact-XXXXXX").string();
    if (error || !mkdtemp(name.data()))
      return;
    folder = name;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
    setenv("OMPI_MCA_orte_tmpdir_base", folder.c_str(), 1);
    // a choice in the environment stays
    setenv("OMPI_MCA_pml", "ob1", 0);
  }

  SingletonStart::~SingletonStart()
  {
    std::error_code ignored;
    if (!folder.empty())
      fs::remove_all(folder, ignored);
  }
} // namespace vibrocontact
