#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/derivative.h>
#include <vibrocontact/contact/laws/falling_friction.h>

namespace vibrocontact
{
  namespace
  {
    class FallingFriction : public FrictionLaw
    {
    public:
      FallingFriction(const double mu, const double ratio, const double velocity)
          : mu(mu), ratio(ratio), velocity(velocity)
      {
        if (ratio == 1)
          throw InputError(
              "Contact/Friction law is falling friction, but Contact/Static friction ratio is 1, "
              "so that friction does not change with the slip speed: give another ratio, or take "
              "coulomb.");
      }
      LawDescription description() const override { return {"falling friction", {mu, ratio, velocity}}; }
      Coefficient coefficient(const double speed) const override
      {
        const auto [value, slope] = value_and_slope([this](const auto &s) { return over_speed(s); }, speed);
        return {value, slope};
      }

    private:
      template <typename Number>
      Number over_speed(const Number &s) const
      {
        using std::exp;
        return mu * (1 + (ratio - 1) * exp(-s / velocity));
      }

      double mu, ratio, velocity;
    };
  } // namespace

  FrictionLawEntry falling_friction()
  {
    return {"falling friction",
            "from one coefficient at rest to another at high slip speed",
            {friction_coefficient(),
             law_number("Static friction ratio", "1",
                        "Friction at rest over Friction coefficient; above 1 friction falls with the slip "
                        "speed, below 1 it rises (friction modifiers). Units: none.",
                        1e-3, 10),
             law_number("Stribeck velocity", "0.1",
                        "Slip speed over which friction goes 63 % of its way. Units: m/s.", 1e-9, 1e3)},
            [](const std::vector<double> &numbers)
            { return std::make_shared<const FallingFriction>(numbers.at(0), numbers.at(1), numbers.at(2)); }};
  }
} // namespace vibrocontact
