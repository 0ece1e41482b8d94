#include <vibrocontact/analyses/frequency_response/modal_response.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/run/check_contacts.h>
#include <vibrocontact/run/check_frequency_response.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    void check_bodies(const Parameters &parameters)
    {
      for (const std::string &name : split_list(parameters.frequency_response.bodies))
        if (parameters.modes.count(name) == 0 &&
            std::none_of(parameters.scene.bodies.begin(), parameters.scene.bodies.end(),
                         [&](const BodyParameters &body) {
                           return body.name == name && (body.is_green() || body.description->periodic_rail());
                         }))
          throw InputError("Frequency response/Bodies names \"" + name +
                           "\", which is no meshed body of this file; name one or leave the entry empty");
    }

    /// Method modal.
    void check_modes(const Parameters &parameters, const BodyParameters &body)
    {
      if (body.description->periodic_rail())
        throw InputError(body.name + "/Rail/Model is periodic, which has no modes, but Frequency "
                                     "response/Method is modal: set it to direct.");
      if (body.is_meshed() && !parameters.modes.at(body.name).any())
        throw InputError(body.name +
                         "/Modes asks for no modes, but Frequency response/Method is modal; give Upper "
                         "frequency or Count, or set Method to direct");
      // of a Count it is known once there are modes
      if (body.is_meshed() && parameters.modes.at(body.name).upper_frequency > 0)
        check_reach_of_modes(parameters.frequency_response.frequencies().back(), body.name,
                             parameters.modes.at(body.name).upper_frequency, "Upper frequency");
    }

    void check_wheel(const Parameters &parameters, const BodyParameters &body)
    {
      const std::string section = body.name + "/" + body.body_type().section;
      if (!body.rolls())
        return;
      const std::string turns = section + "/Rotation is true, but Rolling/Speed is ",
                        advice = ": give the speed that it turns with.";
      if (parameters.rolling.creepage.speed == 0)
        throw InputError(turns + "0" + advice);
      if (!parameters.is_speed_given && !parameters.has_contact())
        throw InputError(turns + "not given" + advice);
    }
  } // namespace

  void check_frequency_response(const Parameters &parameters)
  {
    const FrequencyResponseParameters &response = parameters.frequency_response;
    response.check();
    check_bodies(parameters);
    for (const BodyParameters &body : parameters.scene.bodies)
    {
      if (!body.is_meshed())
        check_speed_of_road(body, parameters.road);
      if (!response.asks_for(body.name))
        continue;
      if (response.method == "modal")
        check_modes(parameters, body);
      if (body.is_revolved())
        check_wheel(parameters, body);
    }
  }
} // namespace vibrocontact
