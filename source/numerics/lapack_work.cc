#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/numerics/lapack_work.h>

#include <algorithm>
#include <string>
#include <vector>

namespace vibrocontact
{
  void with_work(const char *name,
                 const std::function<void(double *work, const int &n_work, int &info)> &call)
  {
    int info = 0, n_work = -1;
    double wanted = 0;
    call(&wanted, n_work, info);
    n_work = static_cast<int>(wanted);
    std::vector<double> work(std::max(1, n_work));
    call(work.data(), n_work, info);
    if (info != 0)
      throw ConvergenceError(std::string("LAPACK's ") + name + " failed: " + std::to_string(info) + ".");
  }
} // namespace vibrocontact
