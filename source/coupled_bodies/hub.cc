#include <vibrocontact/base/named_table.h>
#include <vibrocontact/coupled_bodies/hub.h>

#include <algorithm>

namespace vibrocontact
{
  void SuspensionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Unsprung mass", mass,
                      "All that moves with a suspended hub, body 1 included: half a wheelset with its axle "
                      "box; of an axle it follows from the latter. Units: kg.",
                      Double(0, 1e15));
    const char *const directions[] = {"x", "y", "z"};
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(
          std::string("Stiffness ") + directions[d], stiffness[d],
          std::string("Of the primary suspension of a suspended hub, or of each box of an axle, along ") +
              directions[d] + "; it has no force in the rolling equilibrium beside its preload. Units: N/m.",
          Double(0, 1e20));
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Damping ") + directions[d], damping[d],
                        std::string("Of the damper of a suspended hub, or of each box of an axle, along ") +
                            directions[d] + ". Units: Ns/m.",
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
    const unsigned int m = steps.size(), n = hub->damping.size();
    motion.reinit(n, m);
    displacement.reinit(m, n);
    velocity.reinit(m, n);
    for (unsigned int k = 0; k < hub->shapes.n(); ++k)
      for (unsigned int a = 0; a < n; ++a)
        motion(a, k) = hub->dampers(a, k);
    DenseMatrix inverse(n), S(n);
    for (unsigned int a = 0; a < n; ++a)
    {
      inverse(a, a) = 1;
      S(a, a) = hub->damping[a];
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int b = 0; b < n; ++b)
          inverse(a, b) += hub->damping[a] * motion(a, k) * steps[k].g1[1] * motion(b, k);
    }
    inverse.compute_lu_factorization();
    inverse.solve(S);
    for (unsigned int k = 0; k < m; ++k)
      for (unsigned int b = 0; b < n; ++b)
        for (unsigned int a = 0; a < n; ++a)
        {
          displacement(k, b) += steps[k].g1[0] * motion(a, k) * S(a, b);
          velocity(k, b) += steps[k].g1[1] * motion(a, k) * S(a, b);
        }
  }

  void HubDamper::act(const DenseVector &by, DenseVector &q, DenseVector &v) const
  {
    DenseVector moved(motion.m());
    motion.vmult(moved, by);
    moved *= -1;
    displacement.vmult(q, moved, true);
    velocity.vmult(v, moved, true);
  }

  const std::vector<HubKind> &hub_kinds()
  {
    static const std::vector<HubKind> kinds = {
        {"held", true, false, false, false, "it stays at its place in the equilibrium"},
        {"massless", false, true, false, false, "it follows, the normal force stays as given"},
        {"suspended", false, false, true, false, "its mass moves on the primary suspension"},
        {"axle", false, false, false, true,
         "it moves with the axle and its second wheel on the primary suspension"}};
    return kinds;
  }

  const HubKind &hub_kind(const std::string &name)
  {
    static const HubKind of_half_spaces = {"none", false, false, false, false, "half-spaces have no hub"};
    return name == of_half_spaces.name ? of_half_spaces : find_named(hub_kinds(), name, "hub");
  }

  std::string hub_text(const std::string &name)
  {
    return name + ": " + hub_kind(name).text;
  }
} // namespace vibrocontact
