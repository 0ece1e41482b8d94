#include <vibrocontact/coupled_bodies/hub.h>

#include <algorithm>

namespace vibrocontact
{
  void SuspensionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Unsprung mass", mass,
                      "All that moves with a suspended hub, body 1 included: half a wheelset with its axle "
                      "box. Units: kg.",
                      Double(0, 1e15));
    const char *const directions[] = {"x", "y", "z"};
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Stiffness ") + directions[d], stiffness[d],
                        std::string("Of the primary suspension of a suspended hub along ") + directions[d] +
                            "; it has no force in the rolling equilibrium beside its preload. Units: N/m.",
                        Double(0, 1e20));
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Damping ") + directions[d], damping[d],
                        std::string("Of the damper of a suspended hub along ") + directions[d] +
                            ". Units: Ns/m.",
                        Double(0, 1e15));
  }

  bool SuspensionParameters::any() const
  {
    return mass > 0 || std::any_of(stiffness, stiffness + 3, [](const double k) { return k > 0; }) ||
           std::any_of(damping, damping + 3, [](const double c) { return c > 0; });
  }

  HubDamper::HubDamper(const SuspendedHub *const hub, const std::vector<ModalStep> &steps)
  {
    if (!hub || !hub->is_damped())
      return;
    const unsigned int m = steps.size();
    motion.reinit(3, m);
    displacement.reinit(m, 3);
    velocity.reinit(m, 3);
    DenseMatrix inverse(3), S(3);
    for (unsigned int a = 0; a < 3; ++a)
    {
      inverse(a, a) = 1;
      S(a, a) = hub->damping[a];
      for (unsigned int k = 0; k < m; ++k)
      {
        motion(a, k) = hub->motion(a, k);
        for (unsigned int b = 0; b < 3; ++b)
          inverse(a, b) += hub->damping[a] * hub->motion(a, k) * steps[k].g1[1] * hub->motion(b, k);
      }
    }
    inverse.compute_lu_factorization();
    inverse.solve(S);
    for (unsigned int k = 0; k < m; ++k)
      for (unsigned int b = 0; b < 3; ++b)
        for (unsigned int a = 0; a < 3; ++a)
        {
          displacement(k, b) += steps[k].g1[0] * motion(a, k) * S(a, b);
          velocity(k, b) += steps[k].g1[1] * motion(a, k) * S(a, b);
        }
  }

  void HubDamper::act(const DenseVector &by, DenseVector &q, DenseVector &v) const
  {
    DenseVector moved(3);
    motion.vmult(moved, by);
    moved *= -1;
    displacement.vmult(q, moved, true);
    velocity.vmult(v, moved, true);
  }

  std::string hub_text(const std::string &hub)
  {
    if (hub == "held")
      return "held: it stays at its place in the equilibrium";
    if (hub == "massless")
      return "massless: it follows, the normal force stays as given";
    if (hub == "suspended")
      return "suspended: its mass moves on the primary suspension";
    return "none: half-spaces have no hub";
  }
} // namespace vibrocontact
