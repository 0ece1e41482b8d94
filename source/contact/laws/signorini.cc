#include <vibrocontact/contact/laws/signorini.h>

namespace vibrocontact
{
  namespace
  {
    class Signorini : public NormalLaw
    {
    public:
      LawDescription description() const override { return {"signorini", {}}; }
      GraphPoint graph(const double s) const override { return {s, 0., 1., 0.}; }
      bool is_linear() const override { return true; }
      /// the resolvent written out, as every point of every time step asks for it
      Projection project(const double force, const double gap, const double rho) const override
      {
        const double closing = rigid_force(force - rho * gap);
        if (closing > 0)
          return {closing, 1., -rho};
        return {0., 0., 0.};
      }
    };
  } // namespace

  NormalLawEntry signorini()
  {
    return {"signorini",
            "rigid unilateral contact: gap >= 0, force >= 0, one of them zero",
            {},
            [](const std::vector<double> &) { return std::make_shared<const Signorini>(); }};
  }
} // namespace vibrocontact
