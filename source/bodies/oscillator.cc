#include <vibrocontact/bodies/body_in_contact.h>
#include <vibrocontact/scene/oscillator.h>

#include <cmath>

namespace vibrocontact
{
  BodyInContact OscillatorParameters::between_points(const bool with_friction, double,
                                                     const std::vector<double> &) const
  {
    BodyInContact body;
    std::vector<double> masses = {mass};
    body.omega = {std::sqrt(stiffness / mass)};
    body.damping_ratio = {damping_ratio};
    body.modal_load = {-std::sqrt(mass) * gravity};
    body.labels = {"oscillator"};
    if (with_friction)
    {
      masses.push_back(tangential_mass);
      body.omega.push_back(std::sqrt(tangential_stiffness / tangential_mass));
      body.damping_ratio.push_back(tangential_damping_ratio);
      body.modal_load.push_back(0);
      body.labels.push_back("oscillator, tangential");
    }
    const unsigned int n = masses.size();
    body.trace.reinit(n, n);
    body.participation.reinit(n, 3);
    for (unsigned int k = 0; k < n; ++k)
    {
      body.trace(k, k) = 1 / std::sqrt(masses[k]);
      body.participation(k, k == 0 ? 2 : 0) = std::sqrt(masses[k]);
    }
    body.residual.reinit(n, n);
    body.residual_load.assign(n, 0.);
    return body;
  }
} // namespace vibrocontact
