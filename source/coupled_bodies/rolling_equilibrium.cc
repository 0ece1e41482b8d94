#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/coupled_bodies/rolling_equilibrium.h>

namespace vibrocontact
{
  RollingEquilibrium rolling_equilibrium(const ContactSolution &contact,
                                         const PointLaws<FrictionLaw> &friction,
                                         const PointLaws<NormalLaw> &normal, const double speed,
                                         const bool force_given)
  {
    RollingEquilibrium result;
    result.contact = contact;
    result.speed = speed;
    result.force_given = force_given;
    const std::vector<double> slips = slip_speed(contact);
    for (unsigned int i = 0; i < slips.size(); ++i)
    {
      const FrictionLaw::Coefficient mu = friction[i].coefficient(slips[i]);
      const bool sticks = contact.status[i] == ContactStatus::stick;
      result.friction.push_back(mu.value + (sticks ? friction[i].jump() : 0.));
      if (friction.any(&FrictionLaw::depends_on_speed))
        result.friction_slope.push_back(mu.slope);
      if (normal.any([](const NormalLaw &law) { return !law.is_rigid(); }))
        result.normal_compliance.push_back(
            normal[i].is_rigid() ? 0. : normal[i].compression(contact.R[i]).compliance);
    }
    return result;
  }
} // namespace vibrocontact
