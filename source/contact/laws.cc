#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/contact/laws.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  NormalLaw::Projection SignoriniLaw::project(const double force, const double gap, const double rho) const
  {
    const double trial = force - rho * gap;
    if (trial > 0)
      return {trial, 1., -rho};
    return {0., 0., 0.};
  }

  namespace
  {
    constexpr double linear_beyond = 2.;
  }

  ExponentialPenaltyLaw::ExponentialPenaltyLaw(const double amplitude, const double exponent)
      : amplitude(amplitude), exponent(exponent)
  {
    if (!(amplitude > 0 && exponent > 0))
      throw InputError("The exponential penalty law needs a positive amplitude and a positive exponent; "
                       "give Contact/Penalty amplitude and Contact/Penalty exponent.");
  }

  LinearSpringLaw::LinearSpringLaw(const double stiffness) : k(stiffness)
  {
    if (!(k > 0))
      throw InputError(
          "The linear spring law needs a positive stiffness; give Contact/Penalty amplitude [N] and "
          "Contact/Penalty exponent [1/m], whose product it is.");
  }

  NormalLaw::Projection LinearSpringLaw::project(const double force, const double gap, const double rho) const
  {
    const double trial = force - rho * gap, share = k / (k + rho);
    if (trial > 0)
      return {share * trial, share, -rho * share};
    return {0., 0., 0.};
  }

  double ExponentialPenaltyLaw::stiffness(const double gap) const
  {
    return gap >= 0 ? 0. : amplitude * exponent * std::exp(std::min(-gap * exponent, linear_beyond));
  }

  double ExponentialPenaltyLaw::force(const double gap) const
  {
    const double s = -gap * exponent;
    if (s <= 0)
      return 0.;
    const double at = std::min(s, linear_beyond);
    return amplitude * (std::expm1(at) + std::exp(at) * (s - at));
  }

  NormalLaw::Projection ExponentialPenaltyLaw::project(const double N, const double gap,
                                                       const double rho) const
  {
    const double trial = N - rho * gap;
    if (trial <= 0)
      return {0., 0., 0.};
    // f(-d) + rho d = trial is convex and increasing in d: Newton's iteration decreases from the second step
    // on.
    double d = std::min(trial / rho, std::log1p(trial / amplitude) / exponent);
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
    {
      const double step = (force(-d) + rho * d - trial) / (stiffness(-d) + rho);
      d = std::max(d - step, 0.);
      if (std::abs(step) <= 1e-10 * d) // quadratic: the next one would be below round-off
        break;
    }
    const double slope = d > 0 ? stiffness(-d) : amplitude * exponent, share = slope / (slope + rho);
    return {force(-d), share, -rho * share};
  }

  double ExponentialPenaltyLaw::potential(const double gap) const
  {
    const double s = -gap * exponent;
    if (s <= 0)
      return 0.;
    const double at = std::min(s, linear_beyond), beyond = (s - at) / exponent;
    return amplitude * (std::expm1(at) - at) / exponent + amplitude * std::expm1(at) * beyond +
           0.5 * amplitude * exponent * std::exp(at) * beyond * beyond;
  }

  CoulombLaw::Projection CoulombLaw::project(const Vector2 &trial, const double radius)
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

  const std::vector<NormalLawEntry> &normal_laws()
  {
    static const std::vector<NormalLawEntry> table = {
        {"signorini", "rigid unilateral contact: gap >= 0, force >= 0, one of them zero"},
        {"exponential penalty", "force = amplitude * (exp(exponent * penetration) - 1)"},
        {"linear spring", "force = amplitude * exponent * penetration"}};
    return table;
  }

  std::shared_ptr<const NormalLaw> create_normal_law(const std::string &name, const double amplitude,
                                                     const double exponent)
  {
    if (name == "signorini")
      return std::make_shared<SignoriniLaw>();
    if (name == "exponential penalty")
      return std::make_shared<ExponentialPenaltyLaw>(amplitude, exponent);
    if (name == "linear spring")
      return std::make_shared<LinearSpringLaw>(amplitude * exponent);
    std::vector<std::string> names;
    for (const NormalLawEntry &entry : normal_laws())
      names.push_back(entry.name);
    throw InputError("There is no normal contact law called \"" + name + "\"; " +
                     name_suggestion(name, names));
  }
} // namespace vibrocontact
