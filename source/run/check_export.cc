#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/run/check_export.h>

namespace vibrocontact
{
  bool is_exported(const Parameters &parameters, const BodyParameters &body)
  {
    return body.is_meshed() && parameters.modes.at(body.name).any();
  }

  void check_export(const Parameters &parameters)
  {
    if (!parameters.has_contact())
      throw InputError(
          "Analyses lists export, but no analysis with contact, so that the bodies have no points: add "
          "one, such as quasi-static rolling.");
    if (!parameters.scene.contacts.empty())
      throw InputError(
          "Analyses lists export, but Contacts lists several: a body is exported with one grid of "
          "contact points; leave Contacts or export out.");
    bool any = false;
    for (const BodyParameters &body : parameters.scene.bodies)
    {
      if (!is_exported(parameters, body))
        continue;
      any = true;
      const std::string begin = "Analyses lists export, but " + body.name + " ";
      if (body.has_load())
        throw InputError(begin + "stands under a load or turns, which matrices do not hold: set Gravity and "
                                 "Rotation/Speed to 0 and leave its traction out.");
      if (body.rolls())
        throw InputError(begin + "turns, so that its matrices are not symmetric: set Rotation to false.");
      if (body.description->tread_compliance(false) > 0 || body.description->tread_compliance(true) > 0)
        throw InputError(begin +
                         "has a tread, which is beside its matrices: leave the tread's stiffness out, and "
                         "give it to the body that reads them.");
      if (parameters.contacts.first().half_space_flexibility())
        throw InputError(
            begin + "takes its local flexibility from a half-space, which matrices of its elements do not "
                    "hold: set Contact/Local flexibility to finite elements.");
      if (parameters.modes.at(body.name).stiffness_damping > 0)
        throw InputError(begin +
                         "has a Stiffness damping, which its residual flexibility shares and modal matrices "
                         "do not hold: set it to 0, and give it to the body that reads them.");
    }
    if (!any)
      throw InputError("Analyses lists export, but no body has elements and modes: give one a Count of "
                       "Modes.");
  }
} // namespace vibrocontact
