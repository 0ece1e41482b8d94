#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/band_limited.h>
#include <vibrocontact/numerics/lsce.h>

#include <cmath>

namespace vibrocontact
{
  BodyInContact band_limited_model(const Spectra &data, const EntryMap &map)
  {
    const unsigned int n = map.n_rows, n_lines = data.omega.size();
    const std::optional<double> spacing = line_spacing(data);
    if (!spacing)
      throw InputError(
          "Inverse transform needs frequencies equally spaced from 0 Hz on: give such data or leave it out.");
    BodyInContact model;
    model.right.reinit(n, n * n_lines);
    model.left.reinit(n, n * n_lines);
    model.residual.reinit(n, n);
    for (unsigned int l = 0; l < n_lines; ++l)
    {
      const double weight = (l == 0 || l + 1 == n_lines ? 0.5 : 1.) * 2 * *spacing / (2 * M_PI);
      for (unsigned int i = 0; i < n; ++i)
      {
        model.right(i, model.poles.size()) = 1;
        for (unsigned int j = 0; j < n; ++j)
          model.left(j, model.poles.size()) = weight * data.values[map.entry[i * n + j]][l].real();
        model.poles.emplace_back(0, data.omega[l]);
      }
    }
    return model;
  }

  double band_limited_memory(const Spectra &data)
  {
    return M_PI * (data.omega.size() - 1) / data.omega.back();
  }
} // namespace vibrocontact
