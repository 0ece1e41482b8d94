#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/reduced_body.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrocontact
{
  void add_modal_compliance(DenseMatrix &compliance, const DenseMatrix &trace,
                            const std::vector<double> &omega, const std::string &body)
  {
    const unsigned int n = compliance.m(), n_modes = omega.size();
    if (std::count(omega.begin(), omega.end(), 0.) > 0)
    {
      // Name the directions in which nothing carries the contact forces.
      std::string directions;
      const char *const names[3] = {"vertically", "along x", "along y"};
      std::array<double, 3> largest = {};
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int k = 0; k < n_modes; ++k)
          for (unsigned int i = 0; i < n / 3 && omega[k] == 0; ++i)
            largest[c] = std::max(largest[c], std::abs(trace(c * (n / 3) + i, k)));
      const double rounded = 1e-6 * *std::max_element(largest.begin(), largest.end());
      for (unsigned int c = 0; c < 3; ++c)
        if (largest[c] > rounded)
          directions += (directions.empty() ? "" : ", ") + std::string(names[c]);
      throw InputError(
          "Body '" + body + "' is free to move (" + directions +
          "): a static analysis cannot load it; hold one of its boundaries or put it on springs.");
    }
    if (n_modes == 0 || n == 0)
      return;
    DenseMatrix scaled(n, n_modes), product(n, n);
    for (unsigned int k = 0; k < n_modes; ++k)
      for (unsigned int i = 0; i < n; ++i)
        scaled(i, k) = trace(i, k) / omega[k];
    scaled.mTmult(product, scaled);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        compliance(i, j) += (product(i, j) + product(j, i)) / 2;
  }
} // namespace vibrocontact
