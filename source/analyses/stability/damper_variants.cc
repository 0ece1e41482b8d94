#include <vibrocontact/analyses/stability/damper_variants.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    std::vector<PatchReceptance> receptances_of(const HystereticLoss &loss)
    {
      std::vector<PatchReceptance> result;
      for (const ExactReceptance &body : loss.exact)
        result.push_back({body.basis, body.at, {}});
      return result;
    }
  } // namespace

  DamperVariants::DamperVariants(const ContactPair &pair, const HystereticLoss &loss,
                                 const CreepScheme &scheme, const RollingEquilibrium &equilibrium,
                                 std::shared_ptr<const RevolvedShapes> section)
      : section(std::move(section)), rest(std::make_shared<const ContactReceptance>(
                                         pair, scheme, equilibrium, &loss, receptances_of(loss)))
  {
    const unsigned int m = std::count(pair.body.begin(), pair.body.end(), 1u), n_rows = pair.trace.m();
    DenseMatrix trace(n_rows, m);
    bare.loss.reinit(m, m);
    for (unsigned int k = 0; k < m; ++k)
    {
      bare.omega.push_back(pair.omega[k]);
      bare.labels.push_back(pair.labels[k]);
      for (unsigned int i = 0; i < n_rows; ++i)
        trace(i, k) = pair.trace(i, k);
      for (unsigned int i = 0; i < m; ++i)
        bare.loss(i, k) = loss.modal(i, k);
    }
    bare.amplitudes.reinit(rest.basis().n(), m);
    rest.basis().Tmmult(bare.amplitudes, trace);
  }

  std::vector<StabilityRoot> DamperVariants::roots(const BodyParameters &body)
  {
    const std::vector<WheelDamper> *const dampers = body.description->wheel_dampers();
    if (!dampers || dampers->empty())
      return roots_of_body(rest, bare, {});
    BareBody with_layers = bare;
    with_layers.loss.add(1., loss_of_parts(*section, loss_of_layers(*section, *dampers)));
    const std::string path = body.name + "/" + body.body_type().section + "/Damper";
    return roots_of_body(rest, with_layers, attached_masses(*section, *dampers, path));
  }
} // namespace vibrocontact
