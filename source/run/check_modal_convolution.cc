#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/run/check_contacts.h>
#include <vibrocontact/run/check_modal_convolution.h>

namespace vibrocontact
{
  namespace
  {
    void check_road_friction(const Parameters &parameters)
    {
      const BodyParameters &body = parameters.scene.bodies[0];
      if (!parameters.modal_convolution.friction)
      {
        bool slides = parameters.road.sliding_speed != 0;
        for (const auto &further : parameters.comparison.further_bodies)
          slides = slides || further.second.road.sliding_speed != 0;
        if (slides)
          throw InputError("Road/Sliding speed is given, but Modal convolution/Friction is false, so that "
                           "nothing feels it: set Friction to true or leave the speed out.");
        return;
      }
      const std::string entry = "Modal convolution/Friction is true, but ";
      if (body.description->measured())
        throw InputError(entry + body.name +
                         " is of type identified, whose data say nothing about motion along "
                         "the road: set it to false.");
      if (parameters.comparison.any())
        throw InputError(entry +
                         "Comparison/Rows asks for a comparison of methods, whose exact motion has none: "
                         "leave one of them out.");
    }
  } // namespace

  void check_modal_convolution(const Parameters &parameters)
  {
    const std::vector<BodyParameters> &bodies = parameters.scene.bodies;
    const BodyParameters &body_1 = bodies[0];
    const ComparisonParameters &comparison = parameters.comparison;
    if (!body_1.is_green() && !body_1.is_meshed())
      throw InputError("Analyses: a modal convolution moves body 1 by its poles, but " + body_1.name + ", " +
                       body_1.type +
                       ", has none: make body 1 an oscillator, a ring, an identified body or one "
                       "with elements.");
    parameters.road.check();
    parameters.modal_convolution.check();
    comparison.check();
    check_road_friction(parameters);
    if (comparison.any() && !parameters.contact().law()->is_rigid())
      throw InputError(
          "Comparison/Rows asks for a comparison of methods, whose exact motion knows rigid points "
          "only, but Contact/Normal law is " +
          parameters.contact().normal_law + ": set it to signorini or leave the rows out.");
    if (!parameters.rolling.normal_force.empty() && parameters.road.indentation != 0)
      throw InputError("Rolling/Normal force and Road/Indentation are both given, but one follows from the "
                       "other: leave one of them out.");
    check_speed_of_road(body_1, parameters.road);
    for (std::size_t b = 1; b < bodies.size(); ++b)
      if (const auto further = comparison.further_bodies.find(bodies[b].name);
          further != comparison.further_bodies.end() && !further->second.rows.empty())
        check_speed_of_road(bodies[b], further->second.road);
  }
} // namespace vibrocontact
