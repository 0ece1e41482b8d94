#include <vibrocontact/contact/laws/friction_law.h>

#include <cmath>

namespace vibrocontact
{
  DiscProjection project_on_disc(const Vector2 &trial, const double radius)
  {
    const double norm = std::hypot(trial[0], trial[1]);
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
                      0, 10);
  }
} // namespace vibrocontact
