#include <vibrocontact/contact/laws/friction_law.h>

#include <cmath>

namespace vibrocontact
{
  namespace
  {
    /// std::hypot(), whose care the usual numbers do not need
    double length(const Vector2 &v)
    {
      const double square = v[0] * v[0] + v[1] * v[1];
      return square > 1e-200 && square < 1e200 ? std::sqrt(square) : std::hypot(v[0], v[1]);
    }
  } // namespace

  DiscProjection project_on_disc(const Vector2 &trial, const double radius)
  {
    const double norm = length(trial);
    if (norm <= radius && radius > 0)
      return {trial, {{{{1., 0.}}, {{0., 1.}}}}, {{0., 0.}}, true};
    if (norm == 0)
      return {{{0., 0.}}, {{{{0., 0.}}, {{0., 0.}}}}, {{0., 0.}}, true};
    const double e0 = trial[0] / norm, e1 = trial[1] / norm, c = radius / norm;
    return {{{radius * e0, radius * e1}},
            {{{{c * e1 * e1, -c * e0 * e1}}, {{-c * e0 * e1, c * e0 * e0}}}},
            {{e0, e1}},
            false};
  }

  LawParameter friction_coefficient()
  {
    return law_number("Friction coefficient", "0.3",
                      "Coulomb's mu; with a Static friction ratio its value at high slip speed. Units: none.",
                      0, most_friction);
  }
} // namespace vibrocontact
