#include <vibrocontact/scene/flat_face.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    constexpr double edge_tolerance = 1e-6; // of a spacing

    /// One direction of fitted().
    void fit(unsigned int &n, double &spacing, double &first, const double face_low, const double face_high)
    {
      const double slack = edge_tolerance * spacing, low = first - spacing / 2, high = low + n * spacing;
      const double new_low = std::max(low, face_low), new_high = std::min(high, face_high);
      const bool inside = low >= face_low - slack && high <= face_high + slack;
      if (inside || !(new_high > new_low)) // off the face: whoever makes the trace says so
        return;
      n = std::max(1l, std::lround((new_high - new_low) / spacing));
      spacing = (new_high - new_low) / n;
      first = new_low + spacing / 2;
    }
  } // namespace

  ContactGrid fitted(const ContactGrid &grid, const FlatFace &face, const bool at_rest)
  {
    ContactGrid result = grid;
    if (at_rest)
      fit(result.n_x, result.spacing_x, result.x_first, face.x_low, face.x_high);
    if (grid.n_y > 1)
      fit(result.n_y, result.spacing_y, result.y_first, face.y_low, face.y_high);
    return result;
  }

  void SurfaceEnds::add(const ContactGrid &grid, const FlatFace &face)
  {
    const auto at = [](const double a, const double b, const double spacing)
    { return std::abs(a - b) < 1e-3 * spacing; };
    const double x = grid.x_first - grid.spacing_x / 2, y = grid.y_first - grid.spacing_y / 2;
    upstream = upstream || at(x, face.x_low, grid.spacing_x);
    downstream = downstream || at(x + grid.n_x * grid.spacing_x, face.x_high, grid.spacing_x);
    low_y = low_y || at(y, face.y_low, grid.spacing_y);
    high_y = high_y || at(y + grid.n_y * grid.spacing_y, face.y_high, grid.spacing_y);
  }
} // namespace vibrocontact
