#include <vibrocontact/coupled_bodies/sliding_frame.h>

#include <cmath>

namespace vibrocontact
{
  SlidingFrame sliding_frame(const RollingEquilibrium &equilibrium)
  {
    const ContactSolution &contact = equilibrium.contact;
    const unsigned int n = contact.status.size();
    SlidingFrame frame;
    for (unsigned int i = 0; i < n; ++i)
      if (contact.status[i] != ContactStatus::open && contact.R[i] > 0)
        frame.points.push_back(i);
    frame.normal.reinit(3 * n, frame.points.size());
    for (unsigned int k = 0; k < frame.points.size(); ++k)
    {
      const unsigned int i = frame.points[k];
      frame.normal(i, k) = 1;
      const double mu = equilibrium.friction[i];
      if (mu == 0)
        continue;
      const double sx = contact.y[n + i], sy = contact.y[2 * n + i], s = std::hypot(sx, sy);
      if (contact.status[i] == ContactStatus::stick || s == 0)
      {
        ++frame.n_stick;
        frame.across.push_back({i, 1, 0});
        frame.across.push_back({i, 0, 1});
        frame.mobility.insert(frame.mobility.end(), 2, 0.);
        continue;
      }
      frame.normal(n + i, k) = -mu * sx / s;
      frame.normal(2 * n + i, k) = -mu * sy / s;
      frame.across.push_back({i, -sy / s, sx / s});
      frame.mobility.push_back(s / (mu * contact.R[i]));
      if (!equilibrium.friction_slope.empty())
      {
        frame.along.push_back({i, sx / s, sy / s});
        frame.falling.push_back(contact.R[i] * equilibrium.friction_slope[i]);
      }
    }
    return frame;
  }

  void SlidingFrame::keep_sticking_only()
  {
    std::vector<ContactDirection> sticking;
    for (unsigned int k = 0; k < across.size(); ++k)
      if (mobility[k] == 0)
        sticking.push_back(across[k]);
    across = sticking;
    mobility.assign(across.size(), 0.);
  }

  DenseMatrix forces_along(const std::vector<ContactDirection> &directions, const unsigned int n)
  {
    DenseMatrix forces(3 * n, directions.size());
    for (unsigned int k = 0; k < directions.size(); ++k)
    {
      forces(n + directions[k].point, k) = directions[k].x;
      forces(2 * n + directions[k].point, k) = directions[k].y;
    }
    return forces;
  }

  DenseMatrix rows_along(const DenseMatrix &matrix, const std::vector<ContactDirection> &directions,
                         const unsigned int n)
  {
    DenseMatrix result(directions.size(), matrix.n());
    for (unsigned int j = 0; j < matrix.n(); ++j)
      for (unsigned int k = 0; k < directions.size(); ++k)
        result(k, j) = directions[k].x * matrix(n + directions[k].point, j) +
                       directions[k].y * matrix(2 * n + directions[k].point, j);
    return result;
  }
} // namespace vibrocontact
