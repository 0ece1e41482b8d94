#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/contact_frame.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  std::array<double, 3> ContactFrame::coordinates(const std::array<double, 3> &place) const
  {
    std::array<double, 3> result = {{0, 0, 0}};
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int c = 0; c < 3; ++c)
        result[(c + 2) % 3] += axes[c][d] * (place[d] - origin[d]);
    return result;
  }

  ContactFrame contact_frame(const std::array<double, 3> &origin, const std::array<double, 3> &normal)
  {
    ContactFrame frame;
    frame.origin = origin;
    const double length = std::hypot(normal[0], normal[1], normal[2]),
                 across = std::hypot(normal[1], normal[2]);
    if (!(across > 1e-6 * length))
      throw InputError("a normal of zero length or along x, the direction of rolling");
    auto &[n, x, y] = frame.axes;
    for (unsigned int d = 0; d < 3; ++d)
      n[d] = normal[d] / length;
    const double share = across / length; // of e_x in the plane of contact
    for (unsigned int d = 0; d < 3; ++d)
      x[d] = ((d == 0 ? 1 : 0) - n[0] * n[d]) / share;
    for (unsigned int d = 0; d < 3; ++d)
      y[d] = n[(d + 1) % 3] * x[(d + 2) % 3] - n[(d + 2) % 3] * x[(d + 1) % 3];
    return frame;
  }

  ContactGrid covering_grid(const std::vector<ContactPlace> &places)
  {
    ContactGrid result = places.front().grid;
    if (places.size() == 1 && places.front().frame.is_usual())
      return result;
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    for (const ContactPlace &place : places)
      for (unsigned int corner = 0; corner < 4; ++corner)
      {
        const ContactGrid &grid = place.grid;
        const double x = grid.x_first + (corner % 2 ? grid.n_x - 0.5 : -0.5) * grid.spacing_x,
                     y = grid.y_first + (corner / 2 ? grid.n_y - 0.5 : -0.5) * grid.spacing_y;
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double there =
              place.frame.origin[d] + x * place.frame.axes[1][d] + y * place.frame.axes[2][d];
          low[d] = std::min(low[d], there);
          high[d] = std::max(high[d], there);
        }
        result.spacing_x = std::min(result.spacing_x, grid.spacing_x);
        result.spacing_y = std::min(result.spacing_y, grid.spacing_y);
      }
    const auto fill = [](unsigned int &n, double &spacing, double &first, const double from, const double to)
    {
      n = std::max(1l, std::lround((to - from) / spacing));
      spacing = (to - from) / n;
      first = from + spacing / 2;
    };
    fill(result.n_x, result.spacing_x, result.x_first, low[0], high[0]);
    fill(result.n_y, result.spacing_y, result.y_first, low[1], high[1]);
    return result;
  }
} // namespace vibrocontact
