#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/unilateral_contact.h>
#include <vibrocontact/numerics/zero_crossing.h>
#include <vibrocontact/response/static_load.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrocontact
{
  double indentation_of_load(const PoleModel &model, const std::vector<double> &shapes, const double force)
  {
    const unsigned int n = shapes.size();
    std::vector<std::complex<double>> weights;
    for (const auto &pole : model.poles)
      weights.push_back(-1. / pole);
    const DenseMatrix whole = sum_over_poles(model, weights);
    DenseMatrix compliance(n, n);
    std::vector<double> unloaded(n, 0.), gap(n), q(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      for (unsigned int j = 0; j < n; ++j)
        compliance(i, j) = whole(i, j) + (model.residual.m() > 0 ? model.residual(i, j) : 0.);
      for (unsigned int k = 0; k < model.load.size(); ++k)
        unloaded[i] += 2 * (model.right(i, k) * weights[k] * model.load[k]).real();
      if (!std::isfinite(compliance(i, i)) || !(compliance(i, i) > 0))
        throw InputError("Rolling/Normal force is given, but the body has no static response to a force at "
                         "contact point " +
                         std::to_string(i) + ": give Road/Indentation in its place.");
    }
    UnilateralContact contact(compliance, "at rest");
    const auto load = [&](const double indentation)
    {
      for (unsigned int i = 0; i < n; ++i)
        gap[i] = unloaded[i] - indentation + shapes[i];
      contact.solve(gap.data(), q.data());
      return std::accumulate(q.begin(), q.end(), 0.);
    };
    // from where they just touch, in steps that grow
    double low = unloaded[0] + shapes[0];
    for (unsigned int i = 1; i < n; ++i)
      low = std::min(low, unloaded[i] + shapes[i]);
    double high = low + force * compliance(0, 0) / n;
    for (unsigned int k = 0; load(high) < force; ++k)
    {
      if (k > 60)
        throw InputError("Rolling/Normal force of " + number_text(force) +
                         " N is not reached however far the road is pushed towards the body: give less.");
      high = low + 2 * (high - low);
    }
    return low +
           (high - low) *
               root_between([&](const double x) { return load(low + x * (high - low)) / force - 1; }, 0., 1.);
  }
} // namespace vibrocontact
