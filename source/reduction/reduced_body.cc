#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/reduction/reduced_body.h>

#include <cmath>

namespace vibrocontact
{
  DenseMatrix static_compliance(const ReducedBody &body)
  {
    const unsigned int n = body.residual_flexibility.m(), n_modes = body.omega.size();
    if (body.n_rigid_modes > 0)
    {
      // Name the directions in which nothing carries the contact forces.
      std::string directions;
      const char *const names[3] = {"vertically", "along x", "along y"};
      for (unsigned int c = 0; c < 3; ++c)
      {
        double largest = 0;
        for (unsigned int k = 0; k < body.n_rigid_modes; ++k)
          for (unsigned int i = 0; i < n / 3; ++i)
            largest = std::max(largest, std::abs(body.modal_trace(c * (n / 3) + i, k)));
        if (largest > 0)
          directions += (directions.empty() ? "" : ", ") + std::string(names[c]);
      }
      throw InputError(
          "Body '" + body.name + "' is free to move (" + directions +
          "): a static analysis cannot load it; hold one of its boundaries or put it on springs.");
    }
    DenseMatrix result = body.residual_flexibility;
    if (n_modes == 0 || n == 0)
      return result;
    DenseMatrix scaled(n, n_modes), product(n, n);
    for (unsigned int k = 0; k < n_modes; ++k)
      for (unsigned int i = 0; i < n; ++i)
        scaled(i, k) = body.modal_trace(i, k) / body.omega[k];
    scaled.mTmult(product, scaled);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        result(i, j) += (product(i, j) + product(j, i)) / 2;
    return result;
  }
} // namespace vibrocontact
