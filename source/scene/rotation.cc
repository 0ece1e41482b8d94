#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/rotation.h>

namespace vibrocontact
{
  using namespace dealii;

  void RotationParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.add_parameter("Speed", speed,
                      "Speed of a steady rotation, right-handed about Axis; the body and what it touches are "
                      "seen in axes that turn with it. 0: it does not turn. Units: rad/s.",
                      Double(-1e6, 1e6));
    prm.add_parameter("Axis", axis,
                      "Direction of the axis along x, y, z; its length does not matter. Units: none.",
                      Patterns::List(Double(), 3, 3, ","));
    prm.add_parameter("Point on axis", point, "x, y, z of any point of the axis. Units: m.",
                      Patterns::List(Double(), 3, 3, ","));
    prm.add_parameter("Coriolis", coriolis,
                      "Whether Coriolis forces are taken: the body then moves by complex modes, which "
                      "some analyses do not know. Units: none.");
  }

  void RotationParameters::check(const std::string &section) const
  {
    if (turns() && !(Tensor<1, 3>({axis[0], axis[1], axis[2]}).norm() > 0))
      throw InputError(section +
                       "/Axis is 0, 0, 0, which has no direction: give that of the axis that the body turns "
                       "about, for instance 0, 1, 0.");
  }

  SteadyRotation<3> RotationParameters::steady() const
  {
    SteadyRotation<3> result;
    result.speed = speed;
    result.coriolis = coriolis;
    for (unsigned int d = 0; d < 3; ++d)
    {
      result.axis[d] = axis.at(d);
      result.point[d] = point.at(d);
    }
    if (result.axis.norm() > 0)
      result.axis /= result.axis.norm();
    return result;
  }

  bool RotationParameters::is_same_as(const RotationParameters &other) const
  {
    if (!turns() && !other.turns())
      return true;
    constexpr double same = 1e-9;
    const SteadyRotation<3> one = steady(), two = other.steady();
    const Tensor<1, 3> between = two.point - one.point;
    return one.coriolis == two.coriolis &&
           (one.speed * one.axis - two.speed * two.axis).norm() <= same * std::abs(one.speed) &&
           (between - (between * one.axis) * one.axis).norm() <=
               same * (one.point.norm() + two.point.norm() + 1);
  }
} // namespace vibrocontact
