#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/laws/exponential_penalty.h>
#include <vibrocontact/contact/laws/linear_spring.h>

namespace vibrocontact
{
  namespace
  {
    class LinearSpring : public SpringLaw
    {
    public:
      LinearSpring(const double amplitude, const double exponent)
          : amplitude(amplitude), exponent(exponent), k(amplitude * exponent)
      {
        if (!(k > 0))
          throw InputError(
              "The linear spring law needs a positive stiffness; give Contact/Penalty amplitude [N] and "
              "Contact/Penalty exponent [1/m], whose product it is.");
      }
      LawDescription description() const override { return {"linear spring", {amplitude, exponent}}; }
      bool is_linear() const override { return true; }

    protected:
      Spring spring(const double penetration) const override { return {k * penetration, k}; }

    private:
      double amplitude, exponent, k;
    };
  } // namespace

  NormalLawEntry linear_spring()
  {
    return {"linear spring", "force = amplitude * exponent * penetration", penalty_parameters(),
            [](const std::vector<double> &numbers)
            { return std::make_shared<const LinearSpring>(numbers.at(0), numbers.at(1)); }};
  }
} // namespace vibrocontact
