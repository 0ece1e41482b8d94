#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/window.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// distance in whole spacings; false if it is none
    bool whole(const double distance, const double spacing, long &number)
    {
      number = std::lround(distance / spacing);
      return std::abs(distance / spacing - number) < 1e-6;
    }
  } // namespace

  ContactGrid band(const ContactGrid &grid, const double first, const double last)
  {
    long n_first, n_last;
    if (!whole(first, grid.spacing_y, n_first) || !whole(last, grid.spacing_y, n_last))
      throw InputError("Swept values of Contact/Lateral position lie " + number_text(first) + " to " +
                       number_text(last) +
                       " m from its single value, which is no multiple of Contact/Grid spacing (" +
                       number_text(grid.spacing_y) + " m): choose values and step as multiples.");
    ContactGrid result = grid;
    result.y_first = grid.y_first + n_first * grid.spacing_y;
    result.n_y = grid.n_y + (n_last - n_first);
    return result;
  }

  ContactGrid clipped(const ContactGrid &grid, const double low, const double high)
  {
    ContactGrid result = grid;
    result.n_y = 0;
    const double slack = 1e-6 * grid.spacing_y;
    for (unsigned int j = 0; j < grid.n_y; ++j)
    {
      const double y = grid.y_first + j * grid.spacing_y;
      if (y - grid.spacing_y / 2 < low - slack || y + grid.spacing_y / 2 > high + slack)
        continue;
      if (result.n_y++ == 0)
        result.y_first = y;
    }
    return result;
  }

  std::vector<unsigned int> window_rows(const ContactGrid &band, const ContactGrid &grid,
                                        const double lateral)
  {
    long i_first, j_first;
    AssertThrow(whole(grid.x_first - band.x_first, grid.spacing_x, i_first) &&
                    whole(lateral + grid.y_first - band.y_first, grid.spacing_y, j_first) && i_first >= 0 &&
                    j_first >= 0 && i_first + grid.n_x <= band.n_x && j_first + grid.n_y <= band.n_y,
                dealii::ExcMessage("The window does not lie in the band of contact points."));
    std::vector<unsigned int> rows;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int j = 0; j < grid.n_y; ++j)
        for (unsigned int i = 0; i < grid.n_x; ++i)
          rows.push_back(contact_row(band.n_points(), c, band.index(i_first + i, j_first + j)));
    return rows;
  }

  namespace
  {
    ComplexMatrix rows_of(const ComplexMatrix &matrix, const std::vector<unsigned int> &rows)
    {
      ComplexMatrix result(rows.size(), matrix.n());
      for (unsigned int k = 0; k < matrix.n(); ++k)
        for (unsigned int r = 0; r < rows.size(); ++r)
          result(r, k) = matrix(rows[r], k);
      return result;
    }
  } // namespace

  ReducedBody window(const ReducedBody &body, const ContactGrid &grid, const double lateral,
                     const double height)
  {
    const std::vector<unsigned int> rows = window_rows(body.grid, grid, lateral);
    const unsigned int n = grid.n_points();
    ReducedBody part;
    part.name = body.name;
    part.grid = grid;
    part.n_dofs = body.n_dofs;
    part.n_rigid_modes = body.n_rigid_modes;
    part.omega = body.omega;
    part.damping_ratio = body.damping_ratio;
    part.loss = body.loss;
    part.labels = body.labels;
    part.modal_load = body.modal_load;
    part.participation = body.participation;
    part.flow = body.flow;
    part.section = body.section;
    part.hub = body.hub;
    if (part.hub)
    {
      part.hub->centre[1] -= lateral;
      part.hub->centre[2] -= height;
    }
    part.relaxation = body.relaxation;
    part.poles = body.poles;
    part.pole_load = body.pole_load;
    if (body.n_poles() > 0)
    {
      part.right = rows_of(body.right, rows);
      part.left = rows_of(body.left, rows);
    }
    part.trace.reinit(3 * n, body.trace.n());
    for (unsigned int k = 0; k < body.trace.n(); ++k)
      for (unsigned int r = 0; r < 3 * n; ++r)
        part.trace(r, k) = body.trace(rows[r], k);
    part.residual.reinit(3 * n, 3 * n);
    for (unsigned int s = 0; s < 3 * n; ++s)
      for (unsigned int r = 0; r < 3 * n; ++r)
        part.residual(r, s) = body.residual(rows[r], rows[s]);
    for (const unsigned int r : rows)
    {
      part.lifting.push_back(body.lifting[r]);
      if (!body.residual_load.empty())
        part.residual_load.push_back(body.residual_load[r]);
    }
    for (unsigned int i = 0; i < n; ++i)
      part.surface_height.push_back(body.surface_height[rows[i]] - height);
    return part;
  }
} // namespace vibrocontact
