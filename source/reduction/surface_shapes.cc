#include <vibrocontact/reduction/surface_shapes.h>

#include <algorithm>

namespace vibrocontact
{
  SurfaceShapes surface_shapes(const SurfaceTrace &surface, const Modes &modes)
  {
    SurfaceShapes result;
    result.omega = modes.omega;
    for (const auto &point : surface.points)
      for (unsigned int d = 0; d < 3; ++d)
        result.points.push_back(point[d]);
    for (const auto &quad : surface.quads)
      result.quads.insert(result.quads.end(), quad.begin(), quad.end());
    ContactTrace rows; // the same product
    rows.rows = surface.rows;
    result.shapes.reserve(result.points.size() * modes.shapes.size());
    for (const auto &shape : modes.shapes)
    {
      const std::vector<double> values = contact_trace(rows, shape);
      result.shapes.insert(result.shapes.end(), values.begin(), values.end());
    }
    return result;
  }

  SurfaceShapes mixed_shapes(const SurfaceShapes &shapes, const DenseMatrix &mixing,
                             const std::vector<double> &omega)
  {
    if (mixing.m() == 0)
      return shapes;
    const std::size_t n_values = shapes.points.size();
    SurfaceShapes result;
    result.points = shapes.points;
    result.quads = shapes.quads;
    result.omega = omega;
    std::vector<double> sum(n_values);
    for (unsigned int e = 0; e < mixing.n(); ++e)
    {
      std::fill(sum.begin(), sum.end(), 0.);
      for (unsigned int k = 0; k < mixing.m(); ++k)
        for (std::size_t i = 0; i < n_values; ++i)
          sum[i] += mixing(k, e) * shapes.shapes[n_values * k + i];
      result.shapes.insert(result.shapes.end(), sum.begin(), sum.end());
    }
    return result;
  }

  std::vector<double> surface_displacement(const SurfaceShapes &shapes, const std::vector<double> &amplitudes)
  {
    AssertThrow(amplitudes.size() == shapes.n_modes(),
                dealii::ExcDimensionMismatch(amplitudes.size(), shapes.n_modes()));
    const std::size_t n = shapes.points.size();
    std::vector<double> result(n, 0.);
    for (unsigned int k = 0; k < shapes.n_modes(); ++k)
      for (std::size_t i = 0; i < n && amplitudes[k] != 0; ++i)
        result[i] += amplitudes[k] * shapes.shapes[n * k + i];
    return result;
  }
} // namespace vibrocontact
