#include <vibrocontact/base/log.h>
#include <vibrocontact/output/verdict.h>

namespace vibrocontact
{
  void doubt(const std::string &text, Results &results)
  {
    run_log().warning(text);
    results.warnings.push_back({results.running, text});
  }

  void refuse(const std::string &text, Results &results)
  {
    run_log().warning(text);
    results.failures.push_back({results.running, text});
  }
} // namespace vibrocontact
