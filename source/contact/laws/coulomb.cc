#include <vibrocontact/contact/laws/coulomb.h>

namespace vibrocontact
{
  namespace
  {
    class Coulomb : public FrictionLaw
    {
    public:
      explicit Coulomb(const double mu) : mu(mu) {}
      LawDescription description() const override { return {"coulomb", {mu}}; }
      Coefficient coefficient(double) const override { return {mu, 0.}; }
      bool depends_on_speed() const override { return false; }

    private:
      double mu;
    };
  } // namespace

  FrictionLawEntry coulomb()
  {
    return {"coulomb",
            "one coefficient for rest and every slip speed",
            {friction_coefficient()},
            [](const std::vector<double> &numbers)
            { return std::make_shared<const Coulomb>(numbers.at(0)); }};
  }
} // namespace vibrocontact
